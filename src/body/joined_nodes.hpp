#pragma once
#include "body/plan.hpp"
#include "body/solid.hpp"

namespace ricochet {

/// The planned nodes, joined by triangles and numbered in reverse Cuthill-McKee order, the free ones before the
/// anchored: a solid that lacks its interior only.
struct JoinedNodes {
  std::shared_ptr<Solid> solid;
  std::vector<int> number;                 ///< [plan node] its number in the solid
  std::vector<std::pair<int, int>> edges;  ///< of the triangles, each once, by rising plan nodes
};

/// As an index.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

JoinedNodes join_nodes(const Body& body, const NodePlan& plan, const std::vector<Triangle>& triangles);

}  // namespace ricochet
