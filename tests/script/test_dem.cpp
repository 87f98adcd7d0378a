// ricochet.dem: tables and lines for codes of discrete elements, and what LAMMPS and YADE make of them.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

// Rough steel disks with friction on a rigid plane: head on at three speeds, oblique at one of them.
const char* steel_rows = R"(local ricochet = require "ricochet"
local steel = ricochet.materials.steel
local function sweep(name, speeds, angles)
  return ricochet.sweep { name = name, over = { sample = ricochet.range(3), speed = speeds, psi1 = angles },
    scene = function(at)
      return ricochet.scene { units = "SI", target = ricochet.plane {}, launch = { speed = at.speed, psi1 = at.psi1 },
        projectile = ricochet.disk { radius = 0.005, material = steel, nodes = 100, roughness = 1e-5, seed = at.sample },
        effects = { ricochet.friction { mu = 0.2, stiffness = 10 } } }
    end }:run()
end
local head_on = sweep("head_on", { 5, 15, 45 }, { 0 })
)";

// The number after `before` in a text.
double number_after(const std::string& text, const std::string& before) {
  const auto at = text.find(before);
  return at == std::string::npos ? std::nan("") : std::atof(text.c_str() + at + before.size());
}

// Rows of the caller's own, as a sweep of SI scenes has them: e at 0.5, 1, 2 and 4 m/s.
std::string made_rows(const std::string& e, const std::string& then) {
  return "local ricochet = require 'ricochet'\nlocal rows, e = {}, " + e + R"(
for i, v in ipairs { 0.5, 1, 2, 4 } do
  for sample = -1, 1 do
    local value = e[i] * (1 + 0.01 * sample)
    rows[#rows + 1] = { status = "finished", units = "SI", sample = sample, psi1 = 0, psi2 = 0, e = value, vn = value * v, inertia = 0.4 }
  end
end
local steel = ricochet.materials.steel
)" + then;
}

// Oblique ones among them, of Walton's impact with mu = 0.2 and beta0 = 0.3.
const char* add_oblique = R"(
for _, psi1 in ipairs { 0.2, 0.4, 0.6, 2, 3, 4 } do
  for sample = -1, 1 do
    local psi2 = math.max(-0.3 * psi1, psi1 - 3.5 * 0.2 * (1 + e[2])) * (1 + 1e-3 * sample)
    rows[#rows + 1] = { status = "finished", units = "SI", sample = sample, psi1 = psi1, psi2 = psi2, e = e[2], vn = e[2], inertia = 0.4 }
  end
end
)";

}  // namespace

TEST_CASE("dem: the table holds e of the rows at every speed, and mu and beta0 of the oblique ones") {
  const Workplace here;
  const Ended ended = here.script(std::string(steel_rows) + R"(
local oblique = sweep("oblique", { 15 }, { 0.3, 0.6, 1, 2, 3, 4 })
local t = ricochet.dem { rows = head_on, oblique = oblique, projectile = steel, name = "steel" }
assert(#t.e == 3 and math.abs(t.at / 15 - 1) < 1e-6, t.at)
for i, line in ipairs(head_on:summary { by = "speed", of = { "e" } }) do
  assert(math.abs(t.e[i].v / line.speed - 1) < 1e-6 and t.e[i].count == 3)
  assert(math.abs(t.e[i].e - line.e.mean) < 1e-12 and math.abs(t.e[i].e_se - line.e.se) < 1e-12)
end
assert(math.abs(t.e_at - t.e[2].e) < 1e-12)
assert(math.abs(t.mu - 0.2) < 0.1 and t.mu_se > 0 and t.beta0_se > 0, t.mu)
)",
                                  "--quiet");
  INFO(ended.out << ended.err);
  REQUIRE(ended.status == 0);
  CHECK_THAT(ended.out,
             Contains("These codes take one e for all speeds: ") && Contains("that at a normal speed of 15 m/s"));
  CHECK_THAT(here.read("out/s/steel_dem.csv"), Contains("v [m/s],e,e_se,impacts\n5,") && Contains("\n45,"));
  const std::string json = here.read("out/s/steel_dem.json");
  CHECK(number_after(json, "\"constant_e\": { \"v\": ") == Approx(15));
  CHECK(number_after(json, "\"mu\": { \"value\": ") == Approx(0.2).margin(0.1));
  CHECK_THAT(here.read("out/s/steel_dem_mercury.cpp"),
             Contains("Not run") && Contains("setSlidingFrictionCoefficient"));
}

