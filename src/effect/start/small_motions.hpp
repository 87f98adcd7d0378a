#pragma once
#include <fmt/format.h>

#include "body/vibration.hpp"
#include "core/error.hpp"

namespace ricochet {

/// What was linearised holds while no neighbours move apart by a large part of their distance. Throws FieldError
/// "effects" where a warm body's displacements [R] at a temperature [m0 c^2] do.
inline void check_small_motions(const Solid& solid, const Points& displacement, double temperature) {
  const double share = largest_strain(solid, displacement);
  if (share > 0.5)
    throw FieldError("effects",
                     fmt::format("thermal: at a temperature of {:g} m0 c^2 neighbours move apart by {:.2g} of their "
                                 "distance, and the vibration is drawn for small motions; lower the temperature",
                                 temperature, share));
}

}  // namespace ricochet
