// ricochet.compare as a script sees it.

#include <catch2/catch.hpp>
#include <filesystem>

#include "script/program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("scripts: one disk by springs, elements and modes has one modulus, one mass and about one rebound") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local scene = ricochet.scene {
  projectile = ricochet.disk { nodes = 150, placement = "triangular", quartic = 0 }, target = ricochet.plane {},
  launch = { speed = 0.14 }, contact = { xi = 500 },
}
local list = ricochet.compare { scene = scene, elements = { law = "linear" }, omega_most = 20, count = 30 }
local springs, elements, modes, exact = table.unpack(list)
assert(#list == 4 and exact.interior == "exact" and springs.interior == "springs")
-- Triangles of equal springs: E = 2k/sqrt(3), nu = 1/3, of a band without edges.
assert(math.abs(springs.E / (2e4 / math.sqrt(3)) - 1) < 0.01 and math.abs(springs.nu - 1 / 3) < 0.005, springs.E)
for _, other in ipairs { elements, modes, exact } do
  assert(math.abs(other.E / springs.E - 1) < 1e-6 and math.abs(other.nu - springs.nu) < 1e-6)
  assert(math.abs(other.e - springs.e) < 0.02, other.interior .. " " .. other.e .. " " .. springs.e)
end
-- Modes of the very mesh that the elements are.
assert(math.abs(modes.e - elements.e) < 5e-4, modes.e - elements.e)
assert(math.abs(modes.contact_time_energy / elements.contact_time_energy - 1) < 5e-3)
assert(math.abs(modes.force / elements.force - 1) < 0.05)
for k = 1, 4 do
  local a, b = modes.ringing[k], elements.ringing[k]
  assert(math.abs(a.omega / b.omega - 1) < 1e-6 and math.abs(a.share / b.share - 1) < 0.05, k)
end
assert(springs.cost.seconds > 0 and springs.cost.error < 1e-3)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Contains("modes and elements: e ") && Contains("agree within 0.002"));
  CHECK(fs::exists(here.path / "out/s/compare.csv"));
  CHECK(fs::exists(here.path / "out/s/compare_springs.csv"));
}

TEST_CASE("scripts: a body of elements is compared with springs as stiff as it, turned and of a material too") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local body = ricochet.rotated { angle = 30, body = ricochet.ellipse { a = 0.012, b = 0.008, interior = "elements",
  material = ricochet.materials.glass, h_min = 0.001, h_max = 0.003 } }
local scene = ricochet.scene { projectile = body, target = ricochet.plane {}, units = "SI", launch = { speed = 5 } }
local list = ricochet.compare { scene = scene, interiors = { "elements", "springs" }, count = 5, name = "glass",
  springs = { nodes = 200, placement = "triangular" } }
assert(list[1].nu ~= list[2].nu and math.abs(list[2].E / list[1].E - 1) < 0.02, list[2].E / list[1].E)
assert(list[1].density == list[2].density and math.abs(list[2].e - list[1].e) < 0.1)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: what cannot be compared is refused by name") {
  const Workplace here;
  const auto refused = [&](const std::string& body, const std::string& more) {
    const Ended ended =
        here.script("local ricochet = require \"ricochet\"\nlocal scene = ricochet.scene { projectile = " + body +
                    ", target = ricochet.plane {} }\nricochet.compare { scene = scene, " + more + " }\n");
    CHECK(ended.status == 1);
    return ended.err;
  };
  const std::string disk = "ricochet.disk { nodes = 40 }";
  CHECK_THAT(refused(disk, "interiors = { \"springs\" }"), Contains("'interiors' needs two or more"));
  CHECK_THAT(refused(disk, "interiors = { \"springs\", \"mode\" }"),
             Contains("not 'mode' (did you mean 'modes'?)") && Contains("s.lua:3"));
  CHECK_THAT(refused(disk, "springs = { outline = {} }"), Contains("'outline' is of the scene's projectile"));
  CHECK_THAT(refused(disk, "springs = { node = 3 }"), Contains("node") && Contains("s.lua:3"));
  CHECK_THAT(refused("ricochet.rectangle { nodes = 40 }", "omega_most = 20"), Contains("'omega_most'"));
  CHECK_THAT(refused("ricochet.sphere { E = 1e4, nu = 0.3 }", "count = 3"), Contains("is axisymmetric"));
}

TEST_CASE("scripts: springs, elements and modes of a disk agree where they must", "[.slow]") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local E, nu = 1e4, 1 / 3
local c_P = math.sqrt(E / (800 / math.pi * (1 - nu ^ 2)))
local function off(a, b, e, time, what)
  assert(math.abs(a.e - b.e) < e, ("%s: e %g"):format(what, a.e - b.e))
  local times = a.contact_time_energy / b.contact_time_energy - 1
  assert(math.abs(times) < time, ("%s: contact time %g"):format(what, times))
end
for i, v in ipairs { 0.003, 0.01, 0.03, 0.05, 0.1 } do
  local function scene(law)
    return ricochet.scene {
      projectile = ricochet.disk { interior = "elements", E = E, nu = nu, law = law, h_min = 0.01 },
      target = ricochet.plane {}, launch = { speed = v * c_P }, contact = { xi = 1000 } }
  end
  local list = ricochet.compare { scene = scene "linear", interiors = { "elements", "modes", "springs" }, omega_most = 80,
    modes = { h_min = 0.02 }, springs = { nodes = 800, placement = "triangular" }, name = "v" .. i }
  local linear, modes, springs, exact = table.unpack(list)
  off(linear, exact, 2e-3, 0.005, "linear elements and modes at " .. v)
  for _, ring in ipairs(exact.ringing) do
    if ring.share < 0.1 * (1 - exact.e ^ 2) then break end  -- those that hold a tenth or more of what vibrates
    local share = 0
    for _, other in ipairs(linear.ringing) do
      if math.abs(other.omega / ring.omega - 1) < 0.01 then share = share + other.share end
    end
    assert(math.abs(share / ring.share - 1) < 0.05, ("mode of omega %g at %g: %g for %g"):format(ring.omega, v, share,
      ring.share))
  end
  assert(math.abs(modes.force / linear.force - 1) < 0.05, "force at " .. v)
  local polynomial = ricochet.compare { scene = scene "polynomial", interiors = { "elements", "springs" }, count = 2,
    springs = { nodes = 800, placement = "triangular" }, name = "p" .. i }[1]
  assert(math.abs(polynomial.e - springs.e) < 5e-3, "triangular lattice at " .. v .. ": " .. polynomial.e - springs.e)
  if v <= 0.05 then
    local poisson = ricochet.compare { scene = scene "polynomial", interiors = { "elements", "springs" }, count = 2,
      springs = { nodes = 800, placement = "poisson_disk" }, name = "r" .. i }[2]
    local own = ricochet.theory.modal_disk { nu = poisson.nu, speed = v, alpha = 1000, omega_most = 80 }
    assert(poisson.inverted == 0 and math.abs(poisson.e - own.e) < 6e-3, "Poisson disks at " .. v .. ": " .. poisson.e)
    assert(math.abs(springs.e - exact.e) < 6e-3)
  end
end
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}
