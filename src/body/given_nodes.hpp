#pragma once
// Nodes that a script gives one by one.

#include "body/description.hpp"

namespace ricochet {

/// Points on a chain of the rim are its nodes, the others lie inside.
struct GivenNodes {
  std::vector<Points> on_chain;  ///< [chain] in order along it; empty where the rim is laid as usual
  Points inside;
};

/// `chains`: the outline, counter-clockwise, then the holes, clockwise. Throws FieldError for a point that lies
/// outside, for two that are the same, and for a chain that has points, but none at one of its corners.
GivenNodes given_nodes(const Points& points, const std::vector<Points>& chains);

}  // namespace ricochet
