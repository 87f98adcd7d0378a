#pragma once
// From the units of a scene's user to those inside, R, m0 and c. What comes back is scaled where rows are made.

#include <memory>

#include "core/units.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// The units in which a projectile in SI has the numbers of the paper's disk: half its greater extent is R, and its
/// density and stiffness are the defaults; of a body of revolution those of the volume. Throws FieldError if it is of
/// no material.
Units si_units(const Body& projectile);

/// A body whose numbers are in these units, in R, m0 and c. Throws FieldError, at `field`, for a body that is of no
/// material in SI, or of one in the paper's units.
std::shared_ptr<const Body> scaled(const std::shared_ptr<const Body>& given, const Units& units,
                                   const std::string& field);

}  // namespace ricochet
