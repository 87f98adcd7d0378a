#include "script/shard_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/error.hpp"
#include "script/shard_plan.hpp"
#include "script/slurm.hpp"
#include "script/stored_rows.hpp"
#include "script/sweep_table.hpp"
#include "script/terminal.hpp"
#include "store/csv.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// So many errors of shards are told.
constexpr std::size_t most_errors_told = 5;

/// What files of rows hold.
struct Stored {
  std::set<std::string> scenes;
  std::size_t failed = 0;
  double seconds = 0;

  // A file that is gone when it is to be read is another one's part by now.
  void add(const fs::path& file) {
    Table table;
    try {
      table = read_table(file);
    } catch (const FileError&) {
      std::error_code error;
      if (fs::exists(file, error)) throw;
      return;
    }
    const TextColumn* hash = table.text("scene_hash");
    const NumberColumn* wall = table.number("wall_seconds");
    for (std::size_t row = 0; hash && wall && row < table.rows(); ++row) {
      if (!scenes.insert(hash->values[row]).second) continue;
      failed += !sweep_table::has_finished(table, row);
      seconds += wall->values[row];
    }
  }
};

Stored stored_in(const std::vector<fs::path>& files) {
  Stored stored;
  for (const fs::path& file : files) stored.add(file);
  return stored;
}

std::string shards_listed(const std::vector<std::size_t>& shards) {
  if (shards.empty()) return "";
  const std::vector<std::size_t> first(shards.begin(),
                                       shards.begin() + static_cast<long>(std::min<std::size_t>(shards.size(), 10)));
  return fmt::format(" ({}{})", fmt::join(first, ", "), shards.size() > first.size() ? " ..." : "");
}

/// Shards by how far they are.
struct Standing {
  std::vector<std::size_t> done, begun, failed, untouched;
};

Standing standing_of(const fs::path& folder, const ShardPlan& plan) {
  Standing standing;
  const std::set<std::string> names = run_names::shard_names(folder);
  for (std::size_t k = 0; k < plan.shards; ++k) {
    const std::string whole = run_names::shard(folder, k).filename(), stem = run_names::shard(folder, k).stem();
    const auto part = names.lower_bound(stem + "-");
    if (names.contains(whole))
      standing.done.push_back(k);
    else if (names.contains(run_names::shard_error(folder, k).filename()))
      standing.failed.push_back(k);
    else if (part != names.end() && part->starts_with(stem + "-"))
      standing.begun.push_back(k);
    else
      standing.untouched.push_back(k);
  }
  return standing;
}

// Of the queue: what is at work, and how long it may take.
void print_queue(const fs::path& folder, const Stored& stored, std::size_t points) {
  const std::string list = submitted_jobs(folder);
  if (list.empty()) return;
  const QueueStates states = states_of(list);
  putf("  jobs {}: {}\n", list,
       !states.trouble.empty() ? "the queue does not tell: " + states.trouble
       : states.tasks.empty()  ? "none of them is in the queue (any more)"
                               : states.text());
  const auto found = states.tasks.find("running");
  if (found == states.tasks.end() || stored.scenes.empty()) return;
  const int running = found->second;
  const double each = stored.seconds / static_cast<double>(stored.scenes.size());
  const double left = each * static_cast<double>(points - std::min(points, stored.scenes.size())) / running;
  putf("  about {:.3g} min left, if {} tasks stay at work with a thread each\n", left / 60, running);
}

void print_shards(const fs::path& folder) {
  const ShardPlan plan = read_plan(folder);
  std::error_code error;
  // Rows of a larger error, which a round goes on from, are not all of this plan's: what is, stands in its shards, too.
  const bool goes_on = fs::exists(run_names::earlier(folder), error);
  const Stored stored = stored_in(goes_on ? run_names::shard_files(folder) : run_names::all_stored(folder));
  const Standing standing = standing_of(folder, plan);
  putf(
      "{}: {} of {} impacts are stored, {} of them failed; {} shards: {} done, {} begun{}, {} ended with an error{}, "
      "{} not begun{}\n",
      folder.filename().string(), stored.scenes.size(), plan.impacts(), stored.failed, plan.shards,
      standing.done.size(), standing.begun.size(), shards_listed(standing.begun), standing.failed.size(),
      shards_listed(standing.failed), standing.untouched.size(), shards_listed(standing.untouched));
  for (std::size_t i = 0; i < std::min(most_errors_told, standing.failed.size()); ++i)
    putf("  shard {} ended with: {}\n", standing.failed[i],
         read_file(run_names::shard_error(folder, standing.failed[i])));
  print_queue(folder, stored, plan.impacts());
}

bool is_sweep(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder, error) && run_names::holds_results(folder);
}

void print_sweep(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(run_names::plan(folder), error)) return print_shards(folder);
  const Stored stored = stored_in(run_names::stored(folder));
  putf("{}: {} impacts are stored, {} of them failed; {}\n", folder.filename().string(), stored.scenes.size(),
       stored.failed,
       run_names::holds_parts(folder) ? "a run is at work, or was cut off: --resume goes on"
                                      : "no run is at work or was cut off");
}

// A folder itself, or those right below it.
std::vector<fs::path> sweeps_in(const std::string& given) {
  const fs::path folder = fs::path(given).lexically_normal();
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw FileError(fmt::format("there is no folder {}", folder.string()));
  std::vector<fs::path> sweeps;
  if (is_sweep(folder)) sweeps.push_back(folder);
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_sweep(entry.path())) sweeps.push_back(entry.path());
  if (sweeps.empty())
    throw FileError(fmt::format("{} holds no sweep; give the folder that --out named, or one below", folder.string()));
  std::sort(sweeps.begin(), sweeps.end());
  return sweeps;
}

}  // namespace

void print_status(const std::string& given) {
  for (const fs::path& sweep : sweeps_in(given)) print_sweep(sweep);
}

void print_stored(const std::string& given) {
  const std::vector<fs::path> sweeps = sweeps_in(given);
  if (sweeps.size() > 1) {
    std::vector<std::string> names;
    for (const fs::path& sweep : sweeps) names.push_back(sweep.string());
    throw FileError(fmt::format("{} holds {} sweeps: name one of {}", given, sweeps.size(), fmt::join(names, ", ")));
  }
  put(csv(stored_rows(sweeps.front())));
}

}  // namespace ricochet
