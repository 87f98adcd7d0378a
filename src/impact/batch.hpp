#pragma once
#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// What an observer sees of one impact at the end of a step. Positions [R] and velocities [c] by node of either
/// lattice.
struct Snapshot {
  double time = 0;  ///< since the rims came within reach of each other [R/c]
  std::int64_t step = 0;
  Points projectile, target, projectile_velocity, target_velocity;
  Points projectile_force, target_force;  ///< of contact [m0 c^2/R]
  Ledger energy;
  /// [projectile, target][spring] what effects have left of each; empty without effects that change springs.
  std::array<std::vector<SpringRest<double>>, 2> springs{};
};

/// Looks at a single impact without changing a bit of it. `due(time)` is asked at the end of every step whether to look
/// there.
struct Observer {
  double until = 0;  ///< go on up to this time, even past the end of the impact
  std::function<bool(double)> due;
  std::function<void(const Snapshot&)> look;
  bool no_longer = false;  ///< stop at `until`, even if the impact goes on: its outcome is then not_run
};

/// For `due`: true at the steps nearest to first, first + spacing, ... (count of them at most).
inline std::function<bool(double)> equally_spaced(double first, double spacing, std::int64_t count, double step) {
  return [=, seen = std::int64_t{0}](double time) mutable {
    if (seen >= count || time < first + static_cast<double>(seen) * spacing - step / 2) return false;
    ++seen;
    return true;
  };
}

/// The scenes of one group, handed out one by one to however many threads run them.
class Queue {
 public:
  explicit Queue(std::vector<std::size_t> scenes) : scenes_(std::move(scenes)) {}
  /// The next scene's place in the sweep.
  std::optional<std::size_t> take() {
    const std::size_t i = next_++;
    return i < scenes_.size() ? std::optional(scenes_[i]) : std::nullopt;
  }
  std::size_t left() const { return scenes_.size() - std::min(next_.load(), scenes_.size()); }
  void close() { next_ = scenes_.size(); }
  std::size_t first() const { return scenes_.front(); }

 private:
  std::vector<std::size_t> scenes_;
  std::atomic<std::size_t> next_ = 0;
};

/// Called as each impact ends: its place in the sweep, its outcome, and its share of the thread's time [s].
using Finished = std::function<void(std::size_t, const Outcome&, double)>;

/// How many steps lanes took, and how many of them were an impact's.
struct LaneUse {
  std::int64_t steps = 0, busy = 0;
};

/// Runs the scenes of a queue, `width` at a time (1 ... lanes), until none is left: a lane whose impact has ended takes
/// the next one. The outcome of a scene does not depend on `width`, on its neighbours or on when it starts. Returns
/// false if `stop` ended it early. Throws SceneError with the scene's place in `scenes` if one cannot start, when those
/// that were running have ended.
bool run_queue(const Lattice& projectile, const Lattice& target, const std::vector<Scene>& scenes, Queue& queue,
               int width, const std::atomic<bool>& stop, const Finished& finished, LaneUse& use);

/// Runs one scene alone, watched.
Outcome run_scene(const Lattice& projectile, const Lattice& target, const Scene& scene, const std::atomic<bool>& stop,
                  const Observer* observer = nullptr);

/// Throws FieldError if the scene cannot start.
void check_start(const Lattice& projectile, const Lattice& target, const Scene& scene);

/// Test hook: runs a scene alone up to `time` and returns the state there, whatever happens in between.
Snapshot run_until(const Lattice& projectile, const Lattice& target, const Scene& scene, double time);

}  // namespace ricochet
