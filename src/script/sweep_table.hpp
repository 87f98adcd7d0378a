#pragma once
// What a table of results says of its columns and rows.

#include <map>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "store/table.hpp"

namespace ricochet::sweep_table {

/// What the columns of parameters are described by.
inline constexpr const char* parameter = "parameter of the sweep";

inline bool is_parameter(const Field& field) { return field.doc == parameter; }

/// A parameter that tells lattices of one kind from each other.
inline bool counts_samples(const std::string& name) {
  return name.ends_with("sample") || name.ends_with("seed") || name == "mirrored" || name == "pair";
}

inline bool has_finished(const Table& table, std::size_t row) {
  const TextColumn* status = table.text("status");
  return !status || status->values[row] == "finished";
}

/// A lattice of its own: the mean of a column over the rows of one that was struck from both sides, else a row's.
struct Unit {
  std::size_t row;  ///< the first of them
  double value;
};

/// Those of the finished rows in which the column is defined, in the order of the rows.
inline std::vector<Unit> units(const Table& table, const NumberColumn& column) {
  const NumberColumn* pair = table.number("pair");
  std::vector<Unit> list;
  std::vector<std::size_t> counts;
  std::map<double, std::size_t> place;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!has_finished(table, row) || column.values[row] != column.values[row]) continue;
    const auto [at, fresh] = place.emplace(pair ? pair->values[row] : -1.0 - static_cast<double>(row), list.size());
    if (fresh) {
      list.push_back({row, column.values[row]});
      counts.push_back(1);
    } else {
      Unit& unit = list[at->second];
      unit.value += (column.values[row] - unit.value) / static_cast<double>(++counts[at->second]);
    }
  }
  return list;
}

}  // namespace ricochet::sweep_table
