// Every two effects of the catalogue, together, on bodies of every kind: the energy of an impact is in its ledger, or
// the scene is refused with the reason.

#include <catch2/catch.hpp>

#include "effect/catalogue.hpp"
#include "script/program.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

// Each as its own documentation gives it.
std::string list_of_effects() {
  std::string list;
  each_effect_kind([&]<class E>(const E&) {
    list += std::string("  { name = '") + E::name + "', make = function() return " + E::example + " end },\n";
  });
  return "local effects = {\n" + list + "}\n";
}

constexpr const char* bodies = R"(
local dented = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { 0.2, 1 }, { 0.2, 0 }, { -0.2, 0 }, { -0.2, 1 }, { -1, 1 } }
local function wall(fields)
  fields.nodes, fields.width = 150, 4
  return ricochet.wall(fields)
end
local bodies = {
  springs = function() return ricochet.disk { nodes = 60 }, wall { stiffness = 400 } end,
  prestressed = function() return ricochet.disk { nodes = 60, prestress = 0.02 }, wall { stiffness = 400 } end,
  dented = function() return ricochet.body { outline = dented, nodes = 80 }, wall { stiffness = 400 } end,
  elements = function()
    local solid = { interior = "elements", E = 1e4, nu = 0.3, state = "plane_strain", nodes = 60 }
    return ricochet.disk(solid), wall { interior = "elements", E = 400, nu = 0.3, state = "plane_strain" }
  end,
  modes = function()
    return ricochet.disk { interior = "modes", E = 1e4, nu = 0.3, nodes = 60 },
      wall { interior = "modes", E = 400, nu = 0.3 }
  end,
}
)";

// A mistake in the ledger is of the order of what it forgets, a hundredth of the launch's energy at least; the methods'
// own errors are below 3e-5 here.
constexpr const char* trials = R"(
for kind, make in pairs(bodies) do
  local ran = 0
  for i, one in ipairs(effects) do
    for j = i, #effects do
      local given = { one.make() }
      if j > i then given[2] = effects[j].make() end
      local ok, row = pcall(function()
        local projectile, target = make()
        return ricochet.scene { projectile = projectile, target = target, effects = given,
          launch = { speed = 0.05, psi1 = 0.5, height = 0.1 }, time_limit = 60 }:run()
      end)
      local pair = ("%s: %s and %s: "):format(kind, one.name, effects[j].name)
      if ok then
        ran = ran + 1
        assert(row.status == "finished", pair .. row.status .. ": " .. row.reason)
        assert(math.abs(row.energy_closure) < 1e-4, pair .. "energy_closure is " .. row.energy_closure)
      else
        assert(row:find("'effects': ", 1, true), pair .. row)
      end
    end
  end
  print(kind, ran)
end
)";

}  // namespace

TEST_CASE("every two effects on bodies of every kind keep the ledger, or are refused with the reason") {
  const Workplace here;
  const Ended ended =
      here.script("local ricochet = require 'ricochet'\n" + list_of_effects() + bodies + trials, "--quiet");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK(ended.out == "dented\t53\nelements\t44\nmodes\t3\nprestressed\t44\nsprings\t53\n");
}
