#include "shape/placed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/closest.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

double above(const Plane& plane, const Vec2& p) { return plane.normal.dot(in_space(p)) - plane.offset; }

// Of the corners of a box from a plane.
double above(const Plane& plane, const Box& box) {
  return std::min({above(plane, box.low), above(plane, box.high), above(plane, Vec2(box.low.x(), box.high.y())),
                   above(plane, Vec2(box.high.x(), box.low.y()))});
}

}  // namespace

const CellTree& PlacedSurface::tree() const {
  if (!tree_) tree_.emplace(points_, std::get<Mesh<2>>(surface_).cell);
  return *tree_;
}

bool PlacedSurface::contains(const Vec2& p) const { return plane() ? above(*plane(), p) < 0 : inside(tree(), p); }

double PlacedSurface::distance(const Vec2& p, double least) const {
  if (plane()) return std::min(least, above(*plane(), p));
  return tree().nearest(p, least, [&](std::size_t s) { return closest(p, tree().from(s), tree().to(s)).distance; });
}

double PlacedSurface::support(const Vec2& direction) const {
  if (!plane()) return ricochet::support(points_, direction);
  return direction == in_plane(plane()->normal) ? plane()->offset : std::numeric_limits<double>::infinity();
}

void PlacedSurface::within(const Vec2& p, double distance, std::vector<int>& cells) const {
  if (plane()) {
    if (above(*plane(), p) <= distance) cells.push_back(0);
    return;
  }
  tree().search(
      [&](const Vec2& low, const Vec2& high) {
        return p.x() >= low.x() - distance && p.x() <= high.x() + distance && p.y() >= low.y() - distance &&
               p.y() <= high.y() + distance;
      },
      [&](std::size_t s) {
        if (closest(p, tree().from(s), tree().to(s)).distance <= distance) cells.push_back(static_cast<int>(s));
      });
}

double PlacedSurface::height(double x, bool highest) const {
  if (plane()) return (plane()->offset - plane()->normal.x() * x) / plane()->normal.y();
  double height = std::numeric_limits<double>::quiet_NaN();
  tree().search([&](const Vec2& low, const Vec2& high) { return low.x() <= x && x <= high.x(); },
                [&](std::size_t s) {
                  const Vec2 &a = tree().from(s), &b = tree().to(s);
                  const double y = a.x() == b.x() ? (highest ? std::max(a.y(), b.y()) : std::min(a.y(), b.y()))
                                                  : a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
                  if (std::isnan(height) || (highest ? y > height : y < height)) height = y;
                });
  return height;
}

double box_distance(const PlacedSurface& a, const PlacedSurface& b) {
  if (a.plane()) return b.plane() ? 0 : std::max(0.0, above(*a.plane(), bounding_box(b.points())));
  if (b.plane()) return box_distance(b, a);
  const Box p = bounding_box(a.points()), q = bounding_box(b.points());
  const Vec2 gap = (q.low - p.high).cwiseMax(p.low - q.high).cwiseMax(0.0);
  return gap.norm();
}

double distance_of(const PlacedSurface& a, const PlacedSurface& b) {
  if (!a.plane() && !b.plane() && outlines_overlap(a.tree(), b.tree())) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& p : a.points()) least = b.distance(p, least);
  for (const Vec2& p : b.points()) least = a.distance(p, least);
  return std::max(0.0, least);
}

}  // namespace ricochet
