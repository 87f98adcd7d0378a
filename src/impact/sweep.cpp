#include "impact/sweep.hpp"

#include <map>
#include <mutex>

#include "core/error.hpp"
#include "force/lane.hpp"
#include "impact/batch.hpp"
#include "impact/launch.hpp"
#include "impact/parallel.hpp"

namespace ricochet {

const int SweepOptions::lanes_at_most = lanes;

namespace {

// A batch holds at most this many lanes' worth of scenes: enough to refill lanes, few enough to lose little to an interruption.
constexpr std::size_t rounds_in_a_batch = 4;

/// Lattices of one group, built by the first batch that needs them and dropped after the last.
struct Group {
  std::vector<std::size_t> scenes;
  std::once_flag built;
  std::shared_ptr<const Lattice> projectile, target;
  std::atomic<std::size_t> batches_left = 0;
};

struct Batch {
  Group* group;
  std::vector<std::size_t> scenes;
};

std::vector<std::unique_ptr<Group>> groups_of(const std::vector<Scene>& scenes, const std::vector<bool>& todo) {
  std::vector<std::unique_ptr<Group>> groups;
  std::map<std::string, Group*> by_key;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (!todo[i]) continue;
    Group*& group = by_key[scenes[i].group()];
    if (!group) groups.push_back(std::make_unique<Group>()), group = groups.back().get();
    group->scenes.push_back(i);
  }
  return groups;
}

void build(Group& group, const std::vector<Scene>& scenes) {
  std::call_once(group.built, [&] {
    const Scene& scene = scenes[group.scenes.front()];
    group.projectile = build_lattice(*scene.projectile);
    group.target = build_lattice(*scene.target);
  });
}

}  // namespace

bool run_sweep(const std::vector<Scene>& scenes, const std::vector<bool>& todo, const SweepOptions& options, const std::atomic<bool>& stop,
               const std::function<void(const std::vector<Result>&)>& batch_done) {
  auto groups = groups_of(scenes, todo);
  const std::size_t size = options.batch == 1 ? 1 : rounds_in_a_batch * static_cast<std::size_t>(options.batch);
  std::vector<Batch> batches;
  for (auto& group : groups)
    for (std::size_t first = 0; first < group->scenes.size(); first += size) {
      const auto begin = group->scenes.begin() + static_cast<std::ptrdiff_t>(first);
      batches.push_back({group.get(), {begin, begin + static_cast<std::ptrdiff_t>(std::min(size, group->scenes.size() - first))}});
      ++group->batches_left;
    }
  std::mutex done;
  in_parallel(batches, options.threads, [&](Batch& batch) {
    if (stop) return;
    build(*batch.group, scenes);
    std::vector<Scene> run;
    for (const std::size_t i : batch.scenes) run.push_back(scenes[i]);
    std::vector<Result> results;
    bool whole = false;
    try {
      whole = run_batch(*batch.group->projectile, *batch.group->target, run, options.batch, stop,
                        [&](std::size_t i, const Outcome& outcome, double seconds) { results.push_back({batch.scenes[i], outcome, seconds}); });
    } catch (const SceneError& error) {
      throw SceneError(error, batch.scenes[error.scene]);
    }
    if (--batch.group->batches_left == 0) batch.group->projectile.reset(), batch.group->target.reset();
    if (!whole && results.empty()) return;  // stopped: keep what had finished
    const std::lock_guard lock(done);
    batch_done(results);
  });
  return !stop;
}

void check_scenes(const std::vector<Scene>& scenes, const std::vector<bool>& which, const SweepOptions& options, const std::atomic<bool>& stop) {
  auto groups = groups_of(scenes, which);
  in_parallel(groups, options.threads, [&](std::unique_ptr<Group>& group) {
    if (stop) return;
    build(*group, scenes);
    for (const std::size_t i : group->scenes) try {
        launch(scenes[i], *group->projectile, *group->target);
      } catch (const FieldError& error) {
        throw SceneError(error, i);
      }
    group->projectile.reset(), group->target.reset();
  });
}

}  // namespace ricochet
