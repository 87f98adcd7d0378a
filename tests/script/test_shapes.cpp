// Shapes as scripts make them: their areas, centroids and moments against formulas, holes, nodes given by hand, turned
// bodies, and targets that move.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "impact/launch/launch.hpp"
#include "impact/watch/parting.hpp"
#include "scenes.hpp"
#include "script/objects.hpp"
#include "script/program.hpp"
#include "script/state.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

using Approx = Catch::Detail::Approx;
const std::atomic<bool> go_on{false};

/// Values that a chunk of Lua returns, in which `r` is the module.
class Chunk {
 public:
  explicit Chunk(const std::string& text) : session_({}, "s.lua", {}), state_(session_), L_(state_.lua()) {
    const std::string whole = "local r = require 'ricochet'\n" + text;
    const bool ran = luaL_loadbufferx(L_, whole.data(), whole.size(), "@s.lua", "t") == LUA_OK &&
                     lua_pcall(L_, 0, LUA_MULTRET, 0) == LUA_OK;
    if (!ran) throw std::runtime_error(lua_tostring(L_, -1));
  }
  const Body& body(int index = 1) const { return *body_at(L_, index).body; }
  const Scene& scene(int index = 1) const { return scene_at(L_, index).scene; }

 private:
  Session session_;
  State state_;
  lua_State* L_;
};

/// Of the cells, as if they were of a uniform sheet.
struct Sheet {
  double area = 0, second = 0;  ///< second: moment about the origin
  Vec2 centroid = Vec2::Zero();
};
Sheet sheet_of(const Solid& solid) {
  Sheet sheet;
  for (const Triangle& t : solid.cells) {
    const Vec2 &a = solid.points[t[0]], &b = solid.points[t[1]], &c = solid.points[t[2]];
    const double area = cross(b - a, c - a) / 2;
    sheet.area += area;
    sheet.centroid += area * (a + b + c) / 3;
    // Exact for a quadratic: the mean over the middles of the sides.
    for (const Vec2& middle : {Vec2((a + b) / 2), Vec2((b + c) / 2), Vec2((c + a) / 2)})
      sheet.second += area / 3 * middle.squaredNorm();
  }
  sheet.centroid /= sheet.area;
  return sheet;
}

std::string grid(int columns, int rows, double width, double height) {
  std::string text = "{ ";
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j)
      text += fmt::format("{{{}, {}}}, ", width * (i - columns / 2.0) / columns, height * (j - rows / 2.0) / rows);
  return text + "}";
}

const char* round_hole = R"lua(
local hole = {}
for i = 1, 100 do hole[i] = { 0.4 * math.cos(math.pi * i / 50), 0.4 * math.sin(math.pi * i / 50) } end
)lua";

}  // namespace

TEST_CASE("areas, centroids and moments of shapes are those of their formulas") {
  const double pi = std::numbers::pi;
  struct Shape {
    const char* text;
    double area, second;  // second: moment of area about the centroid, over the area
    double tolerance;     // of a curve, by its polygon of about 90 sides: 2/3 (pi/90)^2 and more where it is sharp
  };
  const auto corners = [](int n) { return (2 + std::cos(2 * std::numbers::pi / n)) / 6; };
  const Shape shapes[] = {
      {"disk { radius = 1.5", 2.25 * pi, 2.25 / 2, 4e-3},
      {"ellipse { a = 1.2, b = 0.7", 0.84 * pi, (1.44 + 0.49) / 4, 4e-3},
      {"ellipse { a = 0.3, b = 1.5", 0.45 * pi, (0.09 + 2.25) / 4, 1e-2},
      {"rectangle { width = 2, height = 0.5", 1, (4 + 0.25) / 12, 1e-12},
      {"regular_polygon { sides = 3, radius = 1.1", 1.21 * 0.75 * std::sqrt(3.0), 1.21 * corners(3), 1e-12},
      {"regular_polygon { sides = 6", 1.5 * std::sqrt(3.0), corners(6), 1e-12},
      {"regular_polygon { sides = 11", 5.5 * std::sin(2 * pi / 11), corners(11), 1e-12},
      {"regular_polygon { sides = 12", 3, corners(12), 2e-3},
      {"polygon { outline = { {0, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0} }", 2, 5.0 / 12, 1e-12},
  };
  for (const Shape& shape : shapes) {
    INFO(shape.text);
    const Chunk made(std::string("return r.") + shape.text + ", nodes = 600, placement = 'poisson_disk' }");
    const auto solid = build_solid(made.body());
    const Sheet sheet = sheet_of(*solid);
    const Vec2 centre = std::string(shape.text).starts_with("polygon") ? Vec2(1, 0.5) : Vec2(0, 0);
    CHECK(solid->nodes() == 600);
    CHECK(sheet.area == Approx(shape.area).epsilon(shape.tolerance));
    CHECK((sheet.centroid - centre).norm() < 1e-12);
    CHECK(sheet.second / sheet.area - centre.squaredNorm() == Approx(shape.second).epsilon(1.5 * shape.tolerance));
  }
}

