#pragma once
// Placement hull: nodes that fall anywhere in an outline, of which the outermost are the rim.

#include "body/description.hpp"
#include "core/rng.hpp"
#include "shape/surface.hpp"

namespace ricochet {

struct HullNodes {
  Points rim;     ///< the corners of the convex hull, counter-clockwise
  Points inside;  ///< the others
};

/// As many independent uniform points in the outline as the body has nodes. Throws FieldError if the body says what
/// goes with other placements alone, or if its outline has a dent or holes.
HullNodes hull_nodes(const Body& body, Random& random);

/// Those nodes that lie inside the rim, which roughness has moved since, and as many in the place of the others,
/// uniform in the rim.
Points inside_rough_rim(const HullNodes& nodes, const Rim& rim, Random& random);

}  // namespace ricochet
