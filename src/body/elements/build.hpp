#pragma once
#include "body/joined_nodes.hpp"

namespace ricochet {

/// The triangles of the solid as elements. Throws FieldError if every node is to have the same mass.
Elements build_elements(const Body& body, const JoinedNodes& joined);

}  // namespace ricochet
