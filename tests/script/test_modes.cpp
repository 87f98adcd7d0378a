// ricochet.modes as a script sees it.

#include <catch2/catch.hpp>
#include <filesystem>

#include "script/program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("scripts: modes of a body are listed by rising frequency, in its units, and drawn") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local bar = ricochet.rectangle { width = 0.1, height = 0.01, material = ricochet.materials.steel, nodes = 1200,
  interior = "elements" }
local modes = ricochet.modes { body = bar, count = 4, out = "bar", size = { 640, 360 } }
assert(#modes == 4 and modes[1].omega < modes[2].omega and modes[4].mode == 4 and modes[1].participation_x < 1e-9)
-- The slowest is that of a slender bar that bends: 22.37 sqrt(E I/(rho A))/length^2, a little slower as it is not.
local slender = 22.37 * math.sqrt(205e9 / 7850 / 12) * 0.01 / 0.1 ^ 2
assert(modes[1].omega < slender and modes[1].omega > 0.93 * slender, modes[1].omega / slender)
local most = 0
for _, node in ipairs(modes[1].shape) do most = math.max(most, node.ux ^ 2 + node.uy ^ 2) end
assert(math.abs(most - 1) < 1e-12)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK(fs::exists(here.path / "out/s/bar.png"));
}

TEST_CASE("scripts: what has no modes, or fewer, is refused by name") {
  const Workplace here;
  const auto refused = [&](const std::string& call) {
    const Ended ended = here.script("local ricochet = require \"ricochet\"\nricochet.modes { " + call + " }\n");
    CHECK(ended.status == 1);
    return ended.err;
  };
  // What has a dent does not vibrate about where its modes are.
  const Ended dented = here.script(R"(local ricochet = require "ricochet"
local scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.plane {},
  effects = { ricochet.plastic { yield = 0.02, on = "projectile" } } }
ricochet.ringing { scene = scene, count = 3 })");
  CHECK(dented.status == 1);
  CHECK_THAT(dented.err, Contains("plastic leaves the projectile at rest elsewhere"));
  CHECK_THAT(refused("body = ricochet.plane {}"), Contains("'body': nothing moves inside a rigid body"));
  CHECK_THAT(refused("body = ricochet.disk { nodes = 30 }, count = 90"), Contains("has 57 modes; ask for no more"));
  CHECK_THAT(refused("body = ricochet.disk { nodes = 30 }, film = \"x\""),
             Contains("'film': 'x' must end in .mp4, .gif or .apng"));
  CHECK_THAT(refused("body = ricochet.disk { nodes = 30 }, count = 3, film = \"x.mp4\", filmed = 5"),
             Contains("'filmed': is 5, and 3 modes are asked for"));
}

TEST_CASE("scripts: what rings after an impact is what the exact modes of a disk say, and all that vibrates") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local nu, v = 1 / 3, 0.05
local c_P = math.sqrt(1e4 / ((1 - nu ^ 2) * 800 / math.pi))
local scene = ricochet.scene {
  projectile = ricochet.disk { interior = "elements", E = 1e4, nu = nu, law = "linear", h_min = 0.06, h_max = 0.06 },
  target = ricochet.plane {}, launch = { speed = v * c_P }, contact = { xi = 1000 },
}
local rings, row = ricochet.ringing { scene = scene, count = 400 }, scene:run()
assert(math.abs(rings.vibration / rings.before - (1 - row.e ^ 2)) < 1e-5)
local sum = 0
for _, mode in ipairs(rings) do sum = sum + mode.share end
-- The rest rings higher.
assert(sum * rings.before < rings.vibration and sum * rings.before > 0.97 * rings.vibration, sum)
local exact = ricochet.theory.modal_disk { nu = nu, speed = v, alpha = 1000, omega_most = 80 }
for k, n in ipairs(exact.n) do
  if exact.l[k] == 1 and (n == 4 or n == 1) then
    local share = 0
    for _, mode in ipairs(rings) do
      if math.abs(mode.omega / c_P / exact.omega[k] - 1) < 0.012 then share = share + mode.share end
    end
    assert(math.abs(share / exact.energy[k] - 1) < 0.05, n .. " " .. share .. " " .. exact.energy[k])
  end
end
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: a body that moves as its modes has outcomes, rings, and is drawn as other bodies are") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local function scene(interior)
  local disk = ricochet.disk { interior = interior, E = 1e4, nu = 0.3, nodes = 150, modes = interior == "modes" and 120
    or nil }
  return ricochet.scene { projectile = disk, target = ricochet.plane {}, launch = { speed = 0.08, psi1 = 0.5 },
    contact = { xi = 300 } }
end
local elements, modes = scene "elements":run(), scene "modes":run()
assert(modes.status == "finished" and math.abs(modes.e - elements.e) < 0.02, modes.e)
local list = ricochet.ringing { scene = scene "modes", count = 120 }
local sum = 0
for _, mode in ipairs(list) do sum = sum + mode.energy end
assert(math.abs(sum / list.vibration - 1) < 1e-3, sum / list.vibration)
ricochet.still { scene = scene "modes", out = "modal", size = { 320, 240 }, show = { material = "von_mises" } }
local rows = ricochet.series { scene = scene "modes", of = { "total_energy", "projectile_vibration" }, points = 50 }
for _, row in ipairs(rows) do assert(math.abs(row.total_energy / rows[1].total_energy - 1) < 1e-3) end
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK(fs::exists(here.path / "out/s/modal.png"));
}