TEST_CASE("a regular polygon stands on a side") {
  for (const int sides : {3, 4, 5, 8}) {
    const Chunk made(fmt::format("return r.regular_polygon {{ sides = {}, nodes = 60 }}", sides));
    const Points& outline = made.body().outline;
    const double lowest = bounding_box(outline).low.y();
    CHECK(std::count_if(outline.begin(), outline.end(), [&](const Vec2& p) { return p.y() < lowest + 1e-12; }) == 2);
  }
}

TEST_CASE("a body with a hole has the mass and the area that are left, and a rim of two closed chains") {
  for (const char* placement : {"uniform", "poisson_disk", "triangular"}) {
    const Chunk made(std::string(round_hole) + "return r.disk { holes = { hole }, roughness = 0.002, nodes = 500, " +
                     "placement = '" + placement + "' }");
    const auto solid = build_solid(made.body());
    const Sheet sheet = sheet_of(*solid);
    CHECK(sheet.area == Approx(std::numbers::pi * (1 - 0.16)).epsilon(0.01));
    CHECK(std::abs(solid->nodes() - 500) <= (std::string(placement) == "triangular" ? 15 : 0));
    std::set<std::pair<int, int>> edges;
    for (const Triangle& t : solid->cells)
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    CHECK(solid->nodes() - static_cast<int>(edges.size()) + static_cast<int>(solid->cells.size()) == 0);
    for (const Vec2& p : solid->points) CHECK(p.norm() > 0.38);
    const auto& mesh = std::get<Mesh<2>>(solid->surface);
    const auto chains = chains_of(mesh.cell);
    REQUIRE(chains.size() == 2);
    double area = 0;
    for (const Chain& chain : chains) {
      CHECK(chain.closed);
      Points points;
      for (const int k : chain.node) points.push_back(solid->points[mesh.node[k]]);
      area += signed_area(points);
    }
    CHECK(area == Approx(sheet.area).epsilon(1e-12));  // the hole's chain runs clockwise
    int on_rim = 0;
    for (std::size_t s = 0; s < solid->springs()->list.size(); ++s) on_rim += solid->springs()->list[s].on_rim;
    CHECK(on_rim == static_cast<int>(mesh.cell.size()));
  }
}

TEST_CASE("a ring falls on a wall as a body does: certified, with its energy and momentum kept") {
  const Chunk made(std::string(round_hole) + R"lua(
return r.scene { projectile = r.disk { nodes = 150, placement = "poisson_disk", holes = { hole } },
  target = r.rectangle { width = 3, height = 1, nodes = 150, placement = "poisson_disk" },
  contact = { V0 = 150, xi = 300, reach = 0.1, sides = "two" }, launch = { speed = 0.05 } })lua");
  const Scene& scene = made.scene();
  const BuiltSolids built(scene);
  const Outcome o = run_scene(built, scene, go_on);
  INFO(o.reason);
  CHECK(o.status == Status::finished);
  CHECK(o.momentum_residual < 1e-10);
  CHECK(o.energy_closure < 1e-4);
  CHECK(o.e < 1);
}

