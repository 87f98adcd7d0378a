#pragma once
#include <array>
#include <vector>

#include "core/vec2.hpp"

namespace ricochet {

using Triangle = std::array<int, 3>;  ///< node numbers, counter-clockwise

/// Delaunay triangles of `points` inside the closed polygon of the first `rim` points, whose edges are kept as
/// constraints: a concave outline keeps its shape and no sliver of the convex hull is left outside it. Throws Error if
/// two points coincide.
std::vector<Triangle> triangulate(const Points& points, int rim);

}  // namespace ricochet
