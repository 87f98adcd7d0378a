#pragma once
// Shards as an array of jobs of Slurm, and their merging as a job that waits for it.

#include <map>
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
  int round = 0;                    ///< how often lost shards were submitted again without being asked ...
  std::string of;                   ///< ... of this work, by its merging job; empty: a user submits
};

/// Writes the scripts for those shards of a planned sweep that are not there and for their merging, and submits them
/// unless it is a dry run.
/// Throws Error.
void submit_shards(Session& session, const QueueOptions& wanted);

/// The numbers of the jobs that were submitted last for a sweep's folder, "12,13"; empty if none were.
std::string submitted_jobs(const std::filesystem::path& folder);

/// What the queue tells of jobs.
struct QueueStates {
  std::map<std::string, int> tasks;  ///< how many, by state: "running"; none if it knows of none (any more)
  std::string trouble;               ///< why it does not tell; else empty

  std::string text() const;  ///< "5 pending, 2 running"
};

/// Of those jobs.
QueueStates states_of(const std::string& list);

}  // namespace ricochet