TEST_CASE("nodes given one by one are the body's: those on the outline are its rim") {
  const Chunk made("return r.rectangle { width = 2, height = 1, points = " + grid(8, 4, 2, 1) +
                   " }, r.disk { points = " + "{ {0.1, 0}, {-0.5, 0.2}, {0, 0.6}, {0, -0.5} } }");
  const auto block = build_solid(made.body(1)), disk = build_solid(made.body(2));
  CHECK(block->nodes() == 45);
  CHECK(surface_nodes(block->surface).size() == 24);
  CHECK(sheet_of(*block).area == Approx(2).epsilon(1e-12));
  CHECK(made.body(1).numbers.nodes == 45);
  // Where none lies on the outline, the rim is spaced as they are: (4 + L/s) s^2 = pi, so s = 0.399.
  CHECK(surface_nodes(disk->surface).size() == 16);
  CHECK(disk->nodes() == 20);
}

TEST_CASE("nodes given on a circle count as its rim, though the outline is a polygon") {
  const Chunk made(R"lua(
local points = {}
for i = 1, 20 do points[i] = { math.cos(math.pi * i / 10 + 0.1), math.sin(math.pi * i / 10 + 0.1) } end
for i = 1, 7 do points[20 + i] = { 0.5 * math.cos(i), 0.5 * math.sin(i) } end
return r.disk { points = points })lua");
  const auto disk = build_solid(made.body());
  CHECK(disk->nodes() == 27);
  CHECK(surface_nodes(disk->surface).size() == 20);
}

TEST_CASE("rim_spacing is that of the rim, and margin keeps the interior from its edges") {
  for (const char* placement : {"uniform", "poisson_disk", "triangular"}) {
    const Chunk made(std::string("return r.rectangle { width = 2, height = 1, nodes = 300, rim_spacing = 0.05, ") +
                     "margin = 0.04, placement = '" + placement + "' }");
    const NodePlan plan = plan_nodes(made.body(), {});
    CHECK(plan.rim == 120);
    CHECK(std::abs(static_cast<int>(plan.points.size()) - 300) <= (std::string(placement) == "triangular" ? 12 : 0));
    for (std::size_t i = 120; i < plan.points.size(); ++i) {
      const Vec2& p = plan.points[i];
      CHECK(std::min(1 - std::abs(p.x()), 0.5 - std::abs(p.y())) > 0.04 - 1e-12);
    }
  }
}

TEST_CASE("a rotated body is the same lattice, turned about the origin") {
  const Chunk made(R"lua(
local body = r.rectangle { width = 2, height = 1, nodes = 200, roughness = 0.01, anchored = function(x, y) return x > 0.9 end }
return body, r.rotated { body = body, angle = 30 }, r.rotated { body = r.rotated { body = body, angle = 100 }, angle = -10 })lua");
  const auto plain = build_solid(made.body(1)), by_30 = build_solid(made.body(2)), by_90 = build_solid(made.body(3));
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  REQUIRE(by_30->nodes() == plain->nodes());
  CHECK(by_30->free == plain->free);
  bool same = true;
  for (int i = 0; i < plain->nodes(); ++i) {
    const Vec2& p = plain->points[i];
    same = same && (by_30->points[i] - Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y())).norm() < 1e-15;
    same = same && by_90->points[i] == Vec2(-p.y(), p.x());  // to the bit
  }
  CHECK(same);
  REQUIRE(by_30->springs()->list.size() == plain->springs()->list.size());
  for (std::size_t i = 0; i < plain->springs()->list.size(); ++i)
    CHECK(by_30->springs()->list[i].length == Approx(plain->springs()->list[i].length).epsilon(1e-13));
  CHECK(made.body(1).geometry_text() != made.body(2).geometry_text());
}

