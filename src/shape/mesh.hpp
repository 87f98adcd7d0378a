#pragma once
// Meshes of triangles that are small where it matters.

#include "shape/size_field.hpp"
#include "shape/triangulate.hpp"

namespace ricochet {

/// Nodes inside a rim whose own lie as `size` asks: those that Delaunay refinement adds until no triangle has a longer
/// side than it should or an angle below 20.7 degrees [Shewchuk, Comput. Geom. 22, 21 (2002), by CGAL], then moved
/// towards the middles of their triangles. The rim's edges stay whole.
Points mesh_interior(const Rim& rim, const SizeField& size);

/// How good triangles are, and how large.
struct MeshQuality {
  double worst = 1;                  ///< least 12 sqrt(3) area / perimeter^2: 1 of an equilateral triangle
  double shortest = 0, longest = 0;  ///< side
  double area = 0;
};
MeshQuality quality_of(const Points& points, const std::vector<Triangle>& triangles);

}  // namespace ricochet
