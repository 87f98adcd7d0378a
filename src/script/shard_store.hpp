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

/// Takes up the files that `list` gives, again as long as one is gone when it is to be read: its process has put all
/// rows into another by then. Throws FileError as KnownRows::load(). Returns how many rows are of no known scene.
std::size_t load_while_they_change(KnownRows& rows, const std::function<std::vector<std::filesystem::path>()>& list);

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

  std::vector<std::filesystem::path> files() const;

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
