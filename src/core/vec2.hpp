#pragma once
// Points and vectors of the plane.

#include <Eigen/Core>
#include <vector>

namespace ricochet {

using Vec2 = Eigen::Vector2d;
using Points = std::vector<Vec2>;

/// The z component of a x b.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// z x v for a rotation about the z axis: the velocity of a point at v when the body spins with omega = 1.
inline Vec2 perpendicular(const Vec2& v) { return {-v.y(), v.x()}; }

}  // namespace ricochet
