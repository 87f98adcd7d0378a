// ricochet.plan and the parts it is made of, through scripts.
#include <catch2/catch.hpp>
#include <cmath>

#include "program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

// The small sweep, not yet run, as `sweep`, with the paper's contact: its softness is no error then, and the samples
// are.
std::string planned(const std::string& then, const std::string& contact = "contact = { V0 = 150, xi = 300 }, ") {
  std::string text = small_sweep;
  text.insert(text.find("launch ="), contact);
  text.replace(text.find("local rows ="), 12, "local sweep =");
  text.erase(text.find(":run()"));
  return text + "\n" + then;
}

}  // namespace

TEST_CASE("the fitted line is exact for points on one, and its standard error is the scatter of repeated fits") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local refine = require "ricochet.refine"
local function points(slope) return { { x = 2, value = 0.7 + 2 * slope, se = 0.01 }, { x = 1, value = 0.7 + slope, se = 0.02 }, { x = 0.5, value = 0.7 + slope / 2, se = 0.01 } } end
local slope, se, limit = refine.fitted_line(points(-0.05))
assert(math.abs(slope + 0.05) < 1e-15 and math.abs(limit - 0.7) < 1e-15)
local mean, square, n = 0, 0, 2000
local function normal() return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random()) end
for i = 1, n do
  local list = points(0.3)
  for _, p in ipairs(list) do p.value = p.value + p.se * normal() end
  local s = refine.fitted_line(list)
  mean, square = mean + s / n, square + (s - 0.3) ^ 2 / n
end
assert(math.abs(mean - 0.3) < 4 * se / math.sqrt(n), mean)
assert(math.abs(math.sqrt(square) / se - 1) < 0.1, math.sqrt(square) / se)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("a refined scene keeps outline, mass and stiffness, and the factor 1 keeps the scene") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local refine = require "ricochet.refine"
local scene = ricochet.scene { projectile = ricochet.disk { nodes = 100, mass = 2 }, target = ricochet.wall { nodes = 300, width = 4, stiffness = 100, quartic = 0.5 }, launch = { psi1 = 1 }, step = 0.001 }
assert(refine.refined(scene, 1, 0):hash() == scene:hash())
assert(refine.refined(scene, 1, 1):hash() ~= scene:hash())
assert(ricochet.refined(scene, 4):text() == refine.refined(scene, 4, 0):text())
assert(not pcall(ricochet.refined, scene, -1))
local text = refine.refined(scene, 4, 0):text()
for _, expected in ipairs { "nodes 400", "nodes 1200", "mass 0.5", "density 254.6", "quartic 2", "ka 100", "psi1 = 1" } do assert(text:find(expected, 1, true), expected .. "\n" .. text) end
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("a plan reaches the wanted standard error with the samples it says, and its budget adds up") {
  const Workplace here;
  const Ended ended = here.script(
      planned(R"(local plan = ricochet.plan { sweep = sweep, standard_error = 0.05, sizes = { 0.7, 1, 1.5 } }
assert(plan.samples >= 2 and plan.predicted_seconds > 0 and #plan.points == 3)
assert(plan.nodes >= 1)  -- 60 are few enough
local b = plan.budget
assert(b.sampling <= 0.05 and b.lattice <= 0.05 and b.step <= 0.05)
for _, p in ipairs(plan.points) do
  local lattice = p.lattice * math.abs(plan.nodes ^ -0.5 - 1)
  assert(p.sd_cautious ^ 2 / plan.samples + lattice ^ 2 + b.step ^ 2 <= 0.05 ^ 2 * (1 + 1e-12))
end
for _, p in ipairs(plan.points) do assert(p.step < 1e-3 and p.sampling > 0) end
local rows = plan:run()
assert(#rows == 3 * plan.samples)
for _, line in ipairs(rows:summary { by = "psi1", of = { "e" } }) do assert(line.failed == 0 and line.e.se < 0.05 * 1.6, line.e.se) end
)"),
      "samples=3 --quiet");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("cheapest: ") && Catch::Matchers::Contains("s, took "));
  const Table table = read_table(here.path / "out/s/results.h5");
  CHECK(table.rows() >= 6);
  // Another time the pilot may find another plan the cheapest: --resume goes on with the one that was kept.
  const std::string kept = here.read("out/s/s_plan.txt");
  CHECK(kept.starts_with("standard_error 0.05"));
  const Ended again = here.run("s.lua samples=3 --quiet --resume");
  INFO(again.err);
  CHECK(again.status == 0);
  CHECK_THAT(again.out, Catch::Matchers::Contains("goes on with the plan of the earlier run"));
}

TEST_CASE("a plan of a sweep by error gives its samples what the other errors leave") {
  const Workplace here;
  const std::string text = R"(local ricochet = require "ricochet"
local sweep = ricochet.sweep { name = "s", over = { psi1 = { 1, 6 } }, samples = "by_error", relative_error = 0.5,
  scene = function(at) return ricochet.scene {
    projectile = ricochet.disk { nodes = 60, roughness = 0.03, seed = at.sample },
    target = ricochet.wall { width = 4, depth = 1.5, nodes = 150, stiffness = 400, roughness = 0.03, seed = at.sample },
    launch = { psi1 = at.psi1 }, contact = { V0 = 150, xi = 300 } } end }
local plan = ricochet.plan { sweep = sweep, standard_error = 0.06, sizes = { 1 } }
local b = plan.budget
assert(math.abs(b.sampling ^ 2 + b.step ^ 2 + b.lattice ^ 2 + b.softness ^ 2 - 0.06 ^ 2) < 1e-15, b.sampling)
local rows = plan:run()
for _, line in ipairs(rows:summary { by = "psi1", of = { "e" } }) do
  assert(line.failed == 0 and line.e.units >= 8 and line.e.se <= b.sampling, line.e.se)
end
print("impacts: " .. #rows)
)";
  const Ended ended = here.script(text, "--quiet");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("samples by error: "));
  const Ended again = here.run("s.lua --quiet --resume");
  INFO(again.out << again.err);
  CHECK(again.status == 0);
  CHECK_THAT(again.out, Catch::Matchers::Contains("goes on with the plan of the earlier run"));
  CHECK(again.out.substr(again.out.find("impacts: ")) == ended.out.substr(ended.out.find("impacts: ")));
  std::string counted = text;
  counted.insert(counted.find("sizes ="), "samples = 'n', ");
  CHECK_THAT(here.script(counted, "--quiet --force").first_line(),
             Catch::Matchers::Contains("counts them as 'sample'"));
}

