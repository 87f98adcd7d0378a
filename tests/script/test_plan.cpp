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
for _, p in ipairs(plan.points) do print("softness", p.softness > 0) end)";
  CHECK_THAT(here.script(planned(then, ""), "samples=2 --quiet").out, Catch::Matchers::Contains("softness\ttrue"));
  CHECK_THAT(here.script(planned(then), "samples=2 --quiet --force").out, Catch::Matchers::Contains("softness\tfalse"));
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
