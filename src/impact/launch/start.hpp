#pragma once
#include <vector>

#include "contact/exponential_repulsion.hpp"
#include "impact/launch/placement.hpp"

namespace ricochet {

/// The solids of a scene, by index; shared by all its lanes.
using Solids = std::vector<const Solid*>;

/// Contact shows when its energy exceeds this share of the energy at launch.
inline constexpr double touch_share = 1e-6;

/// What the contact's reach cuts off, of one node, is less than this share of it.
inline constexpr double cut_share = touch_share / 100;

/// The start of a run: the bodies rigid, a reach apart.
struct Start {
  bool touches = true;            ///< false if the bodies pass by each other: nothing to integrate
  std::vector<Placement> bodies;  ///< by index
  std::vector<double> stiffness;  ///< by index: of the interior [m0 c^2/R^2]
  double step = 0, theta = 0, time_limit = 0;
  double least_step = 0;           ///< a shorter one is lost in rounding [R/c]
  double energy = 0;               ///< kinetic energy in the frame of the target's centre [m0 c^2]
  ExponentialRepulsion contact{};  ///< the scene's, its reach widened for a slow impact
  bool certified = false;          ///< energy below V0, all nodes pushed: none can come inside
  double fell = 0;                 ///< how long it fell before, from where gravity acts from the start [R/c]
  /// Height of the projectile's centre at which the smooth outlines just overlap, above the target's centre.
  double overlap_height = 0;
};

}  // namespace ricochet
