#pragma once
// A body that gravity brings back: one impact after another, with what vibrates on from each.

#include <atomic>
#include <string>
#include <vector>

#include "impact/launch/start.hpp"
#include "impact/scene.hpp"

namespace ricochet {

struct Bounce {
  double speed;   ///< normal speed of the projectile's centre relative to the target's at the first touch [c]
  double e;       ///< that at parting over it
  double height;  ///< to which the centre rises after it, above where it was at the first touch [R]
  double time;    ///< of the first touch, since the surfaces first came within reach of each other [R/c]
};

struct Bounces {
  std::vector<Bounce> list;
  std::string reason;  ///< a sentence if there are fewer than were asked for
};

/// Throws FieldError if gravity does not act on the projectile.
void check_bounces(const Scene& scene);

/// Follows a scene through `count` bounces, each from its first touch to the top of the rise after it, in one run.
/// `least_height`: a bounce that rises less is the last one [R]; NaN: the reach of the contact, below which bodies do
/// not part. Only a time_limit that is given limits the whole run. Throws FieldError if gravity does not act on the
/// projectile.
Bounces follow_bounces(const Solids& solids, const Scene& scene, int count, double least_height,
                       const std::atomic<bool>& stop);

}  // namespace ricochet
