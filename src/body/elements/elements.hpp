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

/// Elements are a list by node: those of node i, the lowest of their three, are first[i] ... first[i+1]-1. Elements
/// between three anchored nodes, which never strain, are left out of it.
struct Elements {
  std::vector<int> first;                 ///< [node + 1] first element of a node
  std::vector<std::array<int, 3>> nodes;  ///< [element] by rising number
  std::vector<ElementShape> shape;        ///< [element]
  std::vector<EdgeMetric> metric;         ///< [element]
  std::vector<double> weight;             ///< [element] area at rest, times its E over the body's [R^2]
  std::vector<std::array<int, 3>> edges;  ///< [element] between its nodes 0 1, 0 2 and 1 2
  std::vector<std::array<int, 2>> edge;   ///< [edge] its ends, by rising number
  SolidLawNumbers law;

  int size() const { return static_cast<int>(nodes.size()); }
};

}  // namespace ricochet
