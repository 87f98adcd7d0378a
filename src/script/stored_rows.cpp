#include "script/stored_rows.hpp"

#include <algorithm>
#include <unordered_set>

#include "script/known_rows.hpp"
#include "script/shard_store.hpp"
#include "script/sweep_table.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

/// Rows of several tables, each scene once. What a table does not have is undefined, or empty.
class Union {
 public:
  void add(const Table& table) {
    std::vector<std::size_t> fresh;
    const TextColumn* hash = table.text("scene_hash");
    for (std::size_t row = 0; hash && row < table.rows(); ++row)
      if (scenes_.insert(hash->values[row]).second) fresh.push_back(row);
    append(all_.numbers, table.numbers, fresh, not_given);
    append(all_.texts, table.texts, fresh, std::string());
    rows_ += fresh.size();
  }
  Table take() { return std::move(all_); }

 private:
  template <class Column, class Value>
  void append(std::vector<Column>& all, const std::vector<Column>& columns, const std::vector<std::size_t>& rows,
              const Value& nothing) const {
    for (const Column& column : columns) {
      const auto same = [&](const Column& other) { return other.field.name == column.field.name; };
      auto found = std::find_if(all.begin(), all.end(), same);
      if (found == all.end()) found = all.insert(all.end(), {column.field, {}});
      found->values.resize(rows_, nothing);
      for (const std::size_t row : rows) found->values.push_back(column.values[row]);
    }
    for (Column& column : all) column.values.resize(rows_ + rows.size(), nothing);
  }

  Table all_;
  std::size_t rows_ = 0;
  std::unordered_set<std::string> scenes_;
};

// As results have them: parameters, then the columns of a row in their order.
template <class Column>
void sort_columns(std::vector<Column>& columns, const std::vector<Column>& usual) {
  const auto place = [&](const Column& column) {
    if (sweep_table::is_parameter(column.field)) return std::ptrdiff_t{-1};
    return std::find_if(usual.begin(), usual.end(),
                        [&](const Column& other) { return other.field.name == column.field.name; }) -
           usual.begin();
  };
  std::stable_sort(columns.begin(), columns.end(),
                   [&](const Column& a, const Column& b) { return place(a) < place(b); });
}

}  // namespace

Table stored_rows(const fs::path& folder) {
  Union rows;
  // Each scene counts once, so files may be added again.
  while_they_change([&] { return run_names::all_stored(folder); },
                    [&](const std::vector<fs::path>& files) {
                      for (const fs::path& file : files) rows.add(read_table(file));
                    });
  Table all = rows.take();
  const Table usual = table_of({});
  sort_columns(all.numbers, usual.numbers);
  sort_columns(all.texts, usual.texts);
  return all;
}

}  // namespace ricochet
