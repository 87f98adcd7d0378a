#pragma once
// The rows of a long sweep as a script reads them: from the file of its results, as much as is asked for.

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "script/long_sweep.hpp"
#include "store/long_table.hpp"

namespace ricochet {

class LongRows {
 public:
  /// Of a sweep that has ended, whose results lie in their file, unless it was only checked.
  explicit LongRows(std::shared_ptr<const LongSweep> sweep);
  /// Of the results of an earlier run, one row for each of so many points. Throws FileError if they are not of these
  /// values, or of other scenes than `first`.
  LongRows(const std::filesystem::path& results, const std::vector<SweptAxis>& axes, std::size_t points,
           const Scene& first);

  /// A column at a point of the sweep; nullptr, or none, if no column of that kind has the name. Throws FileError.
  std::optional<double> number(std::size_t point, const std::string& column);
  const std::string* text(std::size_t point, const std::string& column);
  Row row(std::size_t point);

 private:
  void name_columns();
  std::optional<std::size_t> row_of_point(std::size_t point) const {
    return sweep_ ? sweep_->row_of_point(point) : std::optional<std::size_t>(point);
  }
  template <class Value>
  struct Block {
    std::size_t first = 0;
    std::vector<Value> values{};  ///< empty before the first is read
  };

  template <class Value>
  const Value* in_block(std::unordered_map<std::string, Block<Value>>& blocks, const std::string& column,
                        std::size_t row);

  std::shared_ptr<const LongSweep> sweep_;  ///< none of an earlier run's
  std::optional<StoredTable> table_;
  std::unordered_map<std::string, Block<double>> numbers_;
  std::unordered_map<std::string, Block<std::string>> texts_;
  std::string missing_text_;
};

}  // namespace ricochet
