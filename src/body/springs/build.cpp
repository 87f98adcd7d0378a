#include "body/springs/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/springs/tangent.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "shape/node_order.hpp"

namespace ricochet {
namespace {

constexpr std::uint32_t prestress_stream = 3;

using Edges = std::vector<std::pair<int, int>>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Each once, the smaller end first.
Edges edges_of(const std::vector<Triangle>& triangles) {
  Edges edges;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(std::minmax(t[i], t[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

// The planned nodes in the order that the solid numbers them in.
std::vector<int> ordered(const Body& body, const NodePlan& plan, const Edges& edges, Solid& solid) {
  std::vector<int> order = reverse_cuthill_mckee(static_cast<int>(plan.points.size()), edges);
  const auto held = [&](int i) { return !body.anchored.empty() && body.anchored[at(i)]; };
  const auto anchors = std::stable_partition(order.begin(), order.end(), [&](int i) { return !held(i); });
  solid.free = static_cast<int>(anchors - order.begin());
  return order;
}

Mesh<2> rim_of(const NodePlan& plan, const std::vector<int>& number) {
  Mesh<2> rim;
  for (int i = 0; i < plan.rim; ++i) rim.node.push_back(number[at(i)]);
  rim.cell = ring(plan.rim);
  return rim;
}

// The stiffness of a place is that at the middle of its ends' values, relative to the body's number.
double stiffness_of(const Body& body, int a, int b) {
  if (body.node_stiffness.empty()) return 1;
  return (body.node_stiffness[at(a)] + body.node_stiffness[at(b)]) / 2 / body.numbers.stiffness;
}

Springs join(const Body& body, const NodePlan& plan, const Edges& edges, const std::vector<int>& number,
             const Solid& solid) {
  std::vector<Spring> all;
  for (const auto& [a, b] : edges) {
    const auto [low, high] = std::minmax(number[at(a)], number[at(b)]);
    if (low >= solid.free) continue;
    const Vec2 d = solid.points[at(high)] - solid.points[at(low)];
    // Edges are pairs a < b, the rim's nodes come first.
    const bool on_rim = b < plan.rim && (b - a == 1 || b - a == plan.rim - 1);
    all.push_back({low, high, on_rim, std::sqrt(d.x() * d.x() + d.y() * d.y()), stiffness_of(body, a, b)});
  }
  std::sort(all.begin(), all.end(),
            [](const Spring& a, const Spring& b) { return std::pair(a.node, a.other) < std::pair(b.node, b.other); });
  Springs springs;
  springs.law = static_cast<const SpringLawNumbers&>(body.numbers);
  springs.uniform = body.node_stiffness.empty();
  springs.first.assign(plan.points.size() + 1, 0);
  for (const Spring& spring : all) {
    springs.list.push_back(spring);
    ++springs.first[at(spring.node) + 1];
  }
  for (std::size_t i = 0; i + 1 < springs.first.size(); ++i) springs.first[i + 1] += springs.first[i];
  return springs;
}

void prestress(const Body& body, Solid& solid, Springs& springs) {
  const BodyNumbers& numbers = body.numbers;
  Random random(static_cast<std::uint64_t>(numbers.seed), prestress_stream);
  for (std::size_t s = 0; s < springs.list.size(); ++s)
    springs.list.set_length(s, springs.list[s].length * std::max(0.1, 1 + numbers.prestress * random.normal()));
  try {
    relax(solid, springs);
  } catch (const Error& error) {
    throw FieldError(
        "prestress",
        fmt::format("{} is too much for this lattice ({} nodes, seed {}): {}; lower it or take another seed",
                    numbers.prestress, numbers.nodes, numbers.seed, error.what()));
  }
  with_spring_law(springs.law, [&](const auto& law) {
    each_spring(springs, solid.free, [&](int i, int, const Spring& spring) {
      const double x = (solid.points[at(spring.other)] - solid.points[at(i)]).norm() - spring.length;
      springs.rest_energy += spring.stiffness * law.energy(x);
    });
  });
}

// Every node the mass that the script gave, or its share of the area: a third of each triangle at it.
Masses masses_of(const Body& body, const NodePlan& plan, const std::vector<Triangle>& triangles,
                 const std::vector<int>& number) {
  const double density = body.numbers.area_density();
  if (std::isnan(density)) return Masses(body.numbers.mass);
  std::vector<double> mass(plan.points.size(), 0.0);
  for (const Triangle& t : triangles) {
    const double area =
        cross(plan.points[at(t[1])] - plan.points[at(t[0])], plan.points[at(t[2])] - plan.points[at(t[0])]) / 2;
    for (const int node : t)
      mass[at(number[at(node)])] += area / 3 * (body.node_density.empty() ? density : body.node_density[at(node)]);
  }
  return Masses(std::move(mass));
}

}  // namespace

std::shared_ptr<const Solid> build_lattice(const Body& body, const NodePlan& plan,
                                           const std::vector<Triangle>& triangles) {
  const Edges edges = edges_of(triangles);
  auto solid = std::make_shared<Solid>();
  const std::vector<int> order = ordered(body, plan, edges, *solid);
  std::vector<int> number(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) number[at(order[k])] = static_cast<int>(k);

  solid->mass = masses_of(body, plan, triangles, number);
  for (const int old : order) solid->points.push_back(plan.points[at(old)]);
  solid->smooth = plan.smooth_rim;
  solid->surface = rim_of(plan, number);
  for (const Triangle& t : triangles) solid->cells.push_back({number[at(t[0])], number[at(t[1])], number[at(t[2])]});
  Springs springs = join(body, plan, edges, number, *solid);
  if (body.numbers.prestress > 0) prestress(body, *solid, springs);
  solid->interior = std::move(springs);
  return solid;
}

}  // namespace ricochet
