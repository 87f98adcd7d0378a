#pragma once
// The rows of a long sweep: they go to files as they come, and from there into the results, without ever being in
// memory together.

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "record/row.hpp"
#include "script/row_index.hpp"
#include "script/store_folder.hpp"
#include "script/swept_axis.hpp"

namespace ricochet {

class LongStore {
 public:
  /// `axes` outlive it.
  LongStore(Session& session, const std::string& name, const std::vector<SweptAxis>& axes)
      : folder_(session, name), axes_(axes) {}

  const StoreFolder& folder() const { return folder_; }
  const RowIndex& index() const { return index_; }

  /// Takes up what is stored. Throws FileError.
  void load();
  /// Keeps rows that came in, of these points; they survive a kill from the next part on.
  void add(std::vector<Row> rows, const std::vector<std::size_t>& points);
  /// Writes a part of what no file holds yet.
  void flush();
  /// The scenes that were made together are done: their rows become one file.
  void end_chunk();

  /// Columns that are asked for while the results are written, by name.
  using Columns = std::map<std::string, std::vector<double>>;
  /// What came of writing the results.
  struct Written {
    std::string digest;
    std::vector<bool> finished;  ///< [row]
    std::string first_failure;   ///< how and why the first that did not finish ended
  };
  /// The results, in every format: these rows, which are of these points of the sweep, in this order. `wanted` gets the
  /// columns whose names are in it. `whole`: they are all.
  Written write_results(const std::vector<RowPlace>& rows, const std::vector<std::size_t>& points, Columns& wanted,
                        bool whole);
  /// The file of a shard of these scenes, which are of these points, compared with what other processes of it left.
  /// Returns how many finished.
  std::size_t write_shard(const std::vector<HashKey>& scenes, const std::vector<std::size_t>& points);

 private:
  using Clock = std::chrono::steady_clock;

  void load(const std::vector<std::filesystem::path>& files);
  std::filesystem::path write_part(std::size_t first);
  template <class Results>
  Written write_columns(Results& results, const std::vector<RowPlace>& rows, const std::vector<std::size_t>& points,
                        Columns& wanted) const;

  StoreFolder folder_;
  const std::vector<SweptAxis>& axes_;
  RowIndex index_;
  std::vector<Row> chunk_;  ///< rows of the scenes that were made together
  std::vector<std::size_t> chunk_points_;
  std::size_t in_parts_ = 0;  ///< how many of them are in parts
  std::vector<std::filesystem::path> chunk_parts_;
  Clock::time_point flushed_ = Clock::now();
};

}  // namespace ricochet
