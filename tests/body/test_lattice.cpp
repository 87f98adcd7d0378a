#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "body/elasticity.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "scenes.hpp"
#include "shape/node_order.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

double area(const Solid& lattice) {
  double sum = 0;
  for (const Triangle& t : lattice.cells) {
    const Vec2 &a = lattice.points[t[0]], &b = lattice.points[t[1]], &c = lattice.points[t[2]];
    CHECK(cross(b - a, c - a) > 0);
    sum += cross(b - a, c - a) / 2;
  }
  return sum;
}

Points rim_of(const Solid& lattice) {
  Points rim;
  for (const int i : surface_nodes(lattice.surface)) rim.push_back(lattice.points[i]);
  return rim;
}

// Each edge of the cells once, the smaller end first.
std::set<std::array<int, 2>> edges_of(const Solid& lattice) {
  std::set<std::array<int, 2>> edges;
  for (const Triangle& t : lattice.cells)
    for (std::size_t k = 0; k < 3; ++k) edges.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  return edges;
}

const Points star{{0, 1},    {-0.25, 0.3}, {-1, 0.3},   {-0.4, -0.2}, {-0.6, -1},
                  {0, -0.5}, {0.6, -1},    {0.4, -0.2}, {1, 0.3},     {0.25, 0.3}};

}  // namespace

TEST_CASE("triangles fill the rough outline, convex or not, and nothing else") {
  for (const char* placement : {"uniform", "poisson_disk", "triangular"})
    for (const Points& outline : {circle(), box(4, 2), star}) {
      const Body body{outline, numbers(400, 1, 0.01, 3, placement), {}, {}};
      const auto lattice = build_solid(body);
      CHECK(area(*lattice) == Catch::Detail::Approx(signed_area(rim_of(*lattice))).epsilon(1e-12));
      // Euler: nodes - edges + triangles = 1 for a disk without holes, every edge once.
      CHECK(lattice->nodes() - static_cast<int>(edges_of(*lattice).size()) + static_cast<int>(lattice->cells.size()) ==
            1);
      if (std::string(placement) != "triangular")
        CHECK(lattice->nodes() == 400);
      else
        CHECK(std::abs(lattice->nodes() - 400) <= 12);
    }
}

TEST_CASE("the rim is the outline in order, spaced like the interior, with its corners") {
  const auto lattice = build_solid(Body{box(4, 2), numbers(800, 1, 0, 1), {}, {}});
  const double spacing = std::sqrt(8.0 / 800);
  const Points rim = rim_of(*lattice);
  for (std::size_t i = 0; i < rim.size(); ++i)
    CHECK((rim[(i + 1) % rim.size()] - rim[i]).norm() == Catch::Detail::Approx(spacing).epsilon(0.05));
  for (const Vec2& corner : box(4, 2))
    CHECK(std::any_of(rim.begin(), rim.end(), [&](const Vec2& p) { return (p - corner).norm() < 1e-12; }));
  CHECK(signed_area(rim) > 0);
  const std::set<std::array<int, 2>> edges = edges_of(*lattice);
  const std::vector<int>& nodes = surface_nodes(lattice->surface);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto [a, b] = std::minmax(nodes[i], nodes[(i + 1) % nodes.size()]);
    CHECK(edges.count({a, b}) == 1);
  }
}

TEST_CASE("roughness moves free rim nodes along their normals with the asked deviation, and anchored ones not") {
  double square = 0;
  int count = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    const NodePlan plan = plan_nodes(circle(), numbers(800, 1, 0.03, seed), {});
    const Points normals = outward_normals(plan.smooth_rim);
    for (int i = 0; i < plan.rim; ++i, ++count) {
      const Vec2 moved = plan.points[i] - plan.smooth_rim[i];
      CHECK(std::abs(cross(moved, normals[i])) < 1e-14);
      square += moved.squaredNorm();
    }
  }
  CHECK(std::sqrt(square / count) == Catch::Detail::Approx(0.03).epsilon(4 / std::sqrt(2.0 * count)));

  const auto body = wall(400, 100, 0.03, 5);
  const auto lattice = build_solid(*body);
  const std::vector<int>& nodes = surface_nodes(lattice->surface);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] >= lattice->free) CHECK(lattice->points[nodes[i]] == lattice->smooth[i]);
}

