// What a script may leave to be read otherwise: hulls, plain triangulations, contacts by one segment, lattices passed
// over.
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;

TEST_CASE("scripts: lattices whose rough rim crosses itself are passed over, and counted once a body") {
  const Ended ended = script_with_module(R"(local function disk(seed, crossing)
  return ricochet.disk { nodes = 800, mass = 1, placement = "hull", roughness = 0.5, seed = seed, crossing = crossing }
end
local refused, list = 0, {}
for seed = 1, 8 do
  local fine, message = pcall(disk, seed, "refuse")
  list[seed] = seed
  if not fine then
    refused = refused + 1
    assert(tostring(message):find('the rough rim crosses itself (roughness 0.5, seed ' .. seed ..
      '); lower the roughness or take another seed, as crossing = "pass_over" does', 1, true), tostring(message))
  end
end
assert(refused > 1 and refused < 8, refused)
print("refused " .. refused)
local rows = ricochet.sweep { name = "s", over = { sample = list, psi1 = { 0, 1 } }, scene = function(at)
  return ricochet.scene { projectile = disk(at.sample, "pass_over"), target = ricochet.plane {},
    launch = { psi1 = at.psi1 } }
end }:run()
local scene = ricochet.scene { projectile = disk(1, "pass_over"), target = ricochet.plane {} }
assert(scene:hash() == ricochet.scene { projectile = disk(1, "pass_over"), target = ricochet.plane {} }:hash())
)");
  INFO(ended.out << ended.err);
  REQUIRE(ended.status == 0);
  const auto number_after = [&](const std::string& text) {
    const std::size_t place = ended.out.find(text);
    REQUIRE(place != std::string::npos);
    return std::stoi(ended.out.substr(place + text.size()));
  };
  const int refused = number_after("refused ");
  CHECK(number_after("passed over: ") >= refused);
  CHECK_THAT(ended.out,
             Contains("lattices whose rough rim crosses itself, for " + std::to_string(refused) + " bodies"));
}

TEST_CASE("scripts: a rim that always crosses itself is refused, with its seed") {
  const Ended ended = script_with_module(R"(
ricochet.disk { nodes = 200, roughness = 2, seed = 3, crossing = "pass_over" })");
  CHECK(ended.status == 1);
  CHECK(
      ended.first_line() ==
      "error: s.lua:3: disk: 'roughness': 2 R makes the rough rims of seed 3 cross themselves, all of 1001; lower it, "
      "or take fewer nodes on the rim");
}

TEST_CASE("scripts: what goes with no hull, no plain triangulation and no single segment is refused by name") {
  struct Refused {
    const char* script;
    const char* message;
  };
  const Refused refused[] = {
      {"ricochet.disk { placement = 'hull', margin = 0.1 }",
       "disk: 'margin': says nothing of placement hull, whose rim lies as its nodes fall; leave it out"},
      {"ricochet.disk { placement = 'hull', h_min = 0.1, interior = 'elements', E = 1, nu = 0.3 }",
       "disk: 'placement': give h_min or placement, not both"},
      {"ricochet.disk { placement = 'hull', interior = 'rigid' }",
       "disk: 'placement': says nothing of a rigid body, inside which nothing moves; leave it out"},
      {"ricochet.sphere { placement = 'hull', nodes = 100, E = 1, nu = 0.3 }",
       "sphere: 'placement': hull would leave the axis of an axisymmetric body; take another placement"},
      {"ricochet.disk { triangulation = 'plain', interior = 'elements', E = 1, nu = 0.3 }",
       "disk: 'triangulation': plain is of springs; leave it out, or take interior springs"},
      {"ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150 }, contact = "
       "{ rule = 'nearest' }, effects = { ricochet.friction { mu = 0.3 } } }",
       "scene: 'contact': rule = nearest does not go with friction, which acts by all segments; take sum"},
      {"ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150 }, contact = "
       "{ rule = 'closest' } }",
       "scene: contact: 'rule' must be one of sum, nearest, spring_normal, is 'closest'"}};
  for (const Refused& r : refused) {
    const Ended ended = script_with_module(std::string("local x = ") + r.script);
    INFO(ended.out << ended.err);
    CHECK(ended.status == 1);
    CHECK_THAT(ended.first_line(), Contains(r.message));
  }
}

