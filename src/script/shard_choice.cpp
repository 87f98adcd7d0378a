#include "script/shard_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "core/error.hpp"

namespace ricochet {

namespace {

using Whole = std::optional<std::size_t>;

Whole whole_number_in(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? Whole(value) : std::nullopt;
}

Whole number_in_variable(const char* variable) {
  const char* text = variable ? std::getenv(variable) : nullptr;
  return text ? whole_number_in(text) : std::nullopt;
}

/// What a process is told of itself: its number, of the first, and of how many, if that is told.
struct Launcher {
  const char* number;
  std::size_t base;   ///< of the first, unless named
  const char* first;  ///< the variable of the first, if there is one
  const char* count;
};

/// Jobs of an array, and processes that are started together, maybe within one of them.
constexpr Launcher arrays[] = {
    {"SLURM_ARRAY_TASK_ID", 0, "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_COUNT"},
    {"PBS_ARRAY_INDEX", 0, nullptr, nullptr},
    {"SGE_TASK_ID", 1, nullptr, nullptr},
};
// The number of a job's tasks is told where one process alone runs, too: srun tells that of its own step.
constexpr Launcher ranks[] = {
    {"OMPI_COMM_WORLD_RANK", 0, nullptr, "OMPI_COMM_WORLD_SIZE"},
    {"PMI_RANK", 0, nullptr, "PMI_SIZE"},
    {"SLURM_PROCID", 0, nullptr, "SLURM_STEP_NUM_TASKS"},
};

constexpr const char* forms =
    "write --shard K/N, K from 0 to N - 1, or --shard auto in a job of Slurm, MPI, PBS or Grid Engine, or auto/N";

[[noreturn]] void refuse(const std::string& given, const std::string& why) {
  throw Error(fmt::format("--shard {}: {}; {}", given, why, forms), Exit::usage);
}

/// Which of how many, as one launcher tells.
struct Told {
  std::string by;
  std::size_t number = 0;
  Whole count;
};

std::optional<Told> told_by(const Launcher& launcher) {
  const Whole number = number_in_variable(launcher.number);
  if (!number) return std::nullopt;
  return Told{fmt::format("{} = {}", launcher.number, *number), *number - std::min(*number, launcher.base),
              number_in_variable(launcher.count)};
}

std::optional<Told> array_task(bool counted) {
  for (const Launcher& launcher : arrays)
    if (auto told = told_by(launcher)) {
      // With a count that was given, the number is meant as it is: an array of what is missing has gaps.
      if (!counted) told->number -= std::min(told->number, number_in_variable(launcher.first).value_or(0));
      return told;
    }
  return std::nullopt;
}

// The first that tells of several processes, else the first of one, else the first that does not tell of how many.
std::optional<Told> rank() {
  std::optional<Told> single, uncounted;
  for (const Launcher& launcher : ranks) {
    const auto told = told_by(launcher);
    if (told && told->count && *told->count > 1) return told;
    std::optional<Told>& kept = told && told->count ? single : uncounted;
    if (told && !kept) kept = told;
  }
  return single ? single : uncounted;
}

// Processes within a task of an array share its share.
void choose_by_launcher(RunOptions& options, const std::string& given, Whole count) {
  const auto task = array_task(count.has_value());
  auto process = rank();
  if (task && process && !process->count) process.reset();
  if (!task && !process)
    refuse(given,
           "no variable of a job tells which (OMPI_COMM_WORLD_RANK, PMI_RANK, SLURM_ARRAY_TASK_ID, SLURM_PROCID and "
           "SLURM_STEP_NUM_TASKS, PBS_ARRAY_INDEX, SGE_TASK_ID)");
  const auto& which = task ? task : process;
  if (!which->count && !count) refuse(given, fmt::format("{} tells which, but nothing tells of how many", which->by));
  const std::size_t processes = process ? process->count.value_or(1) : 1;
  options.shard = (task ? task->number * processes : 0) + (process ? process->number : 0);
  options.shards = count ? *count : (task ? *task->count : 1) * processes;
}

}  // namespace

void choose_shard(RunOptions& options, const std::string& given) {
  const std::size_t slash = given.find('/');
  const std::string first = given.substr(0, slash);
  const Whole count =
      slash == std::string::npos ? std::nullopt : whole_number_in(std::string_view(given).substr(slash + 1));
  if (slash != std::string::npos && !count) refuse(given, "this is no number of shards");
  if (first == "auto") {
    choose_by_launcher(options, given, count);
  } else {
    const Whole shard = whole_number_in(first);
    if (!shard || !count) refuse(given, "this names no shard");
    options.shard = *shard;
    options.shards = *count;
  }
  if (options.shard >= options.shards)
    refuse(given, fmt::format("there is no shard {} of {}", options.shard, options.shards));
  options.part = Part::shard;
}

}  // namespace ricochet
