// Bodies whose rim is the hull of random points, springs across the valleys of rough rims, and lattices passed over.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "scenes.hpp"
#include "shape/hull.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

Body hull_body(int nodes, double roughness, int seed, const Points& outline = circle()) {
  return Body{outline, numbers(nodes, 1e4, roughness, seed, "hull"), {}, {}};
}

double area_of(const Points& points, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]) / 2;
  return sum;
}

Points at_places(const Points& points, const std::vector<std::size_t>& places) {
  Points some;
  for (const std::size_t i : places) some.push_back(points[i]);
  return some;
}

}  // namespace

TEST_CASE("a hull has no dent, and every point within") {
  Random random(7, 7);
  for (int round = 0; round < 50; ++round) {
    Points points;
    for (int i = 0; i < 5 + round; ++i) points.emplace_back(random.uniform(), random.uniform());
    points.push_back((points[0] + points[1]) / 2);
    const std::vector<std::size_t> corners = convex_hull(points);
    const Points hull = at_places(points, corners);
    CHECK(std::set<std::size_t>(corners.begin(), corners.end()).size() == corners.size());
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2 &a = hull[k], &b = hull[(k + 1) % hull.size()];
      CHECK(cross(b - a, hull[(k + 2) % hull.size()] - b) > 0);
      for (const Vec2& p : points) CHECK(cross(b - a, p - a) > -1e-12);
    }
  }
  // Points on a side are no corners.
  CHECK(convex_hull({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}).size() == 4);
}

TEST_CASE("placement hull: uniform points, of which the outermost are a convex rim of 3.38 n^(1/3) nodes") {
  // The mean number of corners of n points in a disk. [Renyi & Sulanke 1963, Z. Wahrscheinlichkeitsth. 2, 75]
  constexpr int lattices = 40, nodes = 800;
  double corners = 0, radius2 = 0;
  for (int seed = 1; seed <= lattices; ++seed) {
    const NodePlan plan = plan_nodes(hull_body(nodes, 0, seed), {});
    REQUIRE(plan.points.size() == nodes);
    CHECK(is_convex(Points(plan.points.begin(), plan.points.begin() + plan.rim)));
    corners += plan.rim / static_cast<double>(lattices);
    for (const Vec2& p : plan.points) {
      CHECK(p.norm() <= 1);
      radius2 += p.squaredNorm() / (lattices * nodes);
    }
  }
  CHECK(corners == Catch::Detail::Approx(3.3832 * std::cbrt(nodes)).margin(1.5));
  CHECK(radius2 == Catch::Detail::Approx(0.5).margin(5 / std::sqrt(12.0 * lattices * nodes)));
}

TEST_CASE("a rough hull keeps its number of nodes, all within, and weighs what its nodes or its area do") {
  Body body = hull_body(400, 0.03, 3);
  const auto lattice = build_solid(body);
  CHECK(lattice->nodes() == 400);
  CHECK(lattice->total_mass() == Catch::Detail::Approx(400).epsilon(1e-12));
  const NodePlan plan = plan_nodes(body, {});
  const Points rim(plan.points.begin(), plan.points.begin() + plan.rim);
  CellTree tree(rim, plan.rim_cells);
  for (std::size_t i = static_cast<std::size_t>(plan.rim); i < plan.points.size(); ++i)
    CHECK(inside(tree, plan.points[i]));
  body.numbers.mass = not_given;
  body.numbers.density = 100;
  CHECK(build_solid(body)->total_mass() == Catch::Detail::Approx(100 * signed_area(rim)).epsilon(1e-12));
}

TEST_CASE("placement hull refuses what has no hull of its own, by name") {
  const Points dented{{0, 0}, {2, 0}, {1, 0.5}, {2, 2}, {0, 2}};
  Body spaced = hull_body(100, 0, 1), kept = spaced, holed = spaced;
  spaced.numbers.rim_spacing = 0.1;
  kept.numbers.margin = 0.1;
  holed.holes = {{{0, 0.1}, {0.1, 0}, {0, -0.1}}};
  const std::pair<Body, const char*> refused[] = {{hull_body(100, 0, 1, dented), "convex outline without holes"},
                                                  {spaced, "says nothing of placement hull"},
                                                  {kept, "says nothing of placement hull"},
                                                  {holed, "convex outline without holes"}};
  for (const auto& [body, message] : refused)
    CHECK_THROWS_WITH(plan_nodes(body, {}), Catch::Matchers::Contains(message));
}

TEST_CASE("plain: every triangle is Delaunay's, they fill the hull of the nodes, and none is as thin as rounding") {
  for (const Points& outline : {circle(), box(4, 2)}) {
    Body body{outline, numbers(150, 1, 0.05, 2), {}, {}};
    const Points points = plan_nodes(body, {}).points;
    const std::vector<Triangle> triangles = triangulate(points);
    CHECK(area_of(points, triangles) ==
          Catch::Detail::Approx(signed_area(at_places(points, convex_hull(points)))).epsilon(1e-8));
    for (const Triangle& t : triangles) {
      const Vec2 a = points[t[0]], b = points[t[1]] - a, c = points[t[2]] - a;
      CHECK(cross(b, c) > 0);
      const Vec2 centre =
          Vec2(c.y() * b.squaredNorm() - b.y() * c.squaredNorm(), b.x() * c.squaredNorm() - c.x() * b.squaredNorm()) /
          (2 * cross(b, c));
      for (const Vec2& p : points) CHECK((p - a - centre).norm() >= centre.norm() * (1 - 1e-9));
    }
    const auto clipped = build_solid(body);
    body.numbers.triangulation = "plain";
    const auto plain = build_solid(body);
    CHECK(plain->springs()->list.size() > clipped->springs()->list.size());
    CHECK(plain->total_mass() == Catch::Detail::Approx(150).epsilon(1e-12));
  }
  // Of nodes on straight sides there is nothing to clip.
  Body smooth{box(4, 2), numbers(150, 1, 0, 2), {}, {}};
  const auto clipped = build_solid(smooth);
  smooth.numbers.triangulation = "plain";
  CHECK(build_solid(smooth)->cells.size() == clipped->cells.size());
}

TEST_CASE("plain is refused where it would fill a dent, a hole or elements") {
  Body dented{{{0, 0}, {2, 0}, {1, 0.5}, {2, 2}, {0, 2}}, numbers(100, 1, 0, 1), {}, {}};
  dented.numbers.triangulation = "plain";
  CHECK_THROWS_WITH(plan_nodes(dented, {}), Catch::Matchers::Contains("plain would join nodes across a dent"));
  Body elements{circle(), element_numbers(100, 1, 0.3), {}, {}};
  elements.numbers.triangulation = "plain";
  CHECK_THROWS_WITH(plan_nodes(elements, {}), Catch::Matchers::Contains("plain is of springs"));
}

TEST_CASE("a lattice that is passed over leaves another of its seed, which no other seed has") {
  Body first = hull_body(100, 0, 1), next = first;
  next.passed_over = 1;
  const Points one = plan_nodes(first, {}).points, other = plan_nodes(next, {}).points;
  CHECK(one != other);
  CHECK(first.geometry_text() != next.geometry_text());
  for (int seed = 2; seed < 30; ++seed) CHECK(plan_nodes(hull_body(100, 0, seed), {}).points != other);
  int crossing = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    try {
      plan_nodes(hull_body(800, 0.4, seed), {});
    } catch (const CrossingRim&) {
      ++crossing;
    }
  }
  CHECK(crossing > 0);  // the knob has something to do
  CHECK(crossing < 40);
}
