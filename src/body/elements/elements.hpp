#pragma once
// The interior of a body of elements: triangles of constant strain between its nodes.

#include <array>
#include <vector>

#include "material/edge_metric.hpp"
#include "material/solid_law.hpp"

namespace ricochet {

/// What a sweep needs of an element. Its edges d1, d2 lead from its lowest node to the others; F = [d1 d2] inverse, and
/// the forces on their ends are -P of_area^T.
struct ElementShape {
  std::array<double, 4> inverse;  ///< of [d1 d2] at rest, row by row [1/R]
  std::array<double, 4> of_area;  ///< the same times its weight [R]
};

/// What an element of a body of revolution has beside: it is a ring about the axis x = 0, whose F_zz is the sum of its
/// corners' x times `per_radii`. Each corner is pulled towards the axis by P_zz times `hoop`. [the rule of one point,
/// the centroid: Zienkiewicz & Taylor, The Finite Element Method, 2000, volume 1, chapter 5]
struct RingShape {
  double per_radii;  ///< 1 over the sum of the corners' x at rest [1/R]
  double hoop;       ///< its weight times per_radii [R^2]
};

/// Elements are a list by node: those of node i, the lowest of their three, are first[i] ... first[i+1]-1. Elements
/// between three anchored nodes, which never strain, are left out of it.
struct Elements {
  std::vector<int> first;                 ///< [node + 1] first element of a node
  std::vector<std::array<int, 3>> nodes;  ///< [element] by rising number
  std::vector<ElementShape> shape;        ///< [element]
  std::vector<EdgeMetric> metric;         ///< [element]
  std::vector<double> weight;             ///< [element] measure_at_rest(), times its E over the body's [R^2 or R^3]
  std::vector<std::array<int, 3>> edges;  ///< [element] between its nodes 0 1, 0 2 and 1 2
  std::vector<std::array<int, 2>> edge;   ///< [edge] its ends, by rising number
  SolidLawNumbers law;
  std::vector<Lame> lame;       ///< [element] its own, where nu depends on the place; else empty, as all have the law's
  std::vector<RingShape> ring;  ///< [element] of a body of revolution, else empty
  std::vector<double> off_axis;  ///< [node] of one: 0 on the axis, which it cannot leave, else 1

  int size() const { return static_cast<int>(nodes.size()); }
};

}  // namespace ricochet