namespace {

// A bar of hand-made nodes, whose mirror image at x = 0 can be made, falls on a plane, tilted.
Scene tilted_bar(int side) {
  const Chunk made(fmt::format(R"lua(
local side, points, x = {}, {{}}, 0.5
for i = 1, 60 do
  local a = (0.754877666 * i) % 1 -- evenly strewn, no pattern  [Roberts 2018]
  local b = (0.569840291 * i) % 1
  points[i] = {{ side * (1.9 * a - 0.95), 0.4 * b - 0.2 }}
end
local bar = r.rectangle {{ width = 2, height = 0.5, points = points, stiffness = 1e5 }}
return r.scene {{ projectile = r.rotated {{ body = bar, angle = 50 * side }}, target = r.plane {{}},
  contact = {{ V0 = 150, xi = 300, reach = 0.1, sides = "two" }}, launch = {{ speed = 0.02 }} }})lua",
                               side));
  return made.scene();
}

}  // namespace

TEST_CASE("a tilted bar takes the spin of its impulse's arm, and its mirror image the opposite") {
  const Scene left = tilted_bar(1), right = tilted_bar(-1);
  const BuiltSolids built(left), mirrored(right);
  const Outcome a = run_scene(built, left, go_on), b = run_scene(mirrored, right, go_on);
  REQUIRE(a.status == Status::finished);
  CHECK(a.e == Approx(b.e).epsilon(1e-6));
  CHECK(a.omega == Approx(-b.omega).epsilon(1e-6));
  // It strikes once: its centre leaves upwards.  omega I = (r x J)_z with r from the centre of mass to the lowest
  // corner: the plane pushes along its normal alone.
  Vec2 lowest = built[0].points[0];
  for (const Vec2& p : built[0].points)
    if (p.y() < lowest.y()) lowest = p;
  const double arm = (lowest - built[0].centre()).x();
  CHECK(std::abs(arm) > 0.4);
  CHECK(a.omega == Approx(arm * a.impulse_n / built[0].inertia()).epsilon(0.02));
}

