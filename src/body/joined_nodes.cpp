#include "body/joined_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// The rim as a surface that contact meets.
struct PlannedSurface {
  std::vector<int> planned;  ///< [surface node] its place in the plan
  Cells<2> cell;             ///< by places in `planned`
};

PlannedSurface whole_rim(const NodePlan& plan) {
  PlannedSurface surface{std::vector<int>(at(plan.rim)), plan.rim_cells};
  std::iota(surface.planned.begin(), surface.planned.end(), 0);
  return surface;
}

// Without the edges along the axis x = 0, behind which the body goes on. Chains that end there begin there: of a chain
// of the rim, the first cell is one that follows an edge along the axis.
PlannedSurface rim_off_axis(const NodePlan& plan) {
  const auto on_axis = [&](int node) { return plan.points[at(node)].x() == 0; };
  const auto inner = [&](const std::array<int, 2>& cell) { return on_axis(cell[0]) && on_axis(cell[1]); };
  PlannedSurface surface;
  std::vector<int> place(at(plan.rim), -1);
  for (auto begin = plan.rim_cells.begin(); begin != plan.rim_cells.end();) {
    const int first = (*begin)[0];
    const auto end = std::find_if(begin, plan.rim_cells.end(), [&](const auto& cell) { return cell[1] == first; }) + 1;
    Cells<2> ring(begin, end);
    if (const auto along = std::find_if(ring.begin(), ring.end(), inner); along != ring.end())
      std::rotate(ring.begin(), along, ring.end());
    for (const std::array<int, 2>& cell : ring) {
      if (inner(cell)) continue;
      for (const int node : cell) {
        if (place[at(node)] >= 0) continue;
        place[at(node)] = static_cast<int>(surface.planned.size());
        surface.planned.push_back(node);
      }
      surface.cell.push_back({place[at(cell[0])], place[at(cell[1])]});
    }
    begin = end;
  }
  return surface;
}

// The solid's surface, and what it remembers of the rim.
void set_surface(Solid& solid, const NodePlan& plan, const std::vector<int>& number) {
  const PlannedSurface planned = solid.axisymmetric ? rim_off_axis(plan) : whole_rim(plan);
  Mesh<2> rim{{}, planned.cell, {}};
  Points places;
  for (std::size_t k = 0; k < planned.planned.size(); ++k) {
    const int node = planned.planned[k];
    rim.node.push_back(number[at(node)]);
    places.push_back(plan.points[at(node)]);
    solid.smooth.push_back(plan.smooth_rim[at(node)]);
    if (std::find(plan.corners.begin(), plan.corners.end(), node) != plan.corners.end())
      solid.corners.push_back(static_cast<int>(k));
  }
  rim.weight = solid.axisymmetric ? ring_shares(rim, places) : rim_shares(rim, places);
  solid.surface = std::move(rim);
}

// Every node the mass that the script gave, or its share of each triangle at it.
Masses masses_of(const Solid& solid, const Body& body, const NodePlan& plan, const std::vector<Triangle>& triangles,
                 const std::vector<int>& number) {
  const double density = body.numbers.area_density();
  if (std::isnan(density)) return Masses(body.numbers.mass);
  std::vector<double> mass(plan.points.size(), 0.0);
  for (const Triangle& t : triangles) {
    const std::array<Vec2, 3> corner{plan.points[at(t[0])], plan.points[at(t[1])], plan.points[at(t[2])]};
    for (std::size_t k = 0; k < 3; ++k)
      mass[at(number[at(t[k])])] += corner_share(corner, k, solid.axisymmetric) *
                                    (body.node_density.empty() ? density : body.node_density[at(t[k])]);
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
  solid.axisymmetric = body.numbers.axisymmetric();
  solid.mass = masses_of(solid, body, plan, triangles, number);
  for (const int old : order) solid.points.push_back(plan.points[at(old)]);
  set_surface(solid, plan, number);
  for (const Triangle& t : triangles) solid.cells.push_back({number[at(t[0])], number[at(t[1])], number[at(t[2])]});
  return joined;
}

}  // namespace ricochet
