// Materials and SI, through scripts.

#include <catch2/catch.hpp>

#include "program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;

TEST_CASE("SI: an impact is that of the paper's units, scaled, to 1e-9") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local steel = ricochet.material { E = 205e9, nu = 0.29, density = 7850 }
local R, thickness = 0.005, 0.02
-- What the paper's disk is worth: density 800/pi m0/R^2, stiffness 1e4 m0 c^2/R^2.
local m0 = steel.density * thickness * R ^ 2 / (800 / math.pi)
local time = math.sqrt(1e4 * m0 / (steel.E * thickness / (2 / math.sqrt(3))))
local c = R / time
local function scene(length, mass, speed, disk, wall, units)
  disk.radius, disk.nodes, disk.placement, disk.roughness = length, 100, "triangular", 0.01 * length
  wall.width, wall.depth, wall.nodes, wall.placement = 4 * length, 1.5 * length, 300, "triangular"
  return ricochet.scene { projectile = ricochet.disk(disk), target = ricochet.wall(wall), units = units,
    launch = { speed = 0.3 * speed, psi1 = 0.5, spin = 0.01 * speed / length },
    contact = { V0 = 150 * mass * speed ^ 2, xi = 300 / length, reach = 0.1 * length, sides = "two" },
    effects = { ricochet.damping { time = 1e-3 * length / speed }, ricochet.gravity { g = 1e-3 * speed ^ 2 / length } } }
end
local si = scene(R, m0, c, { material = steel, thickness = thickness },
  { material = ricochet.material { E = 70e9, nu = 0.3, density = 2700 }, thickness = thickness }, "SI"):run()
local paper = scene(1, 1, 1, { quartic = 0 },
  { quartic = 0, stiffness = 1e4 * 70 / 205, density = 800 / math.pi * 2700 / 7850 }):run()
assert(si.status == "finished" and si.units == "SI" and paper.units == "paper")
local worth = { e = 1, beta = 1, mu = 1, vn = c, omega = c / R, contact_time = time, indentation = R, impulse_n = m0 * c,
  after_projectile_vibration = m0 * c ^ 2, step = time, damping_energy = m0 * c ^ 2 }
for column, one in pairs(worth) do
  assert(math.abs(si[column] / (paper[column] * one) - 1) < 1e-9, column .. ": " .. si[column] .. " " .. paper[column] * one)
end
local estimate = ricochet.estimate(scene(R, m0, c, { material = steel, thickness = thickness },
  { material = steel, thickness = thickness }, "SI"))
assert(tostring(estimate.force):match "^%S+ N$" and tostring(estimate.e):match "^nan.*no law holds here%)$", tostring(estimate.e))
assert(estimate.contact_time.unit == "s" and estimate.force.unit == "N" and estimate.pressure.unit == "Pa")
assert(math.abs(estimate.wave_speed.value / math.sqrt(205e9 / 7850 / (1 - 1 / 9)) - 1) < 1e-9)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("SI: files and summaries name the units") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
ricochet.sweep { name = "s", over = { speed = { 100, 200 } }, scene = function(at)
  return ricochet.scene { units = "SI", target = ricochet.plane {}, launch = { speed = at.speed },
    projectile = ricochet.disk { radius = 0.005, nodes = 60, material = ricochet.materials.aluminium } }
end }:run():summary { by = "speed", of = { "contact_time" } }:print()
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Contains("contact_time [s] +- se"));
  CHECK_THAT(ended.out, Contains("estimated: v/c_P 0.01"));
  CHECK_THAT(ended.out, Contains("over_yield: in 2 of 2 impacts"));
  CHECK_THAT(here.read("out/s/results.csv"), Contains("vn [m/s]") && Contains("before_total [J]"));
}

TEST_CASE("materials: what contradicts itself is refused at its line, with a remedy") {
  const Workplace here;
  const auto refused = [&](const std::string& scene) {
    const Ended ended =
        here.script("local ricochet = require \"ricochet\"\nlocal steel = ricochet.materials.steel\n" + scene);
    CHECK(ended.status != 0);
    return ended.err;
  };
  CHECK_THAT(refused("ricochet.scene { projectile = ricochet.disk { radius = 0.005, material = steel }, target = "
                     "ricochet.plane {} }"),
             Contains("give the scene units = \"SI\""));
  CHECK_THAT(refused("ricochet.scene { units = \"SI\", projectile = ricochet.disk {}, target = ricochet.plane {} }"),
             Contains("is of no material"));
  CHECK_THAT(refused("ricochet.disk { radius = 0.005, material = steel, stiffness = 1e4 }"),
             Contains("follows from the material"));
  CHECK_THAT(refused("ricochet.disk { thickness = 2 }"), Contains("give material too"));
  CHECK_THAT(refused("ricochet.material { E = 210e9, nu = 0.3, density = 7.85 }"),
             Contains("'density'") && Contains("waves of 1.6e+05 m/s") && Contains("kg/m^3 (steel has 7850)"));
  CHECK_THAT(refused("ricochet.wall { width = 1, depth = 1, material = steel, interior = \"rigid\" }"),
             Contains("rigid"));
  CHECK_THAT(
      refused("ricochet.scene { units = \"SI\", projectile = ricochet.disk { radius = 0.005, material = steel }, "
              "target = ricochet.plane {}, launch = { speed = 1 }, step = 1 }:run()"),
      Contains(" s is unstable: ") && Contains(" 1/s); ") && !Contains("R/c"));
  CHECK_THAT(refused("ricochet.wall { material = steel, width = 1 }"), Contains("'depth' has no usual value"));
  CHECK_THAT(
      refused("ricochet.scene { units = \"SI\", projectile = ricochet.disk { radius = 0.005, material = steel }, "
              "target = ricochet.plane {} }"),
      Contains("give launch = { speed = ... } in m/s"));
  CHECK_THAT(refused("print(steel.Youngs)"), Contains("Youngs"));
  CHECK_THAT(
      refused("ricochet.scene { units = \"SI\", projectile = ricochet.disk { radius = 0.005, material = steel },\n"
              "  target = ricochet.wall { width = 0.03, depth = 0.01, material = steel, thickness = 0.02 }, launch "
              "= { speed = 1 } }"),
      Contains("give both the same thickness"));
}

