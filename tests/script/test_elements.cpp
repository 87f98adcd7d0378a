// Bodies of elements as scripts describe them.

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "script/program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;

TEST_CASE("scripts: elasticity of elements returns E and nu, in units of the paper and in SI") {
  const Ended ended = script_with_module(R"(
local function band(t, size)
  t.interior, t.outline = "elements", { { 0, 0 }, { size, 0 }, { size, 4 * size }, { 0, 4 * size } }
  return ricochet.elasticity { body = ricochet.body(t) }
end
local function near(a, b) assert(math.abs(a / b - 1) < 1e-10, a .. " " .. b) end
for _, state in ipairs { "plane_stress", "plane_strain" } do
  local sheet = band({ nodes = 200, E = 50, nu = 0.3, state = state }, 1)
  near(sheet.E, 50)
  near(sheet.nu, 0.3)
  local steel = ricochet.materials.steel
  local cut = band({ nodes = 200, material = steel, state = state, thickness = 0.01 }, 0.1)
  near(cut.E, steel.E)
  near(cut.nu, steel.nu)
  near(band({ h_min = 0.05, h_max = 0.2, E = 50, nu = 0.3, state = state }, 1).E, 50)
  near(band({ h_min = 0.05, h_max = 0.2, mesh = "crossed", E = 50, nu = 0.3, state = state }, 1).E, 50)
end
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: a mesh is fine where it is asked to be, good, and as heavy as its outline") {
  const Ended ended = script_with_module(R"(
local hole = {}
for i = 1, 60 do hole[i] = { 0.4 * math.cos(i * math.pi / 30), 0.4 * math.sin(i * math.pi / 30) } end
for name, body in pairs {
  disk = ricochet.disk { interior = "elements", E = 1, nu = 0.3, h_min = 0.02 },
  even = ricochet.disk { interior = "elements", E = 1, nu = 0.3, h_min = 0.1, h_max = 0.1 },
  ring = ricochet.disk { interior = "elements", E = 1, nu = 0.3, h_min = 0.05, h_max = 0.1, holes = { hole } },
  wall = ricochet.wall { interior = "elements", E = 1, nu = 0.3, h_min = 0.05, width = 4, depth = 2 },
} do
  local m = ricochet.mesh { body = body }
  print(name, m.nodes, m.triangles, m.quality, m.shortest, m.longest, m.mass_error)
  assert(m.quality > 0.5, name .. " quality " .. m.quality)
  assert(math.abs(m.mass_error) < 0.005, name .. " mass " .. m.mass_error)
end
local crossed = ricochet.mesh { body = ricochet.rectangle { interior = "elements", E = 1, nu = 0.3, width = 1,
  height = 0.5, h_min = 0.1, h_max = 0.1, mesh = "crossed" } }
assert(crossed.nodes == 11 * 6 + 50 and crossed.triangles == 200 and math.abs(crossed.mass_error) < 1e-12)
assert(crossed.quality > 0.89 and math.abs(crossed.longest - 0.1) < 1e-12)
local m = ricochet.mesh { body = ricochet.disk { interior = "elements", E = 1, nu = 0.3, h_min = 0.02 } }
assert(m.shortest < 0.02 and m.longest > 0.1 and m.longest < 0.25)
)");
  INFO(ended.out + ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: a meshed body in SI is that of the paper's units, scaled") {
  const Ended ended = script_with_module(R"(
local steel, R, E, density = ricochet.materials.steel, 0.007, 1e4, 800 / math.pi
local function wave_speed(modulus, mass) return math.sqrt(modulus / mass / (1 - steel.nu ^ 2)) end
local function row(t, speed, xi, units)
  t.interior, t.h_max = "elements", 3 * t.h_min
  return ricochet.scene { projectile = ricochet.disk(t), target = ricochet.plane {}, units = units,
    launch = { speed = 0.05 * speed }, contact = { xi = xi } }:run()
end
for _, h in ipairs { 0.05, 0.07, 0.11 } do
  local si = row({ radius = R, material = steel, h_min = h * R }, wave_speed(steel.E, steel.density), 1000 / R, "SI")
  local plain = row({ E = E, nu = steel.nu, h_min = h }, wave_speed(E, density), 1000)
  assert(math.abs(si.e - plain.e) < 1e-8, si.e .. " " .. plain.e)
end
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: E and density of elements may depend on the place, and a scene of them may be refined") {
  const Ended ended = script_with_module(R"(
local disk = ricochet.disk { interior = "elements", h_min = 0.1, nu = 0.3,
  E = function(x, y) return y < 0 and 1e4 or 2e4 end, density = function(x, y) return 200 + x end }
local scene = ricochet.scene { projectile = disk, target = ricochet.plane {}, launch = { speed = 0.05 } }
local coarse, fine = scene:run(), ricochet.refined(scene, 4):run()
assert(coarse.status == "finished" and fine.status == "finished")
assert(math.abs(coarse.e - fine.e) < 0.01, coarse.e .. " " .. fine.e)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: nu of elements may depend on the place, and layers have the modulus of their laminate") {
  const Ended ended = script_with_module(R"(
local function near(a, b, by) assert(math.abs(a / b - 1) < by, a .. " " .. b) end
local function strip(nu)
  return ricochet.elasticity { body = ricochet.rectangle { interior = "elements", E = 50, nu = nu,
    state = "plane_strain", width = 2, height = 2, h_min = 0.025, h_max = 0.025, mesh = "crossed" } }
end
local plain, same = strip(0.3), strip(function() return 0.3 end)
assert(plain.E == same.E and plain.nu == same.nu)
local a, b = 0.1, 0.45
local function stiff(nu, E) return (E or 50) / (1 - nu ^ 2) end  -- in the plane
-- Side by side, each contracts as it likes: the mean, exactly.
local beside = strip(function(x, y) return x < 0.01 and a or b end)
near(stiff(beside.nu, beside.E), (stiff(a) + stiff(b)) / 2, 0.01)
-- One upon another they contract alike; between what stresses and strains alike everywhere would have.
local function voigt()
  local pressure, lambda = 0, 0
  for _, nu in ipairs { a, b } do
    local l = 50 * nu / ((1 + nu) * (1 - 2 * nu))
    pressure, lambda = pressure + (l + 50 / (1 + nu)) / 2, lambda + l / 2
  end
  return pressure - lambda ^ 2 / pressure
end
local above = strip(function(x, y) return math.floor(y / 0.2 + 0.01) % 2 == 0 and a or b end)
local lowest, highest = 2 / (1 / stiff(a) + 1 / stiff(b)), voigt()
local measured = stiff(above.nu, above.E)
assert(measured > lowest and measured < highest, measured)
local function ratio(nu) return nu / (1 - nu) end
local compliance = ((1 - ratio(a) ^ 2) / stiff(a) + (1 - ratio(b) ^ 2) / stiff(b)) / 2
  + ((ratio(a) + ratio(b)) / 2) ^ 2 / ((stiff(a) + stiff(b)) / 2)
print(stiff(beside.nu, beside.E), (stiff(a) + stiff(b)) / 2, measured, 1 / compliance, lowest, highest)
near(measured, 1 / compliance, 0.025)  -- free edges and elements across a joint are softer

-- All that a scene does with it.
local function disk(nu, fields)
  local t = { interior = "elements", h_min = 0.12, E = 1e4, nu = nu }
  for k, v in pairs(fields or {}) do t[k] = v end
  return ricochet.disk(t)
end
local function row(nu, fields)
  return ricochet.scene { projectile = disk(nu, fields), target = ricochet.plane {}, launch = { speed = 0.05 } }:run()
end
for _, fields in ipairs { {}, { interior = "modes", modes = 40 }, { state = "plane_strain", law = "linear" } } do
  local number = row(0.3, fields)
  local constant = row(function() return 0.3 end, fields)
  assert(number.status == "finished" and number.e == constant.e and number.contact_time == constant.contact_time)
  assert(number.after_projectile_vibration == constant.after_projectile_vibration)
  assert(number.scene_hash ~= constant.scene_hash)
  local graded = row(function(x, y) return 0.2 + 0.2 * y end, fields)
  assert(graded.status == "finished" and graded.e ~= number.e and math.abs(graded.e - number.e) < 0.05)
end
)");
  INFO(ended.out + ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: accuracy of a body of elements tells what the size of its mesh changes") {
  const Ended ended = script_with_module(R"(
local scene = ricochet.scene { target = ricochet.plane {}, launch = { speed = 0.3 },
  projectile = ricochet.disk { interior = "elements", E = 1e4, nu = 0.3, h_min = 0.08, h_max = 0.16 } }
local study = ricochet.accuracy { scene = scene, methods = { "verlet", "pefrl" }, steps = { 8e-4, 4e-4, 2e-4 }, lattices = { 0.5, 1, 2 },
  lattice_samples = 2, repeats = 1 }
assert(study.cheapest(1e-3), "no step has an error below 1e-3")
assert(study.lattice.sizes[1].sd == 0 and study.lattice.slope_se > 0)
)");
  INFO(ended.out + ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Contains("error of e from the size of the mesh: ") && Contains("2 meshes") &&
                            Contains("falls with order") && !Contains("lattice"));
}

TEST_CASE("scripts: relevance leaves out by name what cannot act on elements, and compares what can") {
  const std::string scene = R"(
local scene = ricochet.scene { target = ricochet.plane {}, launch = { speed = 0.05 },
  projectile = ricochet.disk { interior = "elements", E = 1e4, nu = 0.3, nodes = 150, roughness = 0.02 } }
local springs = { ricochet.plastic { yield = 0.02, on = "projectile" }, ricochet.breaking { strain = 0.1, on = "projectile" } }
)";
  const Ended some = script_with_module(scene + R"(
local result = ricochet.relevance { scene = scene, of = { "e" }, samples = 3,
  effects = { springs[1], ricochet.drag { rate = 0.02 }, springs[2] } }
assert(result[1].name == "plastic" and result[1].left_out:find("acts on springs", 1, true) and not result[1].e)
assert(result[2].name == "drag" and not result[2].left_out and result[2].e.count == 3 and result[2].e.change < 0)
assert(result[3].name == "breaking" and result[3].left_out)
)");
  INFO(some.out + some.err);
  CHECK(some.status == 0);
  CHECK_THAT(some.out, Contains("plastic    left out: plastic acts on springs, and the projectile has none") &&
                           Contains("breaking   left out: "));
  const Ended none = script_with_module(scene + "ricochet.relevance { scene = scene, effects = springs }");
  CHECK(none.status != 0);
  CHECK_THAT(none.err, Contains("relevance: 'effects': none of them can act: plastic acts on springs"));
}

TEST_CASE("scripts: what says nothing of elements, or of springs, is refused with a remedy") {
  const auto refused = [](const std::string& fields) {
    const Ended ended = script_with_module("ricochet.disk { " + fields + " }");
    CHECK(ended.status != 0);
    return ended.err;
  };
  const std::string of_elements = "interior = 'elements', E = 1, nu = 0.3, ";
  CHECK_THAT(refused("E = 1"), Contains("'E': is of elements; give interior = \"elements\" too"));
  CHECK_THAT(refused("h_min = 0.1"), Contains("'h_min': is of elements"));
  CHECK_THAT(refused("interior = 'rigid', nu = 0.1"), Contains("'nu': is of elements"));
  CHECK_THAT(refused("interior = 'elements', nu = 0.3"), Contains("'E': is missing"));
  CHECK_THAT(refused("interior = 'elements', E = 1"), Contains("'nu': is missing"));
  CHECK_THAT(refused(of_elements + "stiffness = 3"), Contains("'stiffness': is of springs; elements have E and nu"));
  CHECK_THAT(refused(of_elements + "mass = 3"), Contains("give density"));
  CHECK_THAT(refused(of_elements + "quartic = 0"), Contains("elements have a law"));
  CHECK_THAT(refused(of_elements + "prestress = 0.1"), Contains("'prestress': is of springs"));
  CHECK_THAT(refused("interior = 'elements', E = 1, nu = 0.5"), Contains("nu"));
  for (const char* nu : {"-1", "0.5", "0 / 0", "'soft'", "nil", "1 / 0"})
    CHECK_THAT(refused("interior = 'elements', E = 1, nu = function(x, y) return " + std::string(nu) + " end"),
               Contains("'nu': the function must return a number between -1 and 0.5, without these, gave ") &&
                   Contains(" at (1, 0)"));
  CHECK_THAT(refused("nu = function() return 0.3 end"), Contains("'nu': is of elements; give interior = \"elements\""));
  CHECK_THAT(refused("interior = 'modes', modes_of = 'springs', nu = function() return 0.3 end"),
             Contains("'nu': is of elements; give modes_of = \"elements\""));
  CHECK_THAT(refused("material = ricochet.materials.steel, radius = 0.01, interior = 'elements', nu = 0.3"),
             Contains("'nu': follows from the material"));
  CHECK_THAT(refused("material = ricochet.materials.steel, radius = 0.01, interior = 'elements', nu = function() end"),
             Contains("'nu': the function must return a number"));
  CHECK_THAT(refused("material = ricochet.materials.steel, radius = 0.01, stiffness = function() return 1 end"),
             Contains("'stiffness': follows from the material"));
  CHECK_THAT(refused(of_elements + "law = 'hooke'"), Contains("polynomial"));
  CHECK_THAT(refused(of_elements + "h_max = 0.1"), Contains("'h_max': is of a mesh; give h_min too"));
  CHECK_THAT(refused(of_elements + "h_min = 0.1, h_max = 0.05"), Contains("is below h_min = 0.1"));
  CHECK_THAT(refused(of_elements + "h_min = 0.1, nodes = 60"), Contains("give h_min or nodes, not both"));
  CHECK_THAT(refused(of_elements + "h_min = 1e-6, h_max = 1e-5"), Contains("raise it, or h_max or grade"));
  CHECK_THAT(refused(of_elements + "h_min = 0.1, mesh = 'crossed'"), Contains("'mesh': crossed is of a rectangle"));
  CHECK_THAT(refused(of_elements + "mesh = 'crossed'"), Contains("'mesh': is of a mesh; give h_min too"));
  CHECK_THAT(refused(of_elements + "h_min = 3"), Contains("too long to follow"));
  CHECK_THAT(refused(of_elements + "h_min = 0.1, points = { {0, 0}, {0.5, 0}, {0, 0.5} }"),
             Contains("are nodes given by hand, and a mesh places its own"));
  CHECK_THAT(refused("material = ricochet.materials.steel, radius = 0.01, " + of_elements),
             Contains("follows from the material"));
}

TEST_CASE("in SI, E, nu and density by place stand beside a material, and are those of the paper's units, scaled") {
  const Workplace here;
  const Ended ended = here.script(R"lua(local ricochet = require "ricochet"
local steel = ricochet.materials.steel
local R, thickness = 0.005, 0.02
local function disk(given)
  for key, value in pairs { radius = R, thickness = thickness, material = steel, interior = "elements",
      state = "plane_strain", h_min = 0.15 * R, h_max = 0.3 * R } do given[key] = value end
  return given
end
local function run(shape, speed, units)
  return ricochet.scene { projectile = ricochet.disk(shape), target = ricochet.plane {}, units = units,
    launch = { speed = speed }, accuracy = 1e-3 }:run()
end
-- What the paper's disk is worth: E = 1e4 m0 c^2/R^2, density 800/pi m0/R^2.
local c = math.sqrt(steel.E / steel.density) / math.sqrt(1e4 / (800 / math.pi))
local alone = run(disk {}, 0.2 * c, "SI")
local even = run(disk { E = function() return steel.E end, nu = function() return steel.nu end,
  density = function() return steel.density end }, 0.2 * c, "SI")
assert(alone.status == "finished" and math.abs(even.e / alone.e - 1) < 1e-9, even.e .. " " .. alone.e)
local graded = run(disk { E = function(x, y) return steel.E * (1 + 0.5 * y / R) end,
  nu = function(x, y) return 0.3 + 0.1 * x / R end, density = function(x, y) return steel.density * (1 - 0.4 * y / R) end },
  0.2 * c, "SI")
local paper = run({ interior = "elements", state = "plane_strain", h_min = 0.15, h_max = 0.3,
  E = function(x, y) return 1e4 * (1 + 0.5 * y) end, nu = function(x, y) return 0.3 + 0.1 * x end,
  density = function(x, y) return 800 / math.pi * (1 - 0.4 * y) end }, 0.2)
assert(math.abs(graded.e / paper.e - 1) < 1e-6 and math.abs(graded.e - alone.e) > 1e-4,
  ("%.12g %.12g %.12g"):format(graded.e, paper.e, alone.e))
assert(math.abs(graded.contact_time / (paper.contact_time * R / c) - 1) < 1e-6)
print "as scaled")lua",
                                  "--quiet");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Contains("as scaled"));
}

TEST_CASE("scripts: LAMMPS files refuse elements by name") {
  const Ended ended = script_with_module(R"(
ricochet.lammps { scene = ricochet.scene { target = ricochet.wall { nodes = 100 },
  projectile = ricochet.disk { interior = "elements", E = 1e4, nu = 0.3, nodes = 60 } } })");
  CHECK(ended.status != 0);
  CHECK_THAT(ended.err,
             Contains("'projectile': LAMMPS files hold bodies of springs only, and this one is of elements"));
}

TEST_CASE("scripts: by materials every body with a yield stress yields, unless it is said whose elements do") {
  const Ended ended = script_with_module(R"(
local soft = ricochet.material { E = 200e9, nu = 0.3, density = 7800, yield = 2e8 }
local strong = ricochet.material { E = 200e9, nu = 0.3, density = 7800, yield = 4e8 }
local brittle = ricochet.material { E = 200e9, nu = 0.3, density = 7800 }
local function yields(projectile, target, fields, state)
  local function ball(material) return ricochet.sphere { radius = 0.01, material = material, h_min = 2e-3 } end
  local scene = ricochet.scene { units = "SI", launch = { speed = 1 }, projectile = ball(projectile),
    target = target and ball(target) or ricochet.plane {}, effects = { ricochet.yielding(fields) } }
  local text = scene:text()
  return text:find("yielding[^\n]*projectile") ~= nil, text:find("yielding[^\n]*target") ~= nil
end
local function check(a, b, projectile, target) assert(a == projectile and b == target, tostring(a) .. tostring(b)) end
local a, b = yields(soft, strong, {})
check(a, b, true, true)
a, b = yields(soft, strong, { on = "projectile" })
check(a, b, true, false)
a, b = yields(soft, strong, { yield = 1e8 })
check(a, b, true, false)
a, b = yields(brittle, soft, {})
check(a, b, false, true)
a, b = yields(soft, brittle, {})
check(a, b, true, false)
a, b = yields(soft, nil, {})
check(a, b, true, false)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}
