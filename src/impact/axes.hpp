#pragma once
// Facts about bodies are in space; here alone it is said along which axes an impact is read: the normal is y, the
// tangent x, and a body turns about z. Accessors, no dot products.

#include "core/vec3.hpp"

namespace ricochet {

inline double normal(const Vec3& v) { return v.y(); }
inline double tangential(const Vec3& v) { return v.x(); }
inline double about(const Vec3& turning) { return turning.z(); }
inline double normal(const Vec2& v) { return v.y(); }
inline double tangential(const Vec2& v) { return v.x(); }

/// The unit normal, in the plane.
inline Vec2 upwards() { return {0, 1}; }

}  // namespace ricochet
