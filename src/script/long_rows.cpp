#include "script/long_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "impact/outcome.hpp"
#include "script/known_rows.hpp"

namespace ricochet {

namespace {

// Rows of a column that are read together.
constexpr std::size_t rows_a_block = 4096;

std::vector<double> values_of(const StoredTable& table, const std::string& column, std::size_t first, std::size_t count,
                              double) {
  return table.numbers(column, first, count);
}
std::vector<std::string> values_of(const StoredTable& table, const std::string& column, std::size_t first,
                                   std::size_t count, const std::string&) {
  return table.texts(column, first, count);
}

}  // namespace

void LongRows::name_columns() {
  const Table columns = table_of({});
  for (const NumberColumn& column : columns.numbers) numbers_[column.field.name];
  for (const TextColumn& column : columns.texts) texts_[column.field.name];
}

namespace {

bool holds(const std::vector<Field>& fields, const std::string& name) {
  return std::any_of(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
}

// True if the column of an axis has its values at all points.
bool has_values(const StoredTable& table, const SweptAxis& axis) {
  const std::string over = "over_" + axis.name;
  const auto equal = [&](const auto& column, const auto& values) {
    for (std::size_t point = 0; point < column.size(); ++point)
      if (column[point] != values[axis.at(point)]) return false;
    return true;
  };
  const std::vector<Field>& fields = axis.is_text() ? table.texts() : table.numbers();
  const std::string name = holds(fields, over) ? over : axis.name;
  if (!holds(fields, name)) return false;
  return axis.is_text() ? equal(table.texts(name), axis.texts) : equal(table.numbers(name), axis.numbers);
}

}  // namespace

LongRows::LongRows(const std::filesystem::path& results, const std::vector<SweptAxis>& axes, std::size_t points,
                   const Scene& first) {
  refuse_other_program(results);
  table_.emplace(results);
  refuse_missing_columns(results, table_->numbers(), table_->texts());
  // Which scene trials would choose a step for is not asked again.
  const bool chosen = !std::isnan(first.integration.accuracy);
  bool same = table_->rows() == points && (chosen || table_->texts("scene_hash", 0, 1).front() == first.hash());
  for (const SweptAxis& axis : axes) same = same && has_values(*table_, axis);
  if (!same)
    throw FileError(
        fmt::format("{} is not of the scenes of the sweep that the script runs before that of this shard; "
                    "run and merge that one first, or give another --out",
                    results.string()));
  name_columns();
}

LongRows::LongRows(std::shared_ptr<const LongSweep> sweep) : sweep_(std::move(sweep)) {
  name_columns();
  if (sweep_->has_results()) table_.emplace(sweep_->results(), true);
}

template <class Value>
const Value* LongRows::in_block(std::unordered_map<std::string, Block<Value>>& blocks, const std::string& column,
                                std::size_t row) {
  Block<Value>& block = blocks.at(column);
  if (row < block.first || row >= block.first + block.values.size()) {
    block.first = row / rows_a_block * rows_a_block;
    block.values =
        values_of(*table_, column, block.first, std::min(rows_a_block, table_->rows() - block.first), Value{});
  }
  return &block.values[row - block.first];
}

std::optional<double> LongRows::number(std::size_t point, const std::string& column) {
  if (!numbers_.contains(column)) return std::nullopt;
  if (const auto row = row_of_point(point)) return *in_block(numbers_, column, *row);
  const Row missing = sweep_->missing(point);
  return table_of({&missing}).number(column)->values.front();
}

const std::string* LongRows::text(std::size_t point, const std::string& column) {
  if (!texts_.contains(column)) return nullptr;
  if (const auto row = row_of_point(point)) return in_block(texts_, column, *row);
  const Row missing = sweep_->missing(point);
  missing_text_ = table_of({&missing}).text(column)->values.front();
  return &missing_text_;
}

Row LongRows::row(std::size_t point) {
  if (!row_of_point(point)) return sweep_->missing(point);
  Row row;
  for (const auto& [field, value] : Outcome::fields()) row.outcomes.push_back(*number(point, field.name));
  for (const Member<Row>& member : Row::fields())
    if (const auto* place = std::get_if<std::string Row::*>(&member.place))
      row.*(*place) = *text(point, member.field.name);
    else if (const auto* seconds = std::get_if<double Row::*>(&member.place))
      row.*(*seconds) = *number(point, member.field.name);
  return row;
}

}  // namespace ricochet