TEST_CASE("dem: the files tell what a constant e misses at a third and at three times its speed") {
  const Workplace here;
  const Ended ended = here.script(made_rows("{ 0.95, 0.9, 0.85, 0.8 }", R"(
local t = ricochet.dem { rows = rows, projectile = steel, target = ricochet.materials.glass, at = 1.5 }
-- Between the measured speeds e is straight in their logarithm.
assert(math.abs(t.e_at - (0.9 - 0.05 * math.log(1.5, 2))) < 1e-12, t.e_at)
assert(t.mu ~= t.mu)
)"));
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  const std::string text = here.read("out/s/pair_dem.lammps");
  CHECK_THAT(text,
             Contains("At a third of that speed it is -0.0792 off; at three times that speed nothing was measured.") &&
                 Contains("mu and beta0 are not known: no oblique impacts (psi1 > 0) were given") &&
                 Contains("tangential linear_nohistory 0.0 0.0 damping tsuji\n"));
  CHECK_THAT(here.read("out/s/pair_dem.json"), Contains("\"exceeds_at_three_times\": null"));
  // E of an equal pair that has the E* of steel on glass.
  const double one = (1 - 0.29 * 0.29) / 205e9, other = (1 - 0.22 * 0.22) / 72e9;
  CHECK(number_after(text, "hertz/material ") == Approx(2 * (1 - 0.29 * 0.29) / (one + other)).epsilon(1e-5));
}

TEST_CASE("dem: rows that tell no e for such a code are refused with a remedy") {
  const Workplace here;
  const auto first_line = [&](const std::string& text) { return here.script(text, "--force").first_line(); };
  CHECK_THAT(first_line(made_rows("{ 0.9, 0.9, 0.9, 0.9 }",
                                  "for _, row in ipairs(rows) do row.units = nil end\n"
                                  "ricochet.dem { rows = rows, projectile = steel }")),
             Contains("dem: the rows are in the paper's units") && Contains("give the scenes units = \"SI\""));
  CHECK_THAT(first_line(made_rows("{ 0.9, 0.9, 0.9, 0.9 }",
                                  "for _, row in ipairs(rows) do row.psi1 = 1 end\n"
                                  "ricochet.dem { rows = rows, projectile = steel }")),
             Contains("dem: no head-on impact (psi1 = 0) has finished"));
  CHECK_THAT(
      first_line(made_rows("{ 0.9, 0.9, 0.9, 0.9 }", "ricochet.dem { rows = rows, projectile = steel, at = 7 }")),
      Contains("dem: e was measured from 0.5 to 4 m/s, not at 7; name a speed between"));
  CHECK_THAT(first_line(made_rows("{ 1.1, 1.1, 1.1, 1.1 }", "ricochet.dem { rows = rows, projectile = steel }")),
             Contains("these codes take no e above 1"));
}

TEST_CASE("dem: materials that are not those of the rows are refused, and rows of another run are told") {
  const Workplace here;
  const auto run = [&](const std::string& call, const std::string& more = "") {
    return here.script(R"(local ricochet = require "ricochet"
local steel, glass = ricochet.materials.steel, ricochet.materials.glass
local function rows_on(target)
  return ricochet.sweep { name = "drops", over = { speed = { 5, 15 } }, scene = function(at)
    return ricochet.scene { units = "SI", target = target, launch = { speed = at.speed },
      projectile = ricochet.disk { radius = 0.005, material = steel, interior = "elements", nodes = 60,
        state = "plane_strain" } }
  end }:run()
end
local function block(material)
  return ricochet.rectangle { width = 0.02, height = 0.005, material = material, interior = "elements", nodes = 60,
    state = "plane_strain" }
end
)" + call + more,
                       "--quiet --force");
  };
  const std::string onto_plane = "local rows = rows_on(ricochet.plane {})\n",
                    onto_glass = "local rows = rows_on(block(glass))\n";
  CHECK(run(onto_plane, "ricochet.dem { rows = rows, projectile = steel }").status == 0);
  CHECK(run(onto_glass, "ricochet.dem { rows = rows, projectile = steel, target = glass }").status == 0);
  CHECK_THAT(here.read("out/s/pair_dem.lammps"), !Contains("of another run"));
  CHECK_THAT(run(onto_plane, "ricochet.dem { rows = rows, projectile = glass }").err,
             Contains("dem: the projectiles of the rows are of E = 2.05e+11 Pa, nu = 0.29") &&
                 Contains("'projectile' is of E = 7.2e+10 Pa") && Contains("name the rows' material"));
  CHECK_THAT(
      run(onto_plane, "ricochet.dem { rows = rows, projectile = steel, target = glass }").err,
      Contains("the targets of the rows are rigid, and 'target' is of E = 7.2e+10 Pa") && Contains("leave it out"));
  CHECK_THAT(run(onto_glass, "ricochet.dem { rows = rows, projectile = steel }").err,
             Contains("the targets of the rows are of E = 7.2e+10 Pa") && Contains("'target' is not given"));
  CHECK_THAT(run(onto_glass, "ricochet.dem { rows = rows, projectile = steel, target = steel }").err,
             Contains("the targets of the rows are of E = 7.2e+10 Pa") && Contains("name the rows' material"));
  REQUIRE(
      here.script(made_rows("{ 0.9, 0.9, 0.9, 0.9 }", "ricochet.dem { rows = rows, projectile = steel }"), "--force")
          .status == 0);
  CHECK_THAT(here.read("out/s/pair_dem.csv"), Contains("whether their bodies were of these materials is not known"));
}

