#pragma once
// Where the nodes of a body lie, before they are joined.

#include "body/description.hpp"
#include "core/error.hpp"
#include "shape/triangulate.hpp"

namespace ricochet {

/// The rim's nodes first, chain by chain.
struct NodePlan {
  Points points;
  int rim = 0;
  Cells<2> rim_cells;
  Points smooth_rim;                ///< the rim's points before roughness
  std::vector<int> corners;         ///< which of them are corners of an outline
  std::vector<Triangle> triangles;  ///< of a mesh that has its own; else those of Delaunay
};

/// The rough rim of a lattice crosses itself, which that of another seed may not.
struct CrossingRim : FieldError {
  using FieldError::FieldError;
};

/// The rim before roughness, which says where a body's outline lies and which rim nodes an anchor predicate holds.
Rim plan_rim(const Body& body);

/// Rim and interior points; of a rigid body the rim alone. Anchored rim nodes (by `anchored_rim`, in rim order; may be
/// empty) stay smooth. `Body::angle` is not applied yet. Throws FieldError if a chain crosses itself or another, of the
/// rough rim CrossingRim, or if the outline needs more points than the body has nodes.
NodePlan plan_nodes(const Body& body, const std::vector<bool>& anchored_rim);

/// Turns places counter-clockwise about the origin; exact for quarter turns. [degrees]
void turn(Points& points, double angle);

/// The plan, turned so.
NodePlan turned(NodePlan plan, double angle);

}  // namespace ricochet
