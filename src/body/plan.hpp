#pragma once
// Where the nodes of a body lie, before they are joined.

#include "body/description.hpp"

namespace ricochet {

/// Rim first, in order, counter-clockwise.
struct NodePlan {
  Points points;
  int rim = 0;
  Points smooth_rim;         ///< the rim's points before roughness
  std::vector<int> corners;  ///< which of them are corners of the outline
};

/// The rim's points before roughness, which say where a body's outline lies and which rim nodes an anchor predicate
/// holds.
Points plan_rim(const Points& outline, const BodyNumbers& numbers);

/// Rim and interior points; of a rigid body the rim alone. Anchored rim nodes (by `anchored_rim`, in rim order; may be
/// empty) stay smooth. Throws if the outline or the rough rim crosses itself, or if the outline needs more points than
/// the body has nodes.
NodePlan plan_nodes(const Points& outline, const BodyNumbers& numbers, const std::vector<bool>& anchored_rim);

}  // namespace ricochet
