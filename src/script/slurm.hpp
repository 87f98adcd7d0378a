#pragma once
// Shards as an array of jobs of Slurm, and their merging as a job that waits for it.

#include <string>
#include <vector>

#include "script/session.hpp"

namespace ricochet {

struct QueueOptions {
  bool slurm = false, dry_run = false;
  std::string time, partition;      ///< of Slurm; empty: as the site has it
  int cpus = 1;                     ///< threads of each shard
  int running = 0;                  ///< tasks at a time, at most; 0: as many as there is room for
  int warning = 120;                ///< seconds before the end of a task's time in which it stores and is queued again
  std::vector<std::string> sbatch;  ///< further options
  int round = 0;                    ///< how often lost shards were submitted again without being asked
};

/// Writes the scripts for those shards of a planned sweep that are not there, and submits them unless it is a dry run.
/// Throws Error.
void submit_shards(Session& session, const QueueOptions& wanted);

/// The number of the array that was submitted for a sweep's folder; empty if none was.
std::string submitted_array(const std::filesystem::path& folder);

/// Its tasks by state: "2 running, 5 pending"; empty if the queue knows of none (any more), or there is no Slurm here.
std::string states_of(const std::string& array);

}  // namespace ricochet
