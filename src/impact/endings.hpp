#pragma once
// What ends an impact, seen in the rims of the two bodies: they have parted for good, or one is inside the other.

#include <cstddef>
#include <optional>

#include "core/vec2.hpp"

namespace ricochet {

/// The projectile as a rigid body, relative to the target.
struct Flight {
  Vec2 centre, target_centre;  ///< [R]
  Vec2 velocity;               ///< of the projectile relative to the target [c]
  double spin;                 ///< [c/R]
};

/// True if the rims are clear of each other along the normal or along the line of centres, move apart along it, and the
/// projectile, flying on as a rigid body, never comes back down: a spinning bar may, however fast it leaves.
bool clear_for_good(const Points& projectile, const Points& target, const Flight& flight);

/// A rim node of one body that is inside the other.
struct Intruder {
  int body;           ///< whose node it is: 0 the projectile's, 1 the target's
  std::size_t place;  ///< in its rim
  double depth;       ///< a target node's distance from the projectile's rim [R]
};

/// The first rim node of one body that is inside the other. A one-sided contact pushes projectile nodes only: a target
/// node may then stand in the gap between two of them, but no deeper than `gap` [R].
std::optional<Intruder> inside_one_another(const Points& projectile, const Points& target, bool two_sided, double gap);

}  // namespace ricochet
