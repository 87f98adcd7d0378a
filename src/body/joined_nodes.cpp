#include "body/joined_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "shape/node_order.hpp"

namespace ricochet {
namespace {

using Edges = std::vector<std::pair<int, int>>;

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
  rim.cell = plan.rim_cells;
  return rim;
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

JoinedNodes join_nodes(const Body& body, const NodePlan& plan, const std::vector<Triangle>& triangles) {
  JoinedNodes joined{std::make_shared<Solid>(), {}, edges_of(triangles)};
  Solid& solid = *joined.solid;
  const std::vector<int> order = ordered(body, plan, joined.edges, solid);
  std::vector<int>& number = joined.number;
  number.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) number[at(order[k])] = static_cast<int>(k);
  solid.mass = masses_of(body, plan, triangles, number);
  for (const int old : order) solid.points.push_back(plan.points[at(old)]);
  solid.smooth = plan.smooth_rim;
  Mesh<2> rim = rim_of(plan, number);
  rim.weight = rim_shares(rim, plan.points);
  solid.surface = std::move(rim);
  solid.corners = plan.corners;
  for (const Triangle& t : triangles) solid.cells.push_back({number[at(t[0])], number[at(t[1])], number[at(t[2])]});
  return joined;
}

}  // namespace ricochet
