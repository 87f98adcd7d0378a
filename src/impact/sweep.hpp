#pragma once
#include <atomic>
#include <functional>
#include <vector>

#include "impact/launch/start.hpp"
#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// One scene of a sweep and what came of it.
struct Result {
  std::size_t index;  ///< of the scene in the sweep
  Outcome outcome;
  double seconds;  ///< its share of the time of the thread that ran it
};

struct SweepOptions {
  int threads = 0;            ///< 0: as many as the machine has
  int batch = lanes_at_most;  ///< impacts that advance together, 1 ... lanes
  static const int lanes_at_most;
};

/// What a sweep made of the machine.
struct SweepUse {
  double seconds = 0;  ///< wall time
  int threads = 0;
  double idle_threads = 0;  ///< share of the threads' time without work
  double idle_lanes = 0;    ///< share of the lanes' steps without an impact
};

/// Runs the scenes whose `todo` is set. Those that share solids advance together in lanes; threads take such groups
/// in turn, and when none is left to begin with, help with the one that has most left. `some_done` is called from one
/// thread at a time with what has ended since. The outcomes do not depend on the options. Returns false if `stop` ended
/// it; impacts that were running then are dropped.
bool run_sweep(const std::vector<Scene>& scenes, const std::vector<bool>& todo, const SweepOptions& options,
               const std::atomic<bool>& stop, const std::function<void(const std::vector<Result>&)>& some_done,
               SweepUse* use = nullptr);

/// Calls `use(i, solids)` for `which` scenes with their solids, from several threads at once. Throws SceneError for
/// what it throws as FieldError, and for bodies that cannot be built.
void each_built(const std::vector<Scene>& scenes, const std::vector<bool>& which, const SweepOptions& options,
                const std::atomic<bool>& stop, const std::function<void(std::size_t, const Solids&)>& use);

/// Builds the solids and places the launch of `which` scenes, and runs nothing. Throws SceneError for the first scene
/// that cannot start.
void check_scenes(const std::vector<Scene>& scenes, const std::vector<bool>& which, const SweepOptions& options,
                  const std::atomic<bool>& stop);

}  // namespace ricochet
