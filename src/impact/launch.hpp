#pragma once
#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// The factor by which the target's frequencies count against the stability limit: 1, or more for a multirate method,
/// which follows its springs in long steps.
inline double slower_by(const Method& method) {
  return method.multirate() ? method.stability_limit / method.slow_limit : 1;
}

/// Contact shows when its energy exceeds this share of the energy at launch.
inline constexpr double touch_share = 1e-6;

/// Endings and the contact's shape are looked at every so many force evaluations.
inline constexpr int evaluations_between_looks = 64;

/// A rigid motion of the projectile from its lattice's rest position.
struct Pose {
  Vec2 centre = Vec2::Zero();  ///< of mass
  double angle = 0;            ///< turned by, counter-clockwise
};

/// The start of an impact: the projectile rigid, a reach away from the target.
struct Start {
  bool touches = true;  ///< false if the projectile passes by: nothing to integrate
  Pose pose{};
  Vec2 velocity = Vec2::Zero();
  double spin = 0;
  double step = 0, theta = 0, time_limit = 0;
  double energy = 0;               ///< kinetic energy [m0 c^2]
  ExponentialRepulsion contact{};  ///< the scene's, its reach widened for a slow impact
  bool certified = false;          ///< energy below V0: no node can cross a segment
  double overlap_height =
      0;  ///< height of the projectile's centre at which the smooth outlines just overlap, above the target's centre
};

/// Places the projectile upstream of where it is to land, and skips the free flight up to the first approach within
/// reach: a conservative advancement over the rigid rims, which cannot step over a touch even with spin. Throws Error
/// if the bodies overlap at the start, or a given time step exceeds the stability limit or what resolves the contact.
Start launch(const Scene& scene, const Lattice& projectile, const Lattice& target);

/// The least distance of the rims [R] on the straight flight from a start, or the first one found that is at most
/// `enough` (above 0); in a flight almost parallel to the surface only as far as 100,000 advances go.
double closest_approach(const Start& start, const Lattice& projectile, const Lattice& target, double enough);

/// Rim points of a body in a pose.
Points posed(const Points& points, const Vec2& centre, const Pose& pose);

}  // namespace ricochet
