#pragma once
// What makes a scene's numbers doubtful, before anything is computed.

#include <array>

#include "impact/estimate.hpp"

namespace ricochet {

/// Those that need no law of the contact.
void add_doubts_of_bodies(const Scene& scene, double speed, Estimate& e);

/// Those of a contact by its law, of projectile and target: where it is in each as it was described, and the radii of
/// curvature there. [R]
void add_doubts_of_contact(const Scene& scene, const std::array<Vec2, 2>& places, const std::array<double, 2>& radii,
                           Estimate& e);

/// Of the nodes of a lattice, or the sides of a mesh at a place; 0 of a rigid body. [R]
double spacing_of(const Body& body, const Vec2& place);

/// 1 if a pressure passes what starts to yield, of a body that no effect lets yield, 0 if not; NaN where no body has a
/// yield stress.
double pressure_over_yield(const Scene& scene, double pressure);

}  // namespace ricochet
