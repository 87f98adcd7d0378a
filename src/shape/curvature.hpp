#pragma once
// What a smooth outline looks like at a point of it.

#include "core/vec2.hpp"

namespace ricochet {

/// An outline at one of its points.
struct OutlineAt {
  Vec2 normal{0, 1};    ///< outward, of length 1
  double radius = 0;    ///< of curvature; infinite: flat; negative: hollow [R]
  bool corner = false;  ///< a turn of more than 30 degrees stands within `reach`: no radius
};

/// The outline, counter-clockwise, near `point`, which lies on it: the turns of its corners within `reach`, over the
/// arc that they stand for. Exact for a circle's polygon, however fine.
OutlineAt outline_at(const Points& outline, const Vec2& point, double reach);

/// Of the area enclosed, taken to be of one density. [R, R^2, R^4]
struct Figure {
  Vec2 centre;
  double area, moment;  ///< the second moment is about the centre
};

Figure figure_of(const Points& outline);

}  // namespace ricochet
