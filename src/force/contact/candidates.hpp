#pragma once
#include <vector>

#include "core/vec2.hpp"

namespace ricochet {

/// A rim node of one body and a rim segment of the other, by their place in their rims: segment s joins rim s and rim s + 1.
struct Pair {
  int node, segment;
};

/// Closest approach of a point to a segment.
struct Closest {
  Vec2 away;      ///< from the closest point of the segment to the point
  double distance;
  double along;   ///< where the closest point lies: 0 at a, 1 at b
};

inline Closest closest(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 edge = b - a, offset = point - a;
  const double length2 = edge.x() * edge.x() + edge.y() * edge.y();
  const double t = length2 > 0 ? (offset.x() * edge.x() + offset.y() * edge.y()) / length2 : 0.0;
  const double along = t < 0 ? 0.0 : t > 1 ? 1.0 : t;
  const Vec2 away = offset - along * edge;
  return {away, std::sqrt(away.x() * away.x() + away.y() * away.y()), along};
}

/// Every pair of a node of `nodes` and a segment of the closed chain `rim` at most `distance` apart, by rising node, then segment.
std::vector<Pair> pairs_within(const Points& nodes, const Points& rim, double distance);

/// A lower bound of the distance of two point sets: that of their bounding boxes; 0 if these overlap.
double box_distance(const Points& a, const Points& b);

/// The smallest distance of a node of either chain from a segment of the other, and 0 if they overlap in area.
double chain_distance(const Points& a, const Points& b);

}  // namespace ricochet
