#pragma once
// Facts about bodies are in space: y up, and z = 0 in the plane. A turning in the plane is about z.

#include "core/vec2.hpp"

namespace ricochet {

using Vec3 = Eigen::Vector3d;

inline Vec3 in_space(const Vec2& v) { return {v.x(), v.y(), 0}; }
inline Vec3 about_z(double turning) { return {0, 0, turning}; }
inline Vec2 in_plane(const Vec3& v) { return {v.x(), v.y()}; }

}  // namespace ricochet
