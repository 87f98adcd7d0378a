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

/// Delaunay triangles of `points` alone, all those of their convex hull. None is as thin as rounding: along a straight
/// side it would join nodes across others. Throws as above.
std::vector<Triangle> triangulate(const Points& points);

}  // namespace ricochet
