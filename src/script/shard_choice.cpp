#include "script/shard_choice.hpp"

#include <fmt/format.h>

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

/// What a process is told of itself: its number, of the first (0 unless named), and of how many, if that is told.
struct Launcher {
  const char* number;
  const char* first;
  const char* count;
};

constexpr Launcher launchers[] = {
    {"OMPI_COMM_WORLD_RANK", nullptr, "OMPI_COMM_WORLD_SIZE"},
    {"PMI_RANK", nullptr, "PMI_SIZE"},
    {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_COUNT"},
    {"SLURM_PROCID", nullptr, "SLURM_NTASKS"},
    {"PBS_ARRAY_INDEX", nullptr, nullptr},
    {"SGE_TASK_ID", "SGE_TASK_FIRST", nullptr},
};

constexpr const char* forms =
    "write --shard K/N, K from 0 to N - 1, or --shard auto in a job of Slurm, MPI, PBS or Grid Engine, or auto/N";

[[noreturn]] void refuse(const std::string& given, const std::string& why) {
  throw Error(fmt::format("--shard {}: {}; {}", given, why, forms), Exit::usage);
}

// With a count that was given, the number is meant as it is: an array of what is missing has gaps.
void choose_by_launcher(RunOptions& options, const std::string& given, Whole count) {
  for (const Launcher& launcher : launchers) {
    const Whole number = number_in_variable(launcher.number);
    if (!number) continue;
    const Whole total = count ? count : number_in_variable(launcher.count);
    if (!total)
      refuse(given, fmt::format("{} = {} tells which, but nothing tells of how many", launcher.number, *number));
    options.shard = *number - (count ? 0 : number_in_variable(launcher.first).value_or(0));
    options.shards = *total;
    return;
  }
  refuse(given,
         "no variable of a job tells which (OMPI_COMM_WORLD_RANK, PMI_RANK, SLURM_ARRAY_TASK_ID, SLURM_PROCID, "
         "PBS_ARRAY_INDEX, SGE_TASK_ID)");
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
