#pragma once
#include <cmath>
#include <cstddef>

#include "core/vec2.hpp"

namespace ricochet {

/// Of `count` points p and segments a b. The pointers' __restrict lets the loop vectorise; there is no branch, only
/// selections.
inline void closest_points(std::size_t count, const double* __restrict px, const double* __restrict py,
                           const double* __restrict ax, const double* __restrict ay, const double* __restrict bx,
                           const double* __restrict by, double* __restrict along, double* __restrict away_x,
                           double* __restrict away_y, double* __restrict distance) {
  for (std::size_t i = 0; i < count; ++i) {
    const double edge_x = bx[i] - ax[i], edge_y = by[i] - ay[i], x = px[i] - ax[i], y = py[i] - ay[i];
    const double length2 = edge_x * edge_x + edge_y * edge_y;
    const double t = (x * edge_x + y * edge_y) / (length2 > 0 ? length2 : 1.0);
    const double above = t > 0 ? t : 0.0, on_segment = above < 1 ? above : 1.0;
    along[i] = on_segment;
    away_x[i] = x - on_segment * edge_x;
    away_y[i] = y - on_segment * edge_y;
    distance[i] = std::sqrt(away_x[i] * away_x[i] + away_y[i] * away_y[i]);
  }
}

/// Closest approach of a point to a segment.
struct Closest {
  Vec2 away;  ///< from the closest point of the segment to the point
  double distance;
  double along;  ///< where the closest point lies: 0 at a, 1 at b
};

inline Closest closest(const Vec2& point, const Vec2& a, const Vec2& b) {
  Closest c;
  closest_points(1, &point.x(), &point.y(), &a.x(), &a.y(), &b.x(), &b.y(), &c.along, &c.away.x(), &c.away.y(),
                 &c.distance);
  return c;
}

}  // namespace ricochet
