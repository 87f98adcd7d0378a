#pragma once
// The rows of one shard of a sweep: no lock, no name that another process takes. What two processes of one shard leave
// is equal, and compared.

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "script/session.hpp"
#include "script/sweep_parameters.hpp"
#include "script/sweep_run.hpp"

namespace ricochet {

/// Calls take(files) with the files that `list` gives, anew as long as it fails with one that is gone by then: its
/// process has put all rows into another.
void while_they_change(const std::function<std::vector<std::filesystem::path>()>& list,
                       const std::function<void(const std::vector<std::filesystem::path>&)>& take);

/// Takes up the files that `list` gives, again as long as one is gone when it is to be read: its process has put all
/// rows into another by then. Throws FileError as KnownRows::load(). Returns how many rows are of no known scene.
std::size_t load_while_they_change(KnownRows& rows, const std::function<std::vector<std::filesystem::path>()>& list);

/// Gives what a process has written of all rows of a shard its name, after comparing it with the shard's other files,
/// which go. `all`: the files of the shard as they were compared.
void become_shard(const std::filesystem::path& own, const std::filesystem::path& folder, std::size_t shard,
                  const std::vector<std::filesystem::path>& all);

/// "12 of 40 impacts of shard 3/20 are stored in out/s; the same command goes on from there"
std::string shard_left_behind(const Session& session, std::size_t count, std::size_t all);

/// Written beside the rows of a shard.
Provenance origin_of_shard();

class ShardStore : public RowStore {
 public:
  /// Takes up what is stored of the shard, and what of an earlier sweep's results is its own.
  /// `parameters`: of the shard's points.
  ShardStore(Session& session, std::size_t shard, const std::vector<std::string>& hashes, const Parameters& parameters);

  /// Keeps rows in memory until enough time or enough of them have passed, then as a part.
  void add(const std::vector<std::pair<std::size_t, Row>>& batch) override;
  /// Writes what is still in memory.
  void flush();
  /// Leaves one file of all rows, compared with all others of this shard, which go.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void write(const std::filesystem::path& file, const std::vector<const Row*>& rows,
             const std::vector<std::size_t>& places) const;

  Session& session_;
  std::filesystem::path folder_;
  std::size_t shard_;
  const Parameters& parameters_;
  std::vector<std::pair<std::size_t, Row>> waiting_;
  Clock::time_point flushed_ = Clock::now();
};

}  // namespace ricochet