TEST_CASE("materials: a Poisson's ratio that a lattice cannot have is told") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
ricochet.disk { radius = 0.005, material = ricochet.materials.steel, placement = "triangular" }
ricochet.disk { radius = 0.005, material = ricochet.materials.glass, placement = "triangular" }
local band = ricochet.body { outline = { { 0, 0 }, { 0.1, 0 }, { 0.1, 0.4 }, { 0, 0.4 } }, nodes = 900, placement = "triangular",
  material = ricochet.materials.steel }
local moduli = ricochet.elasticity { body = band }
assert(math.abs(moduli.E / 205e9 - 1) < 0.1, moduli.E)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.err, Contains("nu = 0.22") && !Contains("nu = 0.29"));
}

TEST_CASE("numbers in MPa or GPa are told, not taken for Pa") {
  const Workplace here;
  const auto run = [&](const std::string& material, const std::string& last) {
    return here.script("local ricochet = require 'ricochet'\nlocal odd = ricochet.material { " + material + R"(,
  nu = 0.33, density = 2700 }
local scene = ricochet.scene { units = "SI", target = ricochet.plane {}, launch = { speed = 3 },
  projectile = ricochet.disk { radius = 0.005, material = odd, nodes = 100, interior = "elements",
    state = "plane_strain" }, effects = { ricochet.yielding {} } }
)" + last,
                       "--quiet --force");
  };
  const std::string estimated = "for _, w in ipairs(ricochet.estimate(scene).warnings) do print(w.kind, w.reason) end";
  CHECK_THAT(run("E = 70, yield = 1", estimated).out, Contains("supersonic") && Contains("in SI, are E and density"));
  CHECK_THAT(run("E = 70e9, yield = 276e6", estimated).out, !Contains("supersonic"));
  CHECK_THAT(run("E = 70e9, yield = 276", "scene:run()").first_line(),
             Contains("has a yield stress of 3.9e-09 of its E") && Contains("in SI both are in Pa"));
}

TEST_CASE("SI: mistakes are told in the units in which the script was written") {
  const Workplace here;
  const auto told = [&](const std::string& text) {
    const Ended ended = here.script(
        "local ricochet = require \"ricochet\"\nlocal steel = ricochet.materials.steel\n" + text, "--force");
    INFO(text);
    CHECK_THAT(ended.err + ended.out, !Contains("R/c") && !Contains(" R ") && !Contains(" c "));
    return ended.err + ended.out;
  };
  const auto scene = [](const std::string& fields) {
    return "local scene = ricochet.scene { units = \"SI\", projectile = ricochet.disk { radius = 0.005, nodes = 60, "
           "material = steel }, target = ricochet.plane {}, " +
           fields + " }\n";
  };
  const std::string launch = "launch = { speed = 1 }";
  CHECK_THAT(told(scene(launch + ", step = 'a'")), Contains("'step' must be a number [s], is"));
  CHECK_THAT(told(scene(launch + ", time_limit = -1")), Contains("'time_limit' must be greater than 0 s, is -1"));
  CHECK_THAT(told(scene("launch = { speed = 'fast' }")), Contains("'speed' must be a number [m/s]"));
  CHECK_THAT(told(scene(launch + ", contact = { xi = -1 }")), Contains("'xi' must be greater than 0 1/m, is -1"));
  CHECK_THAT(told(scene(launch + ", time_limit = 1e-4, ending = { at = \"time\", time = 1e-3 }")),
             Contains("0.0001 s is before ending.time, 0.001 s"));
  CHECK_THAT(told("ricochet.disk { radius = -1, material = steel }"),
             Contains("'radius' must be greater than 0 m, is -1"));
  CHECK_THAT(told(scene(launch) + "ricochet.contact_sheet { scene = scene, times = { 1e9 }, out = 'x' }"),
             Contains(" s and ") && Contains(" s, one is 1e+09 s"));
  CHECK_THAT(told(scene(launch + ", effects = { ricochet.gravity { g = 9.81 } }, time_limit = 1e-3") +
                  "scene:bounces { count = 3 }"),
             Contains("the time_limit of 0.001 s was over"));
  // As deep as a hundredth of the radius, in a contact that is far too soft.
  CHECK_THAT(told(scene(launch + ", contact = { V0 = 1e-4, xi = 3e4 }") + "scene:run()"),
             Contains("penetration: in 1 of 1 impacts a node stood deeper inside the other body than a hundredth"));
}
