#pragma once
// What is followed of one run, beside the state: its start, its progress, its contact. Plain numbers of one lane.

#include <cstdint>
#include <vector>

#include "contact/pair.hpp"
#include "impact/launch/start.hpp"
#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// Of one pair of bodies.
struct TouchRecord {
  bool touching = false;
  int touches = 0;
  double first = 0, last = 0;  ///< when the first touch began, when the last ended [R/c]

  double duration() const { return touches > 0 ? last - first : 0.0; }
};

/// How the projectile lies on the target where it is indented most.
struct Indentation {
  bool seen = false;
  double depth = 0;  ///< overlap of the smooth outlines [R]
  double length = Outcome::undefined, centre_offset = Outcome::undefined, tan_alpha = Outcome::undefined;
};

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
  std::vector<TouchRecord> touch;  ///< [pair]
  Indentation indentation;
  double drift = 0;
  int looks = 0;
  double interior_bound = 0;  ///< squared frequency bound of the bodies when it was last taken [c^2/R^2]
  BodyNode bound_node;        ///< the node that set it
  double inverted = 0, inversion_time = Outcome::undefined;
  double theta_most = 0;  ///< greatest step times frequency bound, springs as stretched and contact included
  double seconds = 0;     ///< its share of the thread's time

  double time() const { return static_cast<double>(steps) * start.step; }
};

}  // namespace ricochet
