// From a description to a solid. Apart from solid.cpp, so that a program that makes its solids itself needs no CGAL.

#include "body/elements/build.hpp"

#include "body/modal/build.hpp"
#include "body/plan.hpp"
#include "body/solid.hpp"
#include "body/springs/build.hpp"
#include "shape/triangulate.hpp"

namespace ricochet {
namespace {

std::shared_ptr<const Solid> build_plane(const Plane& plane) {
  auto solid = std::make_shared<Solid>();
  solid->surface = plane;
  solid->interior = Rigid{};
  return solid;
}

// The rim alone, all of it held.
std::shared_ptr<const Solid> build_rigid(const NodePlan& plan) {
  auto solid = std::make_shared<Solid>();
  solid->points = plan.points;
  solid->smooth = plan.smooth_rim;
  solid->corners = plan.corners;
  Mesh<2> rim;
  for (int i = 0; i < plan.rim; ++i) rim.node.push_back(i);
  rim.cell = plan.rim_cells;
  rim.weight = rim_shares(rim, plan.points);
  solid->surface = std::move(rim);
  solid->interior = Rigid{};
  return solid;
}

std::vector<Triangle> triangles_of(const Body& body, const NodePlan& plan) {
  if (!plan.triangles.empty()) return plan.triangles;
  return body.numbers.plain() ? triangulate(plan.points) : triangulate(plan.points, plan.rim_cells);
}

}  // namespace

std::shared_ptr<const Solid> build_solid(const Body& body) {
  if (body.plane) return build_plane(*body.plane);
  const NodePlan plan = plan_nodes(body, body.anchored), placed = turned(plan, body.numbers.angle);
  if (body.rigid()) return build_rigid(placed);
  // Triangles of the plan as it was: a turned body is the same lattice.
  JoinedNodes joined = join_nodes(body, placed, triangles_of(body, plan));
  if (body.numbers.of_elements())
    joined.solid->interior = build_elements(body, joined);
  else
    joined.solid->interior = build_springs(body, placed, joined);
  return body.numbers.of_modes() ? as_modes(joined.solid, body.numbers.modes) : joined.solid;
}

}  // namespace ricochet