TEST_CASE("scripts: springs along their normals lose energy, which the row tells where it may") {
  const Ended ended = script_with_module(R"(local function row(rule, tolerance)
  return ricochet.scene { projectile = ricochet.disk { nodes = 60, mass = 1, roughness = 0.1, seed = 2 },
    target = ricochet.wall { nodes = 150, mass = 1, stiffness = 400, width = 4, roughness = 0.1, seed = 2 },
    launch = { psi1 = 3 }, contact = { V0 = 150, xi = 300, reach = 0.1, sides = "one", rule = rule },
    energy_tolerance = tolerance }:run()
end
assert(row "sum".status == "finished" and row "sum".energy_drift < 1e-3)
local told = row("spring_normal", 1e-4)
assert(told.status == "energy_drift", told.status)
assert(row("spring_normal", 10).status == "finished")
)");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("scripts: a heat map may name its values, all of them") {
  const Workplace here;
  const std::string map = R"(local ricochet = require "ricochet"
local rows_of = require("ricochet.rows").rows_of
local list = {}
for x = 1, 2 do
  for y = 1, 3 do list[#list + 1] = { x = x, y = y, score = x - y } end
end
ricochet.heat_map { rows = rows_of(list), x = "x", y = "y", of = "score", name = "map", caption = "Said.",
  xnames = { "first claim of all", "second" }, ynames = )";
  const Ended ended = here.script(map + "{ 'low', 'a reading with a long name', 'high' } }");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  const std::string drawn = here.read("out/s/map.gp");
  CHECK_THAT(drawn, Contains("'a reading with a long name' 2") && Contains("'first claim of all' 1"));
  CHECK(drawn.find("impacts") == std::string::npos);  // rows without a status are none
  const Ended refused = here.script(map + "{ 'low' } }", "--force");
  CHECK(refused.first_line() == "error: s.lua:8: heat_map: 'ynames' has 1 names for 3 values of y");
}

TEST_CASE(
    "readings: a claim is there or absent by chance in one of forty cases each, and lattices are compared by pairs") {
  const Ended ended = script_with_module(R"(local readings = require "ricochet.readings"
local function normal() return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random()) end
math.randomseed(5)
local claim = { terms = { function(value) return value("soft 6", "e") - 1 end } }
local count, verdicts = 4000, { there = 0, absent = 0, undecided = 0 }
for _ = 1, count do
  local numbers = {}
  for sample = 1, 6 do numbers[sample] = { normal() } end
  local verdict = readings.judged(numbers, claim).verdict
  verdicts[verdict] = verdicts[verdict] + 1
end
for _, name in ipairs { "there", "absent" } do
  assert(math.abs(verdicts[name] / count - 0.025) < 0.008, name .. " " .. verdicts[name] / count)
end
-- Of two terms the lesser decides.
local both = { terms = { claim.terms[1], claim.terms[1] } }
local judged = readings.judged({ { 1, -1 }, { 1.1, -1.1 }, { 0.9, -0.9 } }, both)
assert(judged.verdict == "absent" and judged.count == 3 and judged.score == judged.terms[2].score)
assert(readings.judged({ { 1 } }, claim).verdict == "undecided")
-- Nothing is known of a claim of which one term has no score; nor is it drawn as one that is there.
local unknown = readings.judged({ { 0, 1 }, { 0, 1.1 }, { 0, 0.9 } }, both)
assert(unknown.score ~= unknown.score and unknown.verdict == "undecided" and unknown.terms[2].score > 1)
assert(readings.bounded(0 / 0, 3) ~= readings.bounded(0 / 0, 3))
assert(readings.bounded(7, 3) == 3 and readings.bounded(-7, 3) == -3 and readings.bounded(0.5, 3) == 0.5)
-- What a lattice has in both readings falls out; one that is in one alone says nothing.
local one, other = {}, { [99] = { 7 } }
for sample = 1, 5 do
  local own = normal()
  one[sample], other[sample] = { own + 0.5 }, { own }
end
local difference = readings.difference(one, other, claim)[1]
assert(math.abs(difference.mean - 0.5) < 1e-12 and difference.se < 1e-12 and difference.count == 5)
-- Rows: e of a reading, e_first of the one that is over at the first parting; a lattice that failed is left out.
local rows = {
  { reading = "present", case = "soft 6", sample = 1, status = "finished", e = 1.5, e_first = 0.5 },
  { reading = "present", case = "soft 6", sample = 2, status = "tunnelled", e = 0 / 0, e_first = 0 / 0 },
  { reading = "smooth wall", case = "soft 6", sample = 3, status = "finished", e = 9, e_first = 9 },
}
local present = readings.numbers(rows, readings.by_name["present"], claim)
local parting = readings.numbers(rows, readings.by_name["first parting"], claim)
assert(present[1][1] == 0.5 and parting[1][1] == -0.5 and not present[2] and not present[3])
)");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
}
