#pragma once
// The rows of a sweep that are known, by the hash of their scene: those that came in and those that were stored.

#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "record/row.hpp"
#include "store/table.hpp"

namespace ricochet {

/// All columns of rows, in the units of the first.
Table table_of(const std::vector<const Row*>& rows);

class KnownRows {
 public:
  /// `hashes`: of the sweep's scenes, in its order.
  explicit KnownRows(const std::vector<std::string>& hashes);

  /// Fills in the row at every scene that it is of: rows of equal scenes are the same row. False if there is none.
  /// `origin`: the file that it was read from, empty if it was computed here. Throws FileError for a row that differs
  /// from one that is known: equal work gives equal bits.
  bool accept(const Row& row, const std::filesystem::path& origin = {});

  /// Takes up a file's rows; returns how many are of none of the scenes. Throws FileError if it is damaged or was
  /// written by another version or commit of the program, and as accept().
  std::size_t load(const std::filesystem::path& file);

  const std::vector<Row>& rows() const { return rows_; }  ///< in the order of the scenes
  const std::vector<bool>& done() const { return done_; }
  std::size_t count() const { return count_; }

  /// Those that are known, in the order of the scenes, and their places among them.
  std::vector<const Row*> list() const;
  std::vector<std::size_t> places() const;

 private:
  std::unordered_map<std::string, std::vector<std::size_t>> scenes_;  // by hash
  std::vector<Row> rows_;
  std::vector<bool> done_;
  std::vector<std::filesystem::path> origins_;
  std::size_t count_ = 0;
};

}  // namespace ricochet
