#pragma once
#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "impact/launch/start.hpp"
#include "impact/outcome.hpp"
#include "impact/scene.hpp"
#include "impact/snapshot.hpp"

namespace ricochet {

/// The solids of a scene, built from its bodies, or kept from scenes before.
class BuiltSolids {
 public:
  BuiltSolids() = default;
  /// Throws FieldError if one cannot be built.
  explicit BuiltSolids(const Scene& scene);
  explicit BuiltSolids(std::vector<std::shared_ptr<const Solid>> solids) : solids_(std::move(solids)) {}
  operator Solids() const;
  const Solid& operator[](std::size_t body) const { return *solids_[body]; }
  bool empty() const { return solids_.empty(); }

 private:
  std::vector<std::shared_ptr<const Solid>> solids_;
};

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
/// `threads` share one impact that runs alone, where its bodies are large; the bits are the same.
bool run_queue(const Solids& solids, const std::vector<Scene>& scenes, Queue& queue, int width, int threads,
               const std::atomic<bool>& stop, const Finished& finished, LaneUse& use);

/// Runs one scene alone, watched, on so many threads (0: as many as the machine has).
Outcome run_scene(const Solids& solids, const Scene& scene, const std::atomic<bool>& stop,
                  const Observer* observer = nullptr, int threads = 1);

/// Throws FieldError if the scene cannot start.
void check_start(const Solids& solids, const Scene& scene);

/// Test hook: runs a scene alone up to `time` and returns the state there, whatever happens in between.
Snapshot run_until(const Solids& solids, const Scene& scene, double time);

}  // namespace ricochet