namespace {

Scene two_bodies(const std::string& launch, const std::string& motion) {
  const Chunk made(R"lua(
local bar = r.rectangle { width = 2, height = 0.6, nodes = 80, placement = "poisson_disk", )lua" +
                   motion + R"lua( }
return r.scene { projectile = r.disk { radius = 0.7, nodes = 60, placement = "poisson_disk" }, target = bar,
  contact = { V0 = 150, xi = 300, reach = 0.1, sides = "two" }, launch = { at = 0.3, spin = 0.02, )lua" +
                   launch + " } }");
  return made.scene();
}

}  // namespace

TEST_CASE("an impact on a moving target is that of the other frame") {
  const Scene rest = two_bodies("normal_speed = 0.1, tangential_speed = 0.02", "spin = 0.03");
  const Scene moving =
      two_bodies("normal_speed = 0.06, tangential_speed = 0.05", "velocity = {0.03, 0.04}, spin = 0.03");
  const BuiltSolids built(rest), other(moving);
  const Outcome a = run_scene(built, rest, go_on), b = run_scene(other, moving, go_on);
  REQUIRE(a.status == Status::finished);
  REQUIRE(b.status == Status::finished);
  CHECK(a.steps == b.steps);
  for (const auto& [x, y] : {std::pair(a.vn, b.vn),
                             {a.vt, b.vt},
                             {a.omega, b.omega},
                             {a.e, b.e},
                             {a.contact_time, b.contact_time},
                             {a.impulse_n, b.impulse_n},
                             {a.impulse_t, b.impulse_t}})
    CHECK(x == Approx(y).epsilon(1e-8));
  CHECK(b.momentum_residual < 1e-10);
  CHECK(b.energy_closure < 1e-4);
  // The ledger is of space, in which the target moves and turns.
  const double mass = other[1].total_mass();
  CHECK(b.before.bodies[1].translation == Approx(mass * 0.0025 / 2).epsilon(1e-12));
  CHECK(b.before.bodies[1].rotation == Approx(other[1].inertia() * 9e-4 / 2).epsilon(1e-12));
  CHECK(a.before.bodies[1].translation < 1e-20);
  CHECK(rest.hash() != moving.hash());
  // A target that flies away as fast is never met.
  const Scene away = two_bodies("normal_speed = 0.06", "velocity = {0, -0.06}");
  CHECK(run_scene(BuiltSolids(away), away, go_on).status == Status::no_contact);
}

TEST_CASE("a spinning target turns while the projectile comes, and is met as it then stands") {
  const Scene scene = two_bodies("normal_speed = 0.1, height = 1", "spin = 0.05");
  const BuiltSolids built(scene);
  const Start start = launch(scene, built);
  REQUIRE(start.touches);
  const Placement &p = start.bodies[0], &t = start.bodies[1];
  CHECK(p.time > 5);
  CHECK((t.turn(Vec2(1, 0)) - Vec2(std::cos(0.05 * p.time), std::sin(0.05 * p.time))).norm() < 1e-12);
  CHECK(in_plane(t.centre) == built[1].centre());
  const PlacedSurface one(built[0].surface, placed(surface_points(built[0]), built[0].centre(), p));
  const PlacedSurface other(built[1].surface, placed(surface_points(built[1]), built[1].centre(), t));
  const double apart = distance_of(one, other);
  CHECK(apart <= start.contact.reach);
  CHECK(apart > 0.9 * start.contact.reach);
}

TEST_CASE("bodies have not parted for good while a spinning target can still strike") {
  // A small body 0.1 above a bar of half length 2, leaving at 0.01 c.
  Mesh<2> mesh;
  mesh.node = {0, 1, 2, 3};
  mesh.cell = ring(4);
  const Surface square = mesh;
  const PlacedSurface bar(square, {{-2, -0.1}, {2, -0.1}, {2, 0.1}, {-2, 0.1}});
  const PlacedSurface small(square, {{-0.1, 0.2}, {0.1, 0.2}, {0.1, 0.4}, {-0.1, 0.4}});
  const RelativeFlight leaving{{0, 0.3}, {0, 0}, {0, 0.01}, 0, 0};
  RelativeFlight under_blows = leaving, too_slow = leaving;
  under_blows.other_turning = 0.5;
  too_slow.other_turning = 1e-4;
  CHECK(clear_for_good(small, bar, leaving));
  CHECK_FALSE(clear_for_good(small, bar, under_blows));
  CHECK(clear_for_good(small, bar, too_slow));
}

TEST_CASE("launch.at ends alike at both edges of the target") {
  const auto starts = [](double at) {
    const Chunk made(fmt::format(R"lua(
return r.scene {{ projectile = r.rectangle {{ width = 2, height = 1, points = {} }},
  target = r.rectangle {{ width = 4, height = 1, nodes = 60, interior = "rigid" }}, launch = {{ at = {} }} }})lua",
                                 grid(8, 4, 2, 1), at));
    const Scene& scene = made.scene();
    try {
      return launch(scene, BuiltSolids(scene)).touches ? std::string("touches") : std::string("misses");
    } catch (const FieldError& error) {
      return std::string(error.what());
    }
  };
  for (const int side : {-1, 1}) {
    CHECK(starts(side * 2.99) == "touches");
    CHECK(starts(side * 3.0) ==
          fmt::format("a projectile at x = {} R passes beside the target; give more than -3 R and "
                      "less than 3 R",
                      3 * side));
    CHECK_THAT(starts(side * 3.001), Catch::Matchers::Contains("passes beside the target"));
  }
}

