#pragma once
#include "body/joined_nodes.hpp"

namespace ricochet {

/// Springs along the edges of the triangles; prestressed ones are relaxed to where they balance, which moves the
/// solid's nodes.
Springs build_springs(const Body& body, const NodePlan& plan, JoinedNodes& joined);

}  // namespace ricochet
