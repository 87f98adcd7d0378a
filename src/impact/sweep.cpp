#include "impact/sweep.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>

#include "core/error.hpp"
#include "core/lane.hpp"
#include "impact/batch.hpp"
#include "impact/parallel.hpp"

namespace ricochet {

const int SweepOptions::lanes_at_most = lanes;

namespace {

// Results are handed over when so many have ended, or so much time has passed: seldom enough to cost nothing, often
// enough to lose little.
constexpr std::size_t most_kept = 16;
constexpr double longest_kept = 1;  // [s]

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

/// Scenes that share solids. The solids are built by the first thread that comes and dropped by the last that
/// leaves.
struct Group {
  explicit Group(std::vector<std::size_t> of) : scenes(of), queue(std::move(of)) {}
  std::vector<std::size_t> scenes;
  Queue queue;
  std::once_flag built;
  BuiltSolids solids;
  int threads = 0;  ///< at work on it
};

std::vector<std::unique_ptr<Group>> groups_of(const std::vector<Scene>& scenes, const std::vector<bool>& todo) {
  std::vector<std::vector<std::size_t>> members;
  std::map<std::string, std::size_t> by_key;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (!todo[i]) continue;
    const auto [at, is_new] = by_key.try_emplace(scenes[i].group(), members.size());
    if (is_new) members.emplace_back();
    members[at->second].push_back(i);
  }
  // The longest first, as far as sizes tell: the last one to end should be a short one.
  const auto duration = [&](const std::vector<std::size_t>& of) {
    const Scene& scene = scenes[of.front()];
    return static_cast<double>(of.size()) *
           std::pow(scene.projectile->moving_nodes() + scene.target->moving_nodes(), 1.5);
  };
  std::stable_sort(members.begin(), members.end(),
                   [&](const auto& a, const auto& b) { return duration(a) > duration(b); });
  std::vector<std::unique_ptr<Group>> groups;
  for (auto& of : members) groups.push_back(std::make_unique<Group>(std::move(of)));
  return groups;
}

void build(Group& group, const std::vector<Scene>& scenes) {
  std::call_once(group.built, [&] {
    const std::size_t first = group.scenes.front();
    try {
      group.solids = BuiltSolids(scenes[first]);
    } catch (const FieldError& error) {
      throw SceneError(error, first);
    }
  });
}

/// Tells threads what to work on.
class Schedule {
 public:
  explicit Schedule(std::vector<std::unique_ptr<Group>> groups) : groups_(std::move(groups)) {}

  /// A group to work on, until `leave`; nullptr if nothing is left to take.
  Group* join() {
    const std::lock_guard lock(mutex_);
    Group* group = nullptr;
    if (begun_ < groups_.size())
      group = groups_[begun_++].get();
    else
      for (auto& other : groups_)
        if (other->queue.left() > (group ? group->queue.left() : 0)) group = other.get();
    if (group) ++group->threads;
    return group;
  }
  void leave(Group& group) {
    const std::lock_guard lock(mutex_);
    if (--group.threads == 0 && group.queue.left() == 0) {
      group.solids = BuiltSolids();
    }
  }
  /// Nothing more is begun.
  void close() {
    const std::lock_guard lock(mutex_);
    begun_ = groups_.size();
    for (auto& group : groups_) group->queue.close();
  }

 private:
  std::vector<std::unique_ptr<Group>> groups_;
  std::mutex mutex_;
  std::size_t begun_ = 0;
};

}  // namespace

bool run_sweep(const std::vector<Scene>& scenes, const std::vector<bool>& todo, const SweepOptions& options,
               const std::atomic<bool>& stop, const std::function<void(const std::vector<Result>&)>& some_done,
               SweepUse* use) {
  Schedule schedule(groups_of(scenes, todo));
  std::mutex done;
  LaneUse lane_use;
  double worked = 0;
  const auto began = Clock::now();
  std::vector<int> threads(threads_of(options.threads));
  // Few scenes are spread over the threads rather than over the lanes of one, and fewer yet take several threads each.
  const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(std::count(todo.begin(), todo.end(), true)));
  const std::size_t scenes_a_thread = (count + threads.size() - 1) / threads.size();
  const int width = static_cast<int>(std::min(static_cast<std::size_t>(options.batch), scenes_a_thread));
  const int threads_a_scene = static_cast<int>(std::max<std::size_t>(1, threads.size() / count));
  in_parallel(threads, options.threads, [&](int) {
    const auto thread_began = Clock::now();
    LaneUse own_use;
    std::vector<Result> results;
    auto handed_over = thread_began;
    const auto hand_over = [&] {
      if (results.empty()) return;
      const std::lock_guard lock(done);
      some_done(results);
      results.clear();
      handed_over = Clock::now();
    };
    try {
      while (Group* group = stop ? nullptr : schedule.join()) {
        build(*group, scenes);
        run_queue(
            group->solids, scenes, group->queue, width, threads_a_scene, stop,
            [&](std::size_t i, const Outcome& outcome, double seconds) {
              results.push_back({i, outcome, seconds});
              if (results.size() >= most_kept || seconds_since(handed_over) > longest_kept) hand_over();
            },
            own_use);
        schedule.leave(*group);
      }
      hand_over();
    } catch (const SceneError&) {
      schedule.close();
      hand_over();
      throw;
    } catch (...) {
      schedule.close();
      throw;
    }
    const std::lock_guard lock(done);
    worked += seconds_since(thread_began) * (own_use.steps > 0 ? threads_a_scene : 1);
    lane_use.steps += own_use.steps;
    lane_use.busy += own_use.busy;
  });
  if (use) {
    use->seconds = seconds_since(began);
    use->threads = static_cast<int>(threads.size());
    use->idle_threads = std::max(0.0, 1 - worked / (use->seconds * use->threads));
    use->idle_lanes =
        lane_use.steps > 0 ? 1 - static_cast<double>(lane_use.busy) / static_cast<double>(lane_use.steps) : 0;
  }
  return !stop;
}

void each_built(const std::vector<Scene>& scenes, const std::vector<bool>& which, const SweepOptions& options,
                const std::atomic<bool>& stop, const std::function<void(std::size_t, const Solids&)>& use) {
  auto groups = groups_of(scenes, which);
  in_parallel(groups, options.threads, [&](std::unique_ptr<Group>& group) {
    if (stop) return;
    build(*group, scenes);
    for (const std::size_t i : group->scenes) try {
        use(i, group->solids);
      } catch (const FieldError& error) {
        throw SceneError(error, i);
      }
    group->solids = BuiltSolids();
  });
}

void check_scenes(const std::vector<Scene>& scenes, const std::vector<bool>& which, const SweepOptions& options,
                  const std::atomic<bool>& stop) {
  each_built(scenes, which, options, stop,
             [&](std::size_t i, const Solids& solids) { check_start(solids, scenes[i]); });
}

}  // namespace ricochet
