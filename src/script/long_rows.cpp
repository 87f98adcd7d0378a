#include "script/long_rows.hpp"

#include <algorithm>

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

LongRows::LongRows(std::shared_ptr<const LongSweep> sweep) : sweep_(std::move(sweep)) {
  const Table columns = table_of({});
  for (const NumberColumn& column : columns.numbers) numbers_[column.field.name];
  for (const TextColumn& column : columns.texts) texts_[column.field.name];
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
  if (const auto row = sweep_->row_of_point(point)) return *in_block(numbers_, column, *row);
  const Row missing = sweep_->missing(point);
  return table_of({&missing}).number(column)->values.front();
}

const std::string* LongRows::text(std::size_t point, const std::string& column) {
  if (!texts_.contains(column)) return nullptr;
  if (const auto row = sweep_->row_of_point(point)) return in_block(texts_, column, *row);
  const Row missing = sweep_->missing(point);
  missing_text_ = table_of({&missing}).text(column)->values.front();
  return &missing_text_;
}

Row LongRows::row(std::size_t point) {
  if (!sweep_->row_of_point(point)) return sweep_->missing(point);
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
