// ricochet.series and scene:bounces as a user runs them.

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "script/filmed.hpp"
#include "script/program.hpp"
#include "script/sweep_report.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

const std::string head = R"(local ricochet = require "ricochet"
local ball = ricochet.scene { projectile = ricochet.disk { nodes = 60, mass = 1 }, target = ricochet.plane {},
  contact = { xi = 2000, V0 = 100, reach = 0.02 },
  launch = { height = 0.3, speed = 0 }, effects = { ricochet.gravity { g = 1e-2 }, ricochet.damping { time = 0.03, on = "projectile" } } }
)";

}  // namespace

TEST_CASE("a series is rows, files and a plot") {
  const Workplace place;
  const Ended run = place.script(head + R"(
local rows = ricochet.series { scene = ball, of = { "force_n", "height", lever = function(state)
  return state.projectile.x + 2 * state.force_n end }, points = 50, duration = 40, name = "fall" }
assert(#rows == 50 and rows[1].time == 0 and rows[50].height > 0)
for _, row in ipairs(rows) do assert(math.abs(row.lever - 2 * row.force_n) < 1e-6) end
ricochet.plot { rows = rows, x = "time", y = { "height", "force_n" }, name = "drop" }
ricochet.plot { rows = rows, x = "height", y = { "force_n" }, name = "loop" }
)");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const std::string csv = place.read("out/s/fall.csv");
  CHECK(csv.find("time [R/c],force_n [m0 c^2/R],height [R],lever") != std::string::npos);
  CHECK(fs::exists(place.path / "out/s/fall.h5"));
  const std::string drawn = place.read("out/s/drop.gp");
  CHECK_THAT(drawn, Contains("with lines") && !Contains("yerrorbars") && !Contains("impacts"));
  CHECK_THAT(drawn, Contains("height y [R]"));
}

TEST_CASE("functions of a state see the outlines of both bodies, if the series has them") {
  const Workplace place;
  const Ended run = place.script(R"(local ricochet = require "ricochet"
local bar = ricochet.scene { units = "SI", target = ricochet.plane {}, launch = { speed = 1 },
  projectile = ricochet.cylinder { radius = 0.002, height = 0.01, nodes = 60, material = ricochet.materials.steel } }
local function extent(state)
  local least, most, widest = math.huge, -math.huge, 0
  for _, at in ipairs(state.projectile.outline) do
    least, most, widest = math.min(least, at[2]), math.max(most, at[2]), math.max(widest, at[1])
  end
  assert(#state.target.outline == 0 and math.abs(widest / 0.002 - 1) < 0.01, widest)
  return most - least
end
local rows = ricochet.series { scene = bar, of = { extent = extent }, points = 20, outlines = true }
for _, row in ipairs(rows) do assert(math.abs(row.extent / 0.01 - 1) < 0.01, row.extent) end
assert(rows[10].extent < rows[1].extent)
ricochet.series { scene = bar, of = { extent = extent }, points = 20, name = "bare" }
)");
  CHECK(run.status != 0);
  CHECK_THAT(run.err, Contains("outline"));
}

TEST_CASE("waves are rows of slices, files and a picture, in the scene's units") {
  const Workplace place;
  const Ended run = place.script(R"(local ricochet = require "ricochet"
local rod = { height = 0.02, width = 0.002, nodes = 60, material = ricochet.materials.steel }
local scene = ricochet.scene { units = "SI", projectile = ricochet.rectangle(rod), target = ricochet.plane {},
  launch = { speed = 1 } }
local rows = ricochet.waves { scene = scene, slices = 10, points = 30, name = "up", title = "A rod's `date`" }
assert(#rows == 300 and rows[1].body == 1 and math.abs(rows[1].velocity + 1) < 1e-6, rows[1].velocity)
for _, row in ipairs(rows) do assert(row.velocity ~= row.velocity or math.abs(row.velocity) < 3) end
assert(rows[300].velocity > 0 and rows[10].place - rows[1].place > 0.017)
)");
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK_THAT(place.read("out/s/up.csv"), Contains("time [s],body,place [m],velocity [m/s]"));
  CHECK_THAT(place.read("out/s/up.gp"),
             Contains("with image") && Contains("y at the first moment [mm]") && Contains("time [µs]"));
  for (const char* file : {"up.png", "up.svg", "up.h5"}) CHECK(fs::exists(place.path / "out/s" / file));
  const auto told = [&](const std::string& fields) {
    return place.script(head + "ricochet.waves { scene = ball, points = 4, duration = 1, " + fields + " }", "--force")
        .err;
  };
  CHECK_THAT(told("along = 'z'"), Contains("'along'"));
  CHECK_THAT(told("slices = 1"), Contains("'slices'"));
  CHECK_THAT(told("name = '../a'"), Contains("'name' must be letters"));
  CHECK_THAT(told("duration = 0"), Contains("'duration'"));
}

TEST_CASE("mistakes in a series are told at their place") {
  const Workplace place;
  const auto told = [&](const std::string& of) {
    return place.script(head + "ricochet.series { scene = ball, of = " + of + ", points = 4, duration = 1 }", "--force")
        .err;
  };
  CHECK_THAT(told("{ \"force\" }"), Contains("'of' holds 'force' at place 1, which is no quantity (did you mean"));
  CHECK_THAT(told("{ function(state) return 1 end }"), Contains("a function needs a name"));
  CHECK_THAT(told("{ vn = function(state) return 1 end }"), Contains("'vn' is a quantity already"));
  CHECK_THAT(told("{ a = function(state) return state.projectile.z end }"),
             Contains("the projectile of a state has no 'z'"));
  CHECK_THAT(told("{ a = function(state) end }"), Contains("must return a number, returned a nil at t = 0"));
  CHECK_THAT(told("{}"), Contains("'of' names nothing beside the time"));
}

TEST_CASE("an outline with a hole has a place of NaN between its chains") {
  const Ended run = script_with_module(R"(
local hole = { { -0.4, -0.4 }, { 0.4, -0.4 }, { 0.4, 0.4 }, { -0.4, 0.4 } }
local ball = ricochet.scene { projectile = ricochet.disk { nodes = 80, holes = { hole } }, target = ricochet.plane {},
  launch = { speed = 0.05 } }
local outside, gaps, inside
ricochet.series { scene = ball, outlines = true, points = 2, duration = 1, of = { a = function(state)
  outside, gaps, inside = 0, 0, 0
  for _, p in ipairs(state.projectile.outline) do
    local r = math.sqrt((p[1] - state.projectile.x) ^ 2 + (p[2] - state.projectile.y) ^ 2)
    if r ~= r then gaps = gaps + 1 elseif gaps == 0 then outside = outside + 1 else inside = inside + 1 end
    assert(r ~= r or (gaps == 0) == (r > 0.9))
  end
  return gaps
end } }
assert(gaps == 1 and outside > 10 and inside > 4)
)");
  INFO(run.err);
  CHECK(run.status == 0);
}

TEST_CASE("bounces are rows, and tell why they end") {
  const Workplace place;
  const Ended run = place.script(head + R"(
local rows, reason = ball:bounces { count = 2 }
assert(#rows == 2 and reason == nil)
assert(rows[1].bounce == 1 and rows[2].speed < rows[1].speed and rows[2].time > rows[1].time)
rows:summary { by = "bounce", of = { "e", "height" } }:print()
local all, why = ball:bounces { count = 50, least_height = 0.1 }
assert(#all < 50 and why:find "less than 0.1 R")
)");
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK_THAT(run.out, Contains("of 50 bounces: bounce"));
  CHECK(place.script(head + "ball:bounces()", "--check").status == 0);
  CHECK_THAT(place.script(head + "ball.bounces { count = 2 }").err, Contains("with a colon"));
}

TEST_CASE("a scene that stands still is refused at its speed") {
  const Workplace place;
  const std::string err = place
                              .script(R"(local ricochet = require "ricochet"
ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.plane {}, launch = { speed = 0, height = 1 } }:run()
)")
                              .err;
  CHECK_THAT(err, Contains("s.lua:2: scene: 'speed': 0 leaves the projectile where it is"));
}

TEST_CASE("a plot that grows in a picture sees every bounce, however few the frames") {
  FilmedScene ball;
  ball.scene.projectile = disk(60, 1e4, 0, 1);
  Body plane;
  plane.plane = Plane{};
  ball.scene.target = std::make_shared<Body>(plane);
  ball.scene.contact = {.V0 = 100, .xi = 2000, .reach = 0.02};
  ball.scene.launch.height = 0.3;
  ball.scene.launch.speed = 0;
  ball.scene.effects = {Gravity{1e-2, "projectile"}, Damping{0.02, "projectile"}};
  ball.solids = BuiltSolids(ball.scene);
  ball.course = follow_course(ball.solids, ball.scene, stop_requested);
  const Source source = source_of(ball, {-5, 20, 45});
  std::vector<double> heights;
  std::size_t frames = 0;
  const auto& height = Sample::value_named("height");
  source.play(
      stop_requested, [&](const Frame&) { ++frames; }, [&](const Sample& now) { heights.push_back(height(now)); });
  CHECK(frames == 3);
  REQUIRE(heights.size() > 1900);
  int lowest = 0;
  for (std::size_t k = 1; k + 1 < heights.size(); ++k)
    lowest += heights[k] < heights[k - 1] && heights[k] <= heights[k + 1] && heights[k] < heights[0] - 0.25;
  CHECK(lowest >= 3);
}

TEST_CASE("a run tells how far it is every second on a terminal, else seldom, and never if it is to be quiet") {
  RunProgress terminal(false, true, 120), log(false, false, 120), quiet(true, true, 120);
  CHECK(terminal.line(0.5, 0.9) == "");
  CHECK(terminal.line(0.5, 1.1) == "scene: t = 0.5 R/c of 120 R/c at most, 1 s");
  CHECK(terminal.line(0.6, 2.0) == "");
  CHECK(terminal.line(0.7, 2.2) != "");
  CHECK(log.line(3, 9) == "");
  CHECK(log.line(3.5, 10) == "scene: t = 3.5 R/c of 120 R/c at most, 10 s");
  CHECK(log.line(4, 19) == "");
  CHECK(log.line(5, 20) != "");
  CHECK(log.line(9, 39) == "");
  CHECK(quiet.line(50, 1000) == "");
}
