#pragma once
#include <array>
#include <vector>

#include "shape/surface.hpp"

namespace ricochet {

using Triangle = std::array<int, 3>;  ///< node numbers, counter-clockwise

/// Delaunay triangles of `points` between the closed chains of `rim`, whose edges are kept as constraints: a concave
/// outline keeps its shape, a hole stays free, and no sliver of the convex hull is left outside. Throws Error if two
/// points coincide.
std::vector<Triangle> triangulate(const Points& points, const Cells<2>& rim);

}  // namespace ricochet