TEST_CASE("a plan for the continuum says when the lattice's size puts it out of reach") {
  const Workplace here;
  const Ended ended = here.script(
      planned(
          R"(local plan = ricochet.plan { sweep = sweep, standard_error = 1e-3, sizes = { 0.7, 1 }, pilot = 2, continuum = true }
assert(not plan.samples)
plan:run()
)"),
      "samples=2 --quiet");
  CHECK(ended.status == 1);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("no plan: with "));
  CHECK(ended.first_line().ends_with("run: there is no plan to run: the wanted standard error is out of reach"));
}

TEST_CASE("a plan counts the softness of a contact that the program chose, and of no other") {
  const Workplace here;
  const std::string then =
      R"(local plan = ricochet.plan { sweep = sweep, standard_error = 0.5, sizes = { 1 }, pilot = 2 }
for _, p in ipairs(plan.points) do print("softness", p.softness ~= 0 and p.softness_se > 0) end)";
  CHECK_THAT(here.script(planned(then, ""), "samples=2 --quiet").out, Catch::Matchers::Contains("softness\ttrue"));
  CHECK_THAT(here.script(planned(then), "samples=2 --quiet --force").out, Catch::Matchers::Contains("softness\tfalse"));
}

TEST_CASE("the softness of a plan is what harder contacts change on average over the pilot's samples") {
  const Workplace here;
  const Ended ended = here.script(planned(R"(local pilot = 5
local plan = ricochet.plan { sweep = sweep, standard_error = 0.5, sizes = { 1 }, pilot = pilot }
local function row(psi1, seed, contact, choice, share)
  return ricochet.scene { projectile = ricochet.disk { nodes = 60, roughness = 0.03, seed = seed },
    target = ricochet.wall { width = 4, depth = 1.5, nodes = 150, stiffness = 400, roughness = 0.03, seed = seed },
    launch = { psi1 = psi1 }, contact = contact, method = choice.method, theta = share * choice.theta }:run()
end
for k, psi1 in ipairs { 0, 1, 4 } do
  local sum, square = 0, 0
  for seed = 1, pilot do
    local soft = row(psi1, seed, {}, plan.choices[k], 1)
    local change = 2 * (row(psi1, seed, { xi = 2 * soft.xi }, plan.choices[k], 0.5).e - soft.e)
    sum, square = sum + change, square + change ^ 2
  end
  local mean = sum / pilot
  local se = math.sqrt((square / pilot - mean ^ 2) / (pilot - 1))
  local p = plan.points[k]
  -- In a plan each sample has its own share of the longest step: by a change of the step e changes by p.step.
  assert(math.abs(p.softness - mean) < math.max(p.step, 1e-4), p.softness .. " " .. mean)
  assert(math.abs(p.softness_se - se) < math.max(p.step, 1e-4), p.softness_se .. " " .. se)
  -- Of five samples a mean is told apart from 0 by 2.78 standard errors.
  local is_seen = math.abs(p.softness) > 2.78 * p.softness_se
  assert(p.softness_counts == (is_seen and math.abs(p.softness) or 0), p.softness_counts)
end
)",
                                          ""),
                                  "samples=2 --quiet");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("contact: what an infinitely hard one would change"));
}

