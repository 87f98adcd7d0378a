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

bool PlacedSurface::closed() const {
  if (closed_) return *closed_;
  const auto chains = chains_of(std::get<Mesh<2>>(surface_).cell);
  return closed_.emplace(std::all_of(chains.begin(), chains.end(), [](const Chain& chain) { return chain.closed; }));
}

double PlacedSurface::depth(const Vec2& p) const {
  if (plane()) return std::max(0.0, -above(*plane(), p));
  if (!closed()) return depth_behind_open_chains(p);
  return contains(p) ? distance(p, std::numeric_limits<double>::infinity()) : 0;
}

// Where the nearest place is a node of two cells, the side is that of the mean of their normals; at an end p must stand
// beside the cell.
double PlacedSurface::depth_behind_open_chains(const Vec2& p) const {
  double least = std::numeric_limits<double>::infinity(), outwards = 0;
  int met = 0;
  bool beside = false;
  for (std::size_t s = 0; s < tree().size(); ++s) {
    const Vec2 edge = tree().to(s) - tree().from(s);
    const Closest c = closest(p, tree().from(s), tree().to(s));
    if (c.distance > least) continue;
    if (c.distance < least) {
      outwards = 0;
      met = 0;
      beside = false;
    }
    least = c.distance;
    outwards -= perpendicular(edge).normalized().dot(c.away);
    beside = beside || (c.along > 0 && c.along < 1);
    ++met;
  }
  return outwards < 0 && (beside || met > 1) ? least : 0;
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
