#pragma once
#include <atomic>
#include <functional>
#include <span>

#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// What an observer sees of one impact at the end of a step. Positions [R] and velocities [c] by node of either lattice.
struct Snapshot {
  double time;  ///< since the rims came within reach of each other [R/c]
  Points projectile, target, projectile_velocity, target_velocity;
  Ledger energy;
};

/// Looks at a single impact without changing a bit of it, at the steps nearest to multiples of `interval`.
struct Observer {
  double interval = 0;
  double until = 0;  ///< go on looking up to this time, even past the end of the impact
  std::function<void(const Snapshot&)> look;
};

/// Called as each impact ends: its place in the batch, its outcome, and the seconds it spent in its lane over the lanes in use.
using Finished = std::function<void(std::size_t, const Outcome&, double)>;

/// Runs scenes of one group, `width` at a time (1 ... lanes): a lane whose impact has ended takes the next scene. The outcome
/// of a scene does not depend on `width`, on its neighbours or on when it starts. Returns false if `stop` ended it early.
/// Throws Error for a scene that cannot start.
bool run_batch(const Lattice& projectile, const Lattice& target, std::span<const Scene> scenes, int width, const std::atomic<bool>& stop,
               const Finished& finished);

/// Runs one scene alone, watched.
Outcome run_scene(const Lattice& projectile, const Lattice& target, const Scene& scene, const std::atomic<bool>& stop, const Observer* observer = nullptr);

/// Test hook: runs a scene alone up to `time` and returns the state there, whatever happens in between.
Snapshot run_until(const Lattice& projectile, const Lattice& target, const Scene& scene, double time);

}  // namespace ricochet