TEST_CASE("a plan of bodies of elements speaks of their mesh, and is kept by the sweep that it runs") {
  const Workplace here;
  const std::string text = R"(local ricochet = require "ricochet"
local sweep = ricochet.sweep { name = "s", over = { sample = ricochet.range(2), nu = { 0.1, 0.4 } }, scene = function(at)
  return ricochet.scene { target = ricochet.plane {}, launch = { speed = 0.05 },
    projectile = ricochet.disk { interior = "elements", E = 1e4, nu = at.nu, h_min = 0.06, h_max = 0.12,
      roughness = ROUGHNESS, seed = at.sample } }
end }
local plan = ricochet.plan { sweep = sweep, standard_error = 0.02, sizes = { 0.5, 1, 2 }, pilot = 3 }
print("samples", plan.samples)
for _, row in ipairs(plan:run()) do assert(row.status == "finished") end
)";
  const auto with = [&](const std::string& roughness, const std::string& flag) {
    std::string script = text;
    return here.script(script.replace(script.find("ROUGHNESS"), 9, roughness), "--quiet" + flag);
  };
  const Ended smooth = with("0", "");
  INFO(smooth.out << smooth.err);
  CHECK(smooth.status == 0);
  CHECK_THAT(smooth.out, Catch::Matchers::Contains("mesh size: what an infinitely fine mesh would change") &&
                             Catch::Matchers::Contains("from the mesh's size") &&
                             !Catch::Matchers::Contains("lattice"));
  CHECK_THAT(smooth.out, Catch::Matchers::Contains("samples\t2\n"));  // smooth meshes are all alike
  const Ended rough = with("0.02", " --force");
  INFO(rough.out << rough.err);
  CHECK(rough.status == 0);
  CHECK_THAT(rough.out, Catch::Matchers::Contains("s, took "));
}

TEST_CASE("scenes of springs and elements are divided into lattices and meshes") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local refine = require "ricochet.refine"
local springs, elements = ricochet.disk { nodes = 60 }, ricochet.disk { nodes = 60, interior = "elements", E = 1, nu = 0 }
local function word(projectile, target) return refine.division { ricochet.scene { projectile = projectile, target = target } }.one end
local rigid = ricochet.wall { nodes = 150, interior = "rigid" }
assert(word(springs, ricochet.plane {}) == "lattice" and word(springs, rigid) == "lattice")
assert(word(elements, ricochet.plane {}) == "mesh" and word(elements, rigid) == "mesh")
assert(word(elements, springs) == "lattice and mesh" and word(springs, elements) == "lattice and mesh")
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("a refined mesh has shorter sides by the same share everywhere") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local scene = ricochet.scene { target = ricochet.plane {},
  projectile = ricochet.disk { interior = "elements", E = 1, nu = 0, h_min = 0.04, grade = 0.25 } }
local coarse, fine = scene:text(), ricochet.refined(scene, 4):text()
assert(coarse:find("mesh 0.04 0.32 0.25 at ", 1, true), coarse)
assert(fine:find("mesh 0.02 0.16 0.125 at ", 1, true) and fine:find(" within 0.4 ", 1, true), fine)
local ratio = tonumber(fine:match 'nodes (%d+)') / tonumber(coarse:match 'nodes (%d+)')
assert(math.abs(ratio / 4 - 1) < 0.1, ratio)
assert(ricochet.refined(scene, 1):hash() == scene:hash())
)");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("the fitted line through values that do not scatter is as uncertain as they stray from it") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local refine = require "ricochet.refine"
local function line(...)
  local points = {}
  for i, value in ipairs { ... } do points[i] = { x = i, value = value, se = 0 } end
  return refine.fitted_line(points)
end
local slope, se, limit = line(1, 3, 5)
assert(slope == 2 and se == 0 and limit == -1)
slope, se = line(1, 2, 1)  -- strays by 1/3, 2/3 and 1/3 from the mean
assert(math.abs(slope) < 1e-15 and math.abs(se - math.sqrt(2 / 3 / 2)) < 1e-14, se)
slope, se = line(1, 3)
assert(slope == 2 and se == 2)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("mistakes in a plan are found before its pilot runs") {
  const Workplace here;
  const auto first_line = [&](const std::string& call) { return here.script(planned(call), "--quiet").first_line(); };
  CHECK(first_line("ricochet.plan { sweep = sweep, standard_error = 0.1, samples = 'smaple' }") ==
        "error: s.lua:14: plan: the sweep's 'over' has no 'smaple' to count samples by");
  CHECK(first_line("ricochet.plan { sweep = sweep, standard_error = 0.1, of = 'betta' }") ==
        "error: s.lua:14: plan: an outcome has no 'betta' (did you mean 'beta'?)");
  CHECK(first_line("ricochet.plan { sweep = sweep, standard_error = 0 }") ==
        "error: s.lua:14: plan: 'standard_error' must be greater than 0, is 0");
  CHECK(first_line("ricochet.plan { sweep = { 1 }, standard_error = 0.1 }") ==
        "error: s.lua:14: plan: 'sweep' must be a sweep (from ricochet.sweep), is a table");
  CHECK(first_line("ricochet.plan { sweep = sweep, standard_error = 0.1, sizes = { 0 } }") ==
        "error: s.lua:14: plan: a size is a factor of the nodes, above 0 and at most 16, not 0");
  CHECK_FALSE(fs::exists(here.path / "out"));
}