TEST_CASE("dem: LAMMPS returns the e that its lines are to give, to 2 %") {
  const Workplace here;
  if (here.shell("lmp -h | grep -q GRANULAR").status != 0) {
    WARN("skipped: LAMMPS with its package GRANULAR is not installed (apt-get install lammps)");
    return;
  }
  for (const double e : {0.98, 0.9, 0.7, 0.4}) {
    const std::string list = fmt::format("{{ {0}, {0}, {0}, {0} }}", e);
    const std::string lines = "ricochet.dem { rows = rows, projectile = steel }";
    REQUIRE(here.script(made_rows(list, add_oblique + lines), "--force").status == 0);
    CHECK_THAT(here.read("out/s/pair_dem.lammps"), Contains(" tangential mindlin NULL 1.0 0.2"));
    here.write("bounce.in", R"lammps(units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
region box block -0.01 0.01 -0.01 0.01 -0.001 0.019
create_box 1 box
create_atoms 1 single 0 0 0.005000001
set type 1 diameter 0.01 density 7850
include out/s/pair_dem.lammps
fix move all nve/sphere
velocity all set 0 0 -${v}
timestep 1e-8
thermo 10000
variable vz equal vcm(all,z)
run 20000
print "returned $(v_vz/v_v)"
)lammps");
    for (const double v : {1 / 3.0, 1.0, 3.0}) {
      const Ended ended = here.shell(fmt::format("lmp -in bounce.in -var v {} -log none", v));
      INFO(ended.out << ended.err);
      REQUIRE(ended.status == 0);
      CHECK(number_after(ended.out, "\nreturned ") == Approx(e).epsilon(0.02));
    }
  }
}

TEST_CASE("dem: YADE returns the e that its lines give, to 2 %") {
  const Workplace here;
  if (here.shell("yade --version").status != 0) {
    WARN("skipped: YADE is not installed (apt-get install yade)");
    return;
  }
  const std::string lines = "ricochet.dem { rows = rows, projectile = steel, target = ricochet.materials.glass }";
  REQUIRE(here.script(made_rows("{ 0.9, 0.9, 0.9, 0.9 }", add_oblique + lines)).status == 0);
  here.write("bounce.py", R"(exec(open('out/s/pair_dem_yade.py').read())
ball = O.bodies.append(sphere((0, 0, 0.005000001), 0.005, material='projectile'))
O.bodies.append(wall(0, axis=2, material='target'))
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
             InteractionLoop([Ig2_Wall_Sphere_ScGeom()], [dem_physics], [dem_law]), NewtonIntegrator(damping=0)]
O.bodies[ball].state.vel = (0, 0, -1)
O.dt = 1e-8
O.run(20000, True)
print('\nreturned %r' % O.bodies[ball].state.vel[2])
)");
  const Ended ended = here.shell("yade -n -x -j1 bounce.py");
  INFO(ended.out << ended.err);
  CHECK(number_after(ended.out, "\nreturned ") == Approx(0.9).epsilon(0.02));
}