TEST_CASE("a body that lands on either edge of its target does the same, mirrored") {
  const auto on_edge = [](int side) {
    const Chunk made(fmt::format(R"lua(
local side = {}
local function strewn(count, inside)
  local points = {{}}
  for i = 1, count do
    local x, y = 2 * ((0.754877666 * i) % 1) - 1, 2 * ((0.569840291 * i) % 1) - 1
    if inside(x, y) then points[#points + 1] = {{ side * x, y }} end
  end
  return points
end
local octagon = r.regular_polygon {{ sides = 8, points = strewn(60, function(x, y) return x * x + y * y < 0.7 end) }}
local block = r.rectangle {{ width = 2.2, height = 2.2, points = strewn(60, function() return true end) }}
return r.scene {{ projectile = octagon, target = block, launch = {{ at = 1.6 * side, speed = 0.1 }},
  contact = {{ V0 = 150, xi = 300, reach = 0.1, sides = "two" }} }})lua",
                                 side));
    const Scene& scene = made.scene();
    return run_scene(BuiltSolids(scene), scene, go_on);
  };
  const Outcome left = on_edge(-1), right = on_edge(1);
  REQUIRE(left.status == Status::finished);
  CHECK(left.vt < -0.03);  // off the edge, not off the top
  CHECK(left.e_n == Approx(right.e_n).epsilon(1e-6));
  CHECK(left.vt == Approx(-right.vt).epsilon(1e-6));
  CHECK(left.omega == Approx(-right.omega).epsilon(1e-6));
}

TEST_CASE("points come from a file beside the script, and another file makes another scene") {
  const Workplace here;
  const char* script = R"lua(local r = require "ricochet"
local body = r.polygon { outline = r.points "data/shape.csv", nodes = 40 }
print(r.scene { projectile = body, target = r.plane {} }:hash(), #r.points("data/shape.csv"))
print(r.scene { projectile = r.rotated { body = body, angle = 0 }, target = r.plane {} }:hash())
)lua";
  here.write("data/shape.csv", "\xef\xbb\xbf# a square\r\nx [R], y [R]\r\n0, 0\r\n +1,0\r\n\r\n1;1\r\n0 , 1e0\r\n0,0");
  const Ended first = here.script(script);
  INFO(first.err);
  REQUIRE(first.status == 0);
  CHECK_THAT(first.out, Catch::Matchers::Contains("\t5\n"));
  const std::string hash = first.out.substr(0, 32);
  CHECK_THAT(first.out, Catch::Matchers::Contains("5\n" + hash));  // a turn by nothing is no other scene
  CHECK(here.script(script, "--force").out == first.out);
  here.write("data/shape.csv", "0,0\n1,0\n1,1\n0,1\n");
  const Ended second = here.script(script, "--force");
  CHECK(second.out.substr(0, 32) != hash);

  const auto refused = [&](const std::string& file, const std::string& text, const std::string& message, int status) {
    here.write("bad.csv", text);
    const Ended ended = here.script("local r = require 'ricochet'\nprint(#r.points(" + file + "))", "--force");
    CHECK(ended.status == status);
    CHECK(ended.first_line() == "error: s.lua:2: points: " + message);
  };
  refused("'bad.csv'", "0,0\n1,0\n1,one\n", "bad.csv:3: 'one' is no finite number; give lines x,y", 1);
  refused("'bad.csv'", "x,y\na,b\n", "bad.csv:2: 'a' is no finite number; give lines x,y", 1);
  refused("'bad.csv'", "1,nan\n", "bad.csv:1: 'nan' is no finite number; give lines x,y", 1);
  refused("'bad.csv'", "1 2\n", "bad.csv:1: '1 2' has no comma; give lines x,y", 1);
  refused("'bad.csv'", "1,2,3\n", "bad.csv:1: '1,2,3' holds more than two columns; give lines x,y", 1);
  refused("'bad.csv'", "# nothing\n", "bad.csv holds no points; give lines x,y", 1);
  refused("'none.csv'", "", "there is no file 'none.csv' beside the script", 4);
  refused("'data'", "", "there is no file 'data' beside the script", 4);
  refused("3", "", "takes the name of a file beside the script, is 3", 1);
  // The sandbox's walls.
  const auto wall = [&](const std::string& name, const std::string& message) {
    const Ended ended = here.script("local r = require 'ricochet'\nr.points('" + name + "')", "--force");
    CHECK_THAT(ended.first_line(), Catch::Matchers::Contains(message));
  };
  wall("../shape.csv", "'../shape.csv' is no name below the script's folder");
  wall("/etc/passwd", "'/etc/passwd' is no name below the script's folder");
  here.shell("ln -s /etc/passwd link.csv");
  wall("link.csv", "'link.csv' leads out of the script's folder");
}
