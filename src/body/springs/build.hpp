#pragma once
#include "body/plan.hpp"
#include "body/solid.hpp"

namespace ricochet {

/// The planned nodes joined along the edges of their triangles, numbered in reverse Cuthill-McKee order, the free ones
/// before the anchored; prestressed springs are relaxed to where they balance.
std::shared_ptr<const Solid> build_lattice(const Body& body, const NodePlan& plan,
                                           const std::vector<Triangle>& triangles);

}  // namespace ricochet
