#pragma once
// The greatest stresses in a body of elements, as it stands.

#include "body/description.hpp"
#include "body/solid.hpp"
#include "impact/outcome.hpp"
#include "impact/snapshot.hpp"

namespace ricochet {

/// NaN of a body that has no elements.
struct GreatestStress {
  double pressure = Outcome::undefined;         ///< of the nodes' pressures [m0 c^2/R^2, m0 c^2/R^3 of revolution]
  double von_mises = Outcome::undefined;        ///< the same of von Mises's stresses
  double von_mises_depth = Outcome::undefined;  ///< distance of that node from the surface, at rest [R]
};

/// Of the stresses at nodes, each the mean of its elements' by area (material/mean_stress.hpp); what is plastically
/// strained counts as it was left. `E`: the body's own.
GreatestStress greatest_stress(const Solid& solid, double E, const BodyShot& shot);

}  // namespace ricochet
