#include "script/sweep_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <unordered_set>

#include "script/sweep_report.hpp"

namespace ricochet {

SweepOptions options_of(const Session& session) {
  SweepOptions options;
  options.threads = session.options.threads;
  if (session.options.batch > 0) options.batch = session.options.batch;
  return options;
}

std::vector<std::string> hashes_of(const std::vector<Scene>& scenes) {
  std::vector<std::string> hashes;
  for (const Scene& scene : scenes) hashes.push_back(scene.hash());
  return hashes;
}

std::string use_text(const SweepUse& use) {
  return fmt::format("  {:.3g} s on {} thread{}, {:.2g} % of their time idle, {:.2g} % of the lanes' steps idle\n",
                     use.seconds, use.threads, use.threads == 1 ? "" : "s", 100 * use.idle_threads,
                     100 * use.idle_lanes);
}

namespace {

void warn_of_twins(Session& session, const std::string& name, const std::vector<std::string>& hashes) {
  const std::size_t once = std::unordered_set<std::string>(hashes.begin(), hashes.end()).size();
  if (once == hashes.size()) return;
  session.warn(
      fmt::format("{}: {} of {} scenes repeat another one exactly, so they are no samples of their own; does every "
                  "name of 'over' reach the scene, and at.sample as its seed?",
                  name, hashes.size() - once, hashes.size()));
}

}  // namespace

void check_steps(const Session& session, const std::vector<Scene>& scenes) {
  std::vector<bool> by_step(scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Integration& given = scenes[i].integration;
    const bool found_to_start = scenes[i].step_is_chosen();
    by_step[i] = !found_to_start && (i == 0 || !std::isnan(given.step) || !std::isnan(given.theta));
  }
  check_scenes(scenes, by_step, options_of(session), stop_requested);
}

bool run_rows(Session& session, RowStore& store, const SweepWork& work, SweepUse& use) {
  const std::vector<Scene>& scenes = work.scenes;
  std::vector<bool> todo(scenes.size());
  std::map<std::string, std::size_t> first;  // a scene that occurs twice runs once
  for (std::size_t i = 0; i < scenes.size(); ++i) todo[i] = !store.done()[i] && first.emplace(work.hashes[i], i).second;
  warn_of_twins(session, work.name, work.hashes);
  Progress progress(session, work.name, scenes.size(), store.count());
  const auto keep = [&](const std::vector<Result>& results) {
    std::vector<std::pair<std::size_t, Row>> batch;
    std::size_t failed = 0;
    for (const Result& result : results) {
      batch.emplace_back(result.index,
                         row_of(scenes[result.index], result.outcome, result.seconds, work.hashes[result.index]));
      failed += result.outcome.status != Status::finished;
    }
    const std::size_t before = store.count();
    store.add(batch);
    progress.add(store.count() - before, failed);
  };
  return run_chosen(scenes, todo, options_of(session), stop_requested, keep, printed(session, work.scene_name), &use);
}

}  // namespace ricochet
