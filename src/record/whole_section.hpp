#pragma once
#include "core/frame.hpp"

namespace ricochet {

/// A mesh in which bodies of revolution, which are computed as the halves at x >= 0 of their sections, have both: for
/// pictures. The other half follows the first one, node by node; each has half of the mass and of the forces.
FrameMesh whole_section(const FrameMesh& halves);

/// A frame of that mesh. `halves`: of the mesh that the frame is of.
Frame whole_section(const FrameMesh& halves, const Frame& frame);

}  // namespace ricochet
