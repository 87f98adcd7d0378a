// Bodies of revolution as scripts describe them.

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "script/program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;

TEST_CASE("scripts: a sphere of elements meets a plane as Hertz says, in SI and in the paper's units") {
  const Ended ended = script_with_module(R"(
local magnesium, R, speed = ricochet.material { E = 40e9, nu = 0.35, density = 1800 }, 0.1, 0.2
local c0 = math.sqrt(40e9 / 1800)
local function scene(t, speed, units)
  t.h_min, t.h_max = 0.05 * t.radius, 0.2 * t.radius
  return ricochet.scene { projectile = ricochet.sphere(t), target = ricochet.plane {}, units = units,
    launch = { speed = speed } }
end
local function near(a, b, share) assert(math.abs(a / b - 1) < share, a .. " " .. b) end
local slow = ricochet.estimate(scene({ radius = R, material = magnesium }, speed, "SI"))
assert(slow.force.unit == "N" and slow.pressure.unit == "Pa" and slow.force.in_range)
near(slow.force.value, 7232.7, 1e-4)
near(slow.contact_time.value, 2.9432752 * slow.overlap.value / speed, 1e-9)
near(slow.wave_speed.value, c0 * math.sqrt(0.65 / (1.35 * 0.3)), 1e-9)
local si = scene({ radius = R, material = magnesium }, 0.02 * c0, "SI"):run()
local paper = scene({ radius = 1, E = 1e4, nu = 0.35 }, 0.02 * math.sqrt(1e4 / (800 / math.pi))):run()
assert(si.status == "finished" and paper.status == "finished")
assert(math.abs(si.e - paper.e) < 1e-8 and si.e > 0.99 and si.e < 1, si.e .. " " .. paper.e)
near(si.contact_time, paper.contact_time * R * math.sqrt(1e4 / (800 / math.pi)) / c0, 1e-8)
local hertz = ricochet.estimate(scene({ radius = R, material = magnesium }, 0.02 * c0, "SI"))
near(si.contact_time, hertz.contact_time.value, 0.1)
near(si.contact_length, hertz.contact_length.value, 0.2)
assert(math.abs(si.inertia - 0.4) < 0.01 and si.omega == 0 and si.vt == 0)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: cylinders and spheres of revolution are as heavy as their outlines, and are drawn whole") {
  const Ended ended = script_with_module(R"(
local sphere = ricochet.sphere { E = 1e4, nu = 0.3, h_min = 0.05 }
for name, body in pairs { sphere = sphere, cylinder = ricochet.cylinder { height = 3, E = 1e4, nu = 0.3, nodes = 200 } } do
  local mesh = ricochet.mesh { body = body }
  assert(mesh.quality > 0.3 and math.abs(mesh.mass_error) < 0.01, name .. " " .. mesh.mass_error)
end
local scene = ricochet.scene { projectile = sphere, target = ricochet.plane {}, launch = { speed = 0.1 } }
ricochet.still { scene = scene, size = { 160, 90 }, show = { material = "von_mises" } }
local rows = ricochet.series { scene = scene, of = { "force_n", "force_t", "contact_length" } }
assert(#rows > 100 and rows[#rows].force_t == 0)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: a sphere is finest where it touches, unless its nodes are given") {
  const Ended ended = script_with_module(R"(
local given = { radius = 0.01, material = ricochet.materials.steel }
local usual = ricochet.sphere(given)
assert(given.h_min == nil)
given.h_min = 2e-4
local graded = ricochet.mesh { body = ricochet.sphere(given) }
assert(ricochet.mesh { body = usual }.triangles == graded.triangles)
given.h_min, given.nodes = nil, 800
assert(ricochet.mesh { body = ricochet.sphere(given) }.triangles ~= graded.triangles)
local scene = ricochet.scene { units = "SI", projectile = usual, target = ricochet.plane {}, launch = { speed = 0.5 } }
local row, hertz = scene:run(), ricochet.estimate(scene)
assert(math.abs(row.contact_time / hertz.contact_time.value - 1) < 0.02, row.contact_time)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: a series tells stresses in Pa, of a sphere, a half-space, and of disks whatever their thickness") {
  const Ended ended = script_with_module(R"(
local steel = ricochet.materials.steel
local of = { "force_n", "pressure_max", "von_mises_max", "von_mises_depth", "target_von_mises_max", "target_von_mises_depth" }
local made = 0
local function most(scene)
  local most = {}
  made = made + 1
  for _, row in ipairs(ricochet.series { scene = scene, of = of, points = 40, name = "stress" .. made }) do
    for name, value in pairs(row) do
      if type(value) == "number" and value == value then most[name] = math.max(most[name] or 0, value) end
    end
  end
  return most
end
local function near(a, b, share) assert(math.abs(a / b - 1) < share, a .. " " .. b) end
local R, h = 0.01, 6e-4
local scene = ricochet.scene { units = "SI", launch = { speed = 20 },
  projectile = ricochet.sphere { radius = R, material = steel, h_min = h, h_max = 0.3 * R },
  target = ricochet.half_space { extent = 4 * R, material = steel, h_min = h, h_max = R },
  effects = { ricochet.absorbing_edges {} } }
local stress, hertz = most(scene), ricochet.estimate(scene)
near(stress.von_mises_max, 0.62 * hertz.pressure.value, 0.2)
near(stress.target_von_mises_max, stress.von_mises_max, 0.15)
assert(stress.target_von_mises_depth < R)
local disks = {}
for i, thickness in ipairs { 1, 0.5 } do
  disks[i] = most(ricochet.scene { units = "SI", launch = { speed = 20 }, target = ricochet.plane {},
    projectile = ricochet.disk { radius = R, material = steel, thickness = thickness, interior = "elements",
      state = "plane_strain", h_min = 0.1 * R } })
  assert(disks[i].target_von_mises_max == nil)
end
near(disks[1].von_mises_max, disks[2].von_mises_max, 1e-6)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: what breaks the symmetry of an axisymmetric body is refused by name") {
  const auto refused = [](const std::string& fields, const std::string& target = "ricochet.plane {}") {
    const Ended ended = script_with_module(
        "local ball = ricochet.sphere { E = 1e4, nu = 0.3, h_min = 0.2 }\n"
        "ricochet.scene { projectile = ball, target = " +
        target + ", " + fields + " }:run()");
    CHECK(ended.status != 0);
    return ended.err;
  };
  CHECK_THAT(refused("launch = { psi1 = 1 }"), Contains("'psi1': slants the flight"));
  CHECK_THAT(refused("launch = { angle = 10 }"), Contains("'angle': slants the flight"));
  CHECK_THAT(refused("launch = { normal_speed = 0.1, tangential_speed = 0.1 }"),
             Contains("'tangential_speed': slants"));
  CHECK_THAT(refused("launch = { spin = 0.1 }"), Contains("'spin': turns the projectile off its axis"));
  CHECK_THAT(refused("launch = { at = 0.1 }"), Contains("'at': takes the projectile beside"));
  CHECK_THAT(refused("contact = { V0 = 150 }"), Contains("'V0': is that of a rim node"));
  CHECK_THAT(refused("effects = { ricochet.friction { mu = 0.3 } }"), Contains("friction acts on all rim nodes alike"));
  CHECK_THAT(refused("", "ricochet.wall { nodes = 100 }"),
             Contains("'target': is of a plane section, and another body is axisymmetric"));
  CHECK_THAT(refused("", "ricochet.disk { interior = 'rigid' }"), Contains("'target': is of a plane section"));
  CHECK_THAT(script_with_module("ricochet.sphere { E = 1, nu = 0.3, h_min = 0.2, state = 'plane_strain' }").err,
             Contains("'state': this shape is a body of revolution"));
  CHECK_THAT(script_with_module("ricochet.disk { interior = 'elements', state = 'axisymmetric', E = 1, nu = 0.3 }").err,
             Contains("'outline': of an axisymmetric body is the half of its section at x >= 0"));
  CHECK_THAT(script_with_module(
                 "ricochet.sphere { radius = 1, thickness = 1, material = ricochet.materials.steel, h_min = 0.1 }")
                 .err,
             Contains("'thickness': says nothing of an axisymmetric body"));
  CHECK_THAT(script_with_module("ricochet.elasticity { body = ricochet.cylinder { E = 1, nu = 0.3 } }").err,
             Contains("must be of a plane"));
}

TEST_CASE("scripts: a recorded sphere that yields is drawn to the same bytes as while it ran") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local metal = ricochet.material { E = 200e9, nu = 0.3, density = 7800, yield = 1e9, hardening = 1e9 }
local scene = ricochet.scene { units = "SI", target = ricochet.plane {}, launch = { speed = 30 },
  projectile = ricochet.sphere { radius = 0.01, material = metal, h_min = 5e-4 }, effects = { ricochet.yielding {} } }
local row = scene:run()
local paper = ricochet.scene { target = ricochet.plane {}, launch = { speed = 0.03 }, effects = { ricochet.yielding { yield = 50 } },
  projectile = ricochet.sphere { E = 1e4, nu = 0.3, h_min = 0.1 } }
ricochet.animate { scene = paper, frames = 4, from = 0, size = { 160, 90 }, show = { material = "plastic_strain" } }
ricochet.record { scene = paper, frames = 4 }
assert(row.plastic_strain_most > 0.01 and row.yielding_energy > 0.5 * row.before_total)
assert(row.dent > 0.5 * row.overlap and row.dent < row.overlap, row.dent .. " " .. row.overlap)
assert(row.over_yield ~= row.over_yield)
-- The numbers of the material, given by hand.
local given = ricochet.scene { units = "SI", target = ricochet.plane {}, launch = { speed = 30 },
  projectile = ricochet.sphere { radius = 0.01, material = metal, h_min = 5e-4 },
  effects = { ricochet.yielding { yield = 1e9, hardening = 1e9 } } }
assert(math.abs(given:run().e - row.e) < 1e-9)
)");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK(here.shell("ricochet render out/s/trajectory.h5 --size 160x90 material=plastic_strain").status == 0);
  CHECK(here.shell("diff -r out/s/frames out/s/trajectory_frames").status == 0);
}
