#pragma once
// From an aimed scene to the start of its impact. Here the first body is the projectile, the second the target.

#include "impact/launch/start.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// Places the projectile upstream of where it is to land, and skips the free flight up to the first approach within
/// reach: a conservative advancement over the rigid surfaces, which cannot step over a touch even with spin. Throws
/// FieldError if the bodies overlap at the start, or a given time step exceeds the stability limit or what resolves the
/// contact.
Start launch(const Scene& scene, const Solids& solids);

/// The projectile's velocity as it arrives at the target, seen from there: after the fall from a given height.
Vec2 arriving_velocity(const Scene& scene, bool target_is_held);

/// The acceleration of a body's free flight in the run: gravity's; none of a held body. [c^2/R]
Vec3 free_fall(const Scene& scene, const Solids& solids, std::size_t body);

/// A body at this time of the run, if nothing but gravity has acted on it since its start.
Placement in_flight(const Scene& scene, const Solids& solids, const Start& start, std::size_t body, double time);

}  // namespace ricochet
