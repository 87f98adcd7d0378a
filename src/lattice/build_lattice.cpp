// Apart from lattice.cpp, so that a program that makes its lattices itself does not need CGAL.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "lattice/lattice.hpp"
#include "lattice/node_order.hpp"
#include "lattice/tangent.hpp"

namespace ricochet {
namespace {

constexpr std::uint32_t prestress_stream = 3;

std::vector<std::pair<int, int>> edges_of(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<int, int>> edges;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(std::minmax(t[i], t[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

std::shared_ptr<const Lattice> build_lattice(const Body& body) {
  const auto held = [&](std::size_t i) { return !body.anchored.empty() && body.anchored[i]; };
  const NodePlan plan = plan_nodes(body.outline, body.numbers, body.anchored);
  const std::vector<Triangle> triangles = triangulate(plan.points, plan.rim);
  const auto edges = edges_of(triangles);

  // Reverse Cuthill-McKee order, free nodes before anchored ones.
  std::vector<int> order = reverse_cuthill_mckee(static_cast<int>(plan.points.size()), edges);
  const auto anchors =
      std::stable_partition(order.begin(), order.end(), [&](int i) { return !held(static_cast<std::size_t>(i)); });
  std::vector<int> number(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) number[static_cast<std::size_t>(order[k])] = static_cast<int>(k);

  auto lattice = std::make_shared<Lattice>();
  lattice->mass = body.numbers.mass;
  lattice->quartic = body.numbers.quartic;
  lattice->uniform = body.node_stiffness.empty();
  lattice->free = static_cast<int>(anchors - order.begin());
  for (const int old : order) lattice->points.push_back(plan.points[static_cast<std::size_t>(old)]);
  lattice->smooth_rim = plan.smooth_rim;
  for (int i = 0; i < plan.rim; ++i) lattice->rim.push_back(number[static_cast<std::size_t>(i)]);
  for (const Triangle& t : triangles)
    lattice->triangles.push_back({number[static_cast<std::size_t>(t[0])], number[static_cast<std::size_t>(t[1])],
                                  number[static_cast<std::size_t>(t[2])]});

  struct Edge {
    int low, high;
    bool on_rim;
    double stiffness;
  };
  std::vector<Edge> springs;
  for (const auto& [a, b] : edges) {
    const auto [low, high] = std::minmax(number[static_cast<std::size_t>(a)], number[static_cast<std::size_t>(b)]);
    // The stiffness of a place is that at the middle of its ends' values, relative to the body's number.
    const double stiffness =
        body.node_stiffness.empty()
            ? 1.0
            : (body.node_stiffness[static_cast<std::size_t>(a)] + body.node_stiffness[static_cast<std::size_t>(b)]) /
                  2 / body.numbers.stiffness;
    const bool on_rim =
        b < plan.rim && (b - a == 1 || b - a == plan.rim - 1);  // edges are pairs a < b, the rim's nodes come first
    springs.push_back({low, high, on_rim, stiffness});
  }
  std::sort(springs.begin(), springs.end(),
            [](const Edge& a, const Edge& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  lattice->first.assign(plan.points.size() + 1, 0);
  for (const Edge& e : springs) {
    lattice->edges.push_back({e.low, e.high});
    if (e.low >= lattice->free) continue;
    const Vec2 d = lattice->points[static_cast<std::size_t>(e.high)] - lattice->points[static_cast<std::size_t>(e.low)];
    lattice->spring.push_back({e.low, e.high, e.on_rim, std::sqrt(d.x() * d.x() + d.y() * d.y()), e.stiffness});
    ++lattice->first[static_cast<std::size_t>(e.low) + 1];
  }
  for (std::size_t i = 0; i + 1 < lattice->first.size(); ++i) lattice->first[i + 1] += lattice->first[i];
  if (body.numbers.prestress > 0) {
    Random random(static_cast<std::uint64_t>(body.numbers.seed), prestress_stream);
    for (std::size_t s = 0; s < lattice->spring.size(); ++s)
      lattice->spring.set_length(
          s, lattice->spring[s].length * std::max(0.1, 1 + body.numbers.prestress * random.normal()));
    try {
      relax(*lattice);
    } catch (const Error& error) {
      throw FieldError(
          "prestress",
          fmt::format("{} is too much for this lattice ({} nodes, seed {}): {}; lower it or take another seed",
                      body.numbers.prestress, body.numbers.nodes, body.numbers.seed, error.what()));
    }
    for (int i = 0; i < lattice->free; ++i)
      for (int s = lattice->first[i]; s < lattice->first[i + 1]; ++s) {
        const Spring spring = lattice->spring[s];
        const double x = (lattice->points[spring.other] - lattice->points[i]).norm() - spring.length;
        lattice->rest_energy += spring.stiffness * x * x * (0.5 + 0.25 * lattice->quartic * x * x);
      }
  }
  return lattice;
}

}  // namespace ricochet