TEST_CASE("anchored nodes come last and springs between them are left out") {
  const auto lattice = build_solid(*wall(400, 100, 0, 1));
  int held = 0;
  for (int i = 0; i < lattice->nodes(); ++i) {
    const Vec2& p = lattice->points[i];
    const bool anchored = p.y() < -1.5 + 1e-9 || std::abs(p.x()) > 2 - 1e-9;
    CHECK(anchored == (i >= lattice->free));
    held += anchored;
  }
  CHECK(held > 20);
  CHECK(lattice->springs()->first[lattice->nodes()] == lattice->springs()->first[lattice->free]);
  for (int i = 0; i < lattice->free; ++i)
    for (int s = lattice->springs()->first[i]; s < lattice->springs()->first[i + 1]; ++s)
      CHECK(lattice->springs()->list[s].other > i);
}

TEST_CASE("a seed gives the same lattice on every machine") {
  // A golden hash: places of nodes (to 1e-9, the outline's cosines differ in their last bit between C libraries) and
  // edges.
  const auto lattice = build_solid(Body{box(2, 1), numbers(200, 1, 0.03, 7, "uniform"), {}, {}});
  std::string text;
  for (const Vec2& p : lattice->points) text += fmt::format("{:.9f} {:.9f};", p.x(), p.y());
  for (const auto& e : edges_of(*lattice)) text += fmt::format("{} {};", e[0], e[1]);
  CHECK(hash_text(text) == "7f6d48ac0588041b22cb3df1eab135ec");
  const auto other = build_solid(Body{box(2, 1), numbers(200, 1, 0.03, 8, "uniform"), {}, {}});
  CHECK(other->points[0] != lattice->points[0]);
}

TEST_CASE("reverse Cuthill-McKee brings joined nodes together and is a permutation") {
  const auto body = Body{box(8, 2), numbers(2000, 1, 0, 1, "uniform"), {}, {}};
  const auto lattice = build_solid(body);
  int bandwidth = 0;
  for (const auto& e : edges_of(*lattice)) bandwidth = std::max(bandwidth, e[1] - e[0]);
  CHECK(bandwidth < 150);  // about three columns of the short side, 22 nodes each; a random order has about 2000
  auto order = reverse_cuthill_mckee(5, {{0, 4}, {4, 2}, {1, 3}});
  std::sort(order.begin(), order.end());
  CHECK(order == std::vector<int>{0, 1, 2, 3, 4});
}

TEST_CASE("Poisson-disk nodes keep their distance and make no slivers inside") {
  const auto lattice = build_solid(Body{circle(), numbers(800, 1, 0, 1), {}, {}});
  const double spacing = std::sqrt(std::numbers::pi / 800);
  double nearest = 1, smallest = 180;
  for (const auto& e : edges_of(*lattice))
    nearest = std::min(nearest, (lattice->points[e[0]] - lattice->points[e[1]]).norm());
  for (const Triangle& t : lattice->cells)
    for (int k = 0; k < 3; ++k) {
      const Vec2 a = lattice->points[t[(k + 1) % 3]] - lattice->points[t[k]],
                 b = lattice->points[t[(k + 2) % 3]] - lattice->points[t[k]];
      smallest = std::min(smallest, std::atan2(std::abs(cross(a, b)), a.dot(b)) * 180 / std::numbers::pi);
    }
  CHECK(nearest > 0.7 * spacing);
  CHECK(smallest > 20);
}

TEST_CASE("a triangular lattice of springs k has E = 2k/sqrt(3) and nu = 1/3") {
  // Free sides are softer by a share of order one spacing over the width: 4 % here.
  const auto band =
      build_solid(Body{Points{{0, 0}, {2, 0}, {2, 6}, {0, 6}}, numbers(6000, 1, 0, 1, "triangular"), {}, {}});
  const auto moduli = stretch_band(*band, 50);
  CHECK(moduli.young_modulus / 50 == Catch::Detail::Approx(2 / std::sqrt(3.0)).epsilon(0.03));
  CHECK(moduli.poisson_ratio == Catch::Detail::Approx(1.0 / 3).epsilon(0.03));
}
