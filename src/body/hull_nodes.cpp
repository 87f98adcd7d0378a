#include "body/hull_nodes.hpp"

#include <cmath>

#include "core/error.hpp"
#include "shape/hull.hpp"
#include "shape/outline.hpp"
#include "shape/placement.hpp"

namespace ricochet {
namespace {

void check_hull(const Body& body) {
  const auto refuse = [](const char* field, const char* message) { throw FieldError(field, message); };
  if (!body.holes.empty() || !is_convex(body.outline))
    refuse("placement", "hull is of a convex outline without holes; take another placement");
  if (body.numbers.axisymmetric())
    refuse("placement", "hull would leave the axis of an axisymmetric body; take another placement");
  if (!std::isnan(body.numbers.rim_spacing))
    refuse("rim_spacing", "says nothing of placement hull, whose rim lies as its nodes fall; leave it out");
  if (body.numbers.margin != 0)
    refuse("margin", "says nothing of placement hull, whose rim lies as its nodes fall; leave it out");
}

}  // namespace

HullNodes hull_nodes(const Body& body, Random& random) {
  check_hull(body);
  Rim outline;
  outline.add(body.outline);
  const Points points = place_interior(outline, Placement::uniform, {body.numbers.nodes, 0, 0}, random);
  HullNodes nodes;
  std::vector<bool> outermost(points.size(), false);
  for (const std::size_t corner : convex_hull(points)) {
    nodes.rim.push_back(points[corner]);
    outermost[corner] = true;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!outermost[i]) nodes.inside.push_back(points[i]);
  return nodes;
}

Points inside_rough_rim(const HullNodes& nodes, const Rim& rim, Random& random) {
  const CellTree tree(rim.points, rim.cells);
  Points points;
  for (const Vec2& p : nodes.inside)
    if (inside(tree, p)) points.push_back(p);
  const int missing = static_cast<int>(nodes.inside.size() - points.size());
  const Points drawn = place_interior(rim, Placement::uniform, {missing, 0, 0}, random);
  points.insert(points.end(), drawn.begin(), drawn.end());
  return points;
}

}  // namespace ricochet
