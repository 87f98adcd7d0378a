#include "script/shard_merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "impact/outcome.hpp"
#include "script/shard_plan.hpp"
#include "script/shell.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// So many shards are told one by one.
constexpr std::size_t most_told = 10;

bool has_plan(const fs::path& folder) {
  std::error_code error;
  return fs::exists(run_names::plan(folder), error);
}

/// Of the points of a shard, how many have a row.
struct Tally {
  std::size_t points = 0, rows = 0;
};

std::map<std::size_t, Tally> unfinished(const ShardPlan& plan, const std::vector<bool>& done,
                                        const std::vector<std::size_t>& places) {
  std::map<std::size_t, Tally> shards;
  for (std::size_t i = 0; i < done.size(); ++i) {
    Tally& tally = shards[plan.shard_of(places.empty() ? i : places[i])];
    ++tally.points;
    tally.rows += done[i];
  }
  std::erase_if(shards, [](const auto& shard) { return shard.second.rows == shard.second.points; });
  return shards;
}

// "  2: 3 of 12 impacts; it ended with: error ..."
std::string line_of(const fs::path& folder, std::size_t shard, const Tally& tally) {
  std::error_code error;
  const fs::path ended = run_names::shard_error(folder, shard);
  const std::string rows = tally.rows == 0 ? "nothing" : fmt::format("{} impacts", tally.rows);
  return fmt::format("\n  shard {}: {} of {} stored{}", shard, rows, tally.points,
                     fs::exists(ended, error) ? "; it ended with: " + read_file(ended) : "");
}

}  // namespace

std::string command_of(const Session& session, const std::string& command, const std::string& options,
                       const std::string& program) {
  std::vector<std::string> words{program, command, session.script.string()};
  words.insert(words.end(), session.arguments.begin(), session.arguments.end());
  return fmt::format("{} {} --out {}", shell_words(words), options, shell_words(session.options.out));
}

std::optional<ShardPlan> plan_of_merge(Session& session, const std::string& sweep, std::size_t points) {
  const fs::path folder = session.folders.named(sweep);
  if (!has_plan(folder)) return std::nullopt;
  ShardPlan plan = read_plan(folder);
  refuse_other(plan, facts_of(session), folder);
  if (plan.points() != points)
    throw FileError(fmt::format("{} is of {} points, and the sweep has {}; give the same parameters as to the shards",
                                run_names::plan(folder).string(), plan.points(), points));
  return plan;
}

std::vector<Scene> with_planned_steps(Session& session, const std::string& sweep, const std::vector<Scene>& scenes,
                                      const Telling& telling) {
  const std::optional<ShardPlan> plan = plan_of_merge(session, sweep, scenes.size());
  if (!plan) return with_chosen_steps(session, scenes, telling);
  std::vector<Scene> planned;
  for (std::size_t i = 0; i < scenes.size(); ++i) planned.push_back(plan->with_step(scenes[i], i));
  return planned;
}

void refuse_missing(Session& session, const std::string& sweep, const std::vector<bool>& done,
                    const std::vector<std::size_t>& places) {
  const auto lacking = static_cast<std::size_t>(std::count(done.begin(), done.end(), false));
  if (lacking == 0) return;
  const fs::path folder = session.folders.named(sweep);
  if (!has_plan(folder))
    throw Error(fmt::format("no shard of '{}' has run; run them: {}", sweep, command_of(session, "run", "--shard K/N")),
                Exit::numerical);
  const ShardPlan plan = read_plan(folder);
  const std::map<std::size_t, Tally> missing = unfinished(plan, done, places);
  std::string text = fmt::format("{} of {} impacts of '{}' are missing, in {} of {} shards", lacking, done.size(),
                                 sweep, missing.size(), plan.shards);
  std::size_t told = 0;
  for (const auto& [shard, tally] : missing)
    if (++told <= most_told) text += line_of(folder, shard, tally);
  if (missing.size() > most_told) text += fmt::format("\n  and {} more", missing.size() - most_told);
  const std::string first = fmt::format("--shard {}/{}", missing.begin()->first, plan.shards);
  text += fmt::format("\n  run them: {}{}", command_of(session, "run", first), missing.size() > 1 ? ", and so on" : "");
  if (!session.options.partial)
    throw Error(text + (places.empty() ? "; or merge what is there with --partial" : ""), Exit::numerical);
  session.warn(text);
}

Row missing_row(const Scene& scene) {
  Row row = row_of(scene, Outcome{}, 0);
  row.status = "not_run";
  row.reason = "its shard is not there";
  return row;
}

std::vector<Row> with_missing(const RowStore& store, const std::vector<Scene>& scenes) {
  std::vector<Row> rows = store.rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (store.done()[i]) continue;
    rows[i] = missing_row(scenes[i]);
  }
  return rows;
}

std::vector<Row> merged_rows(Session& session, const std::string& sweep, const std::vector<std::string>& hashes) {
  KnownRows known(hashes);
  const fs::path folder = session.folders.named(sweep);
  for (const fs::path& file : run_names::merged(folder)) known.load(file);
  if (known.count() < hashes.size())
    throw FileError(
        fmt::format("{} holds {} of {} impacts of '{}', which the script runs before the sweep of this "
                    "shard; complete it first, or give another --out",
                    folder.string(), known.count(), hashes.size(), sweep));
  return known.rows();
}

}  // namespace ricochet
