#pragma once
#include <atomic>
#include <functional>
#include <vector>

#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// One scene of a sweep and what came of it.
struct Result {
  std::size_t index;  ///< of the scene in the sweep
  Outcome outcome;
  double seconds;     ///< wall time spent on it
};

struct SweepOptions {
  int threads = 0;    ///< 0: as many as the machine has
  int batch = lanes_at_most;  ///< impacts that advance together, 1 ... lanes
  static const int lanes_at_most;
};

/// Runs the scenes whose `todo` is set, those that share lattices together, on a thread pool. `batch_done` is called from one
/// thread at a time with all results of a batch. The outcomes do not depend on the options. Returns false if `stop` ended it;
/// batches that were running then are dropped.
bool run_sweep(const std::vector<Scene>& scenes, const std::vector<bool>& todo, const SweepOptions& options, const std::atomic<bool>& stop,
               const std::function<void(const std::vector<Result>&)>& batch_done);

/// Builds the lattices and places the launch of `which` scenes, and runs nothing. Throws SceneError for the first scene that cannot start.
void check_scenes(const std::vector<Scene>& scenes, const std::vector<bool>& which, const SweepOptions& options, const std::atomic<bool>& stop);

}  // namespace ricochet
