#pragma once
// What is followed of one run, beside the state: its start, its progress, its contact. Plain numbers of one lane.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "contact/pair.hpp"
#include "effect/acting.hpp"
#include "impact/launch/start.hpp"
#include "impact/outcome.hpp"
#include "impact/roles.hpp"
#include "impact/scene.hpp"
#include "impact/watch/smooth_outline.hpp"
#include "impact/watch/touches.hpp"

namespace ricochet {

/// The contact's geometry, summed over looks, each weighed by the load there.
struct ContactFrame {
  double load = 0;                                      ///< sum of the weights
  bool asked = false;                                   ///< a look beside the usual ones, in that touch
  double heaviest = 0;                                  ///< weight in the touch that lasts, or lasted last
  Vec2 normal = Vec2::Zero();                           ///< from the target to the projectile
  Unevenness uneven;                                    ///< of both rims
  std::array<Vec2, 2> arm{Vec2::Zero(), Vec2::Zero()};  ///< from the centres, projectile and target, to the contact [R]
  std::array<Eigen::Matrix2d, 2> arms2{Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};  ///< their squares, dyadic
  std::array<bool, 2> round{false, false};                                                 ///< the bodies are circles
  double overlap = Outcome::undefined;  ///< greatest, since the first touch began [R]
};

/// The projectile's centre relative to the target's in its flight before the first touch.
struct Approach {
  double time = 0;
  Vec2 place = Vec2::Zero(), velocity = Vec2::Zero();
};

/// A moment at which a run is looked at beside its usual looks: after the next step.
struct Due {
  bool frame = false, parting = false, end = false;
  bool any() const { return frame || parting || end; }
};

/// How the projectile lies on the target where it is indented most.
struct Indentation {
  bool seen = false;
  double depth = 0;  ///< overlap of the smooth outlines [R]
  double length = Outcome::undefined, centre_offset = Outcome::undefined, tan_alpha = Outcome::undefined;
};

// A body has folded when more than this share of its area is turned over; slivers of a random lattice do so in any
// impact. Of 20 Poisson-disk lattices of 800 nodes at 0.6 c, e is 0.955 or more up to 0.0018, 0.75 to 0.83 from 0.004
// on. [here]
inline constexpr double folded_share = 0.002;

inline constexpr double never = std::numeric_limits<double>::infinity();

struct Run {
  const Scene* scene = nullptr;  ///< nullptr: the lane is idle
  std::size_t index = 0;
  Start start;
  double threshold = 0;  ///< contact shows above this energy [m0 c^2]
  Ledger before;
  double energy_before = 0;
  std::vector<double> effects_before;  ///< [kind] energies of the effects
  double reference_height = 0;  ///< overlap of the smooth outlines is this minus the height between the centres [R]
  double projectile_radius = 0, target_radius = 0;  ///< from their centres to where they face each other [R]
  std::int64_t steps = 0;
  std::vector<TouchClock> clocks;  ///< [pair]
  double end_time = never;         ///< when the scene wants it ended, whatever the bodies do [R/c]
  Due due, due_now;                ///< after the next step, after the last one
  Approach approach;
  ContactFrame frame;
  /// Projectile and target when a touch had first ended with their centres moving apart, and when it had [R/c].
  std::optional<std::array<Flying, 2>> first_parting;
  double first_parting_time = Outcome::undefined;
  Indentation indentation;
  double penetration = 0;  ///< greatest depth of a surface node inside another body [R]
  double drift = 0;
  int looks = 0;
  double interior_bound = 0;  ///< squared frequency bound of the bodies when it was last taken [c^2/R^2]
  BodyNode bound_node;        ///< the node that set it
  double inverted = 0, inversion_time = Outcome::undefined;
  double theta_most = 0;  ///< greatest step times frequency bound, springs as stretched and contact included
  double seconds = 0;     ///< its share of the thread's time

  const TouchClock& clock() const { return clocks[role::aimed_pair]; }
  double time() const { return static_cast<double>(steps) * start.step; }
};

}  // namespace ricochet
