#include "script/sweep_store.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "impact/outcome.hpp"
#include "script/sweep_table.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"
#include "store/sinks.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// A column of what `value` gives of each row: of numbers, or of texts.
template <class Value>
void add_column(Table& table, const Field& field, const std::vector<const Row*>& rows, Value value) {
  if constexpr (std::is_same_v<std::decay_t<decltype(value(*rows[0]))>, std::string>) {
    table.texts.push_back({field, {}});
    for (const Row* row : rows) table.texts.back().values.push_back(value(*row));
  } else {
    table.numbers.push_back({field, {}});
    for (const Row* row : rows) table.numbers.back().values.push_back(static_cast<double>(value(*row)));
  }
}

}  // namespace

Table table_of(const std::vector<const Row*>& rows) {
  Table table;
  const Units units = Units::named(rows.empty() ? "paper" : rows.front()->units);
  for (std::size_t c = 0; c < Outcome::fields().size(); ++c) {
    Field field = Outcome::fields()[c].first;
    field.unit = units.name(field.unit);
    add_column(table, field, rows, [c](const Row& row) { return row.outcomes[c]; });
  }
  for (const Member<Row>& member : Row::fields())
    std::visit([&](auto place) { add_column(table, member.field, rows, [=](const Row& row) { return row.*place; }); },
               member.place);
  return table;
}

namespace {

// The column of that name in a table that was read.
template <class Column>
const Column& needed(const Column* column, const std::string& name, const fs::path& path) {
  if (!column)
    throw FileError(
        fmt::format("{} has no column '{}' (written by another version?); run again with --force or another --out",
                    path.string(), name));
  return *column;
}

void read_column(const Table& table, const std::string& name, const fs::path& path, std::vector<Row>& rows,
                 double Row::*place) {
  const NumberColumn& column = needed(table.number(name), name, path);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*place = column.values[i];
}

void read_column(const Table& table, const std::string& name, const fs::path& path, std::vector<Row>& rows,
                 std::string Row::*place) {
  const TextColumn& column = needed(table.text(name), name, path);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*place = column.values[i];
}

std::vector<Row> rows_of(const fs::path& path) {
  const Table table = read_table(path);
  std::vector<Row> rows(table.rows());
  for (const auto& [field, value] : Outcome::fields()) {
    const NumberColumn& column = needed(table.number(field.name), field.name, path);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].outcomes.push_back(column.values[i]);
  }
  for (const Member<Row>& member : Row::fields())
    std::visit(
        [&](auto place) {
          if constexpr (requires { read_column(table, member.field.name, path, rows, place); })
            read_column(table, member.field.name, path, rows, place);
        },
        member.place);
  return rows;
}

}  // namespace

std::string Parameters::place(std::size_t scene) const {
  std::string text;
  for (std::size_t p = 0; p < names.size(); ++p)
    text += fmt::format("{}{} = {}", p ? ", " : "", names[p],
                        texts[p].empty() ? fmt::format("{:g}", numbers[p][scene]) : "'" + texts[p][scene] + "'");
  return text;
}

Store::Store(Session& session, const std::string& name, const std::vector<std::string>& hashes,
             const Parameters& parameters, const Earlier& earlier)
    : session_(session),
      folder_(session.folders.named(name)),
      parts_(run_names::parts(folder_)),
      hashes_(hashes),
      parameters_(parameters),
      rows_(hashes.size()),
      done_(hashes.size(), false) {
  for (std::size_t i = 0; i < hashes_.size(); ++i) scenes_[hashes_[i]].push_back(i);
  session.folders.claim(folder_);
  std::error_code error;
  if (session.options.force || (session.options.resume && fs::exists(run_names::new_parts(folder_), error)))
    parts_ = run_names::new_parts(folder_);
  if (earlier.taken) load(earlier.strangers);
}

void Store::add(const std::vector<std::pair<std::size_t, Row>>& batch) {
  std::vector<const Row*> rows;
  std::string key;
  for (const auto& [index, row] : batch) {
    rows.push_back(&row);
    key += row.hash;
  }
  if (session_.options.force && count_ == 0) run_names::remove_parts(parts_);  // of another try
  make_folder(parts_);
  write_table(run_names::part(parts_, hash_text(key)), table_of(rows), session_.made_by());
  for (const auto& [index, row] : batch) accept(row);
}

bool Store::replaces() const {
  std::error_code error;
  return parts_ == run_names::new_parts(folder_) && fs::exists(run_names::readable_results(folder_), error);
}

void Store::stop_early() {
  if (!replaces()) assemble();
}

std::string Store::left_behind() const {
  return fmt::format("{} of {} impacts are stored in {}; {}--resume goes on from there{}", count_, rows_.size(),
                     folder_.string(), session_.options.fresh ? "--new " : "",
                     replaces() ? ", and the earlier results stay until all are there" : "");
}

void Store::assemble() {
  std::vector<const Row*> rows;
  std::vector<std::size_t> scenes;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (done_[i]) {
      rows.push_back(&rows_[i]);
      scenes.push_back(i);
    }
  Table table = table_of(rows);
  for (std::size_t p = parameters_.names.size(); p-- > 0;) add_parameter(table, p, scenes);
  write_everywhere(run_names::results(folder_), table, session_.provenance());
  for (const fs::path& parts : {run_names::parts(folder_), run_names::new_parts(folder_)})
    run_names::remove_parts(parts);
  session_.folders.results_are_whole(folder_);
}

void Store::add_parameter(Table& table, std::size_t p, const std::vector<std::size_t>& scenes) const {
  const std::string& name = parameters_.names[p];
  // An outcome of the same name is what the impact had; the parameter is what the sweep asked for: keep both.
  const Field field{table.number(name) || table.text(name) ? "over_" + name : name, "number", parameters_.units[p],
                    sweep_table::parameter};
  if (!parameters_.texts[p].empty()) {
    table.texts.insert(table.texts.begin(), {field, {}});
    for (const std::size_t i : scenes) table.texts.front().values.push_back(parameters_.texts[p][i]);
  } else {
    table.numbers.insert(table.numbers.begin(), {field, {}});
    for (const std::size_t i : scenes) table.numbers.front().values.push_back(parameters_.numbers[p][i]);
  }
}

bool Store::accept(const Row& row) {
  const auto scenes = scenes_.find(row.hash);
  if (scenes == scenes_.end()) return false;
  for (const std::size_t i : scenes->second) {
    count_ += !done_[i];
    rows_[i] = row;
    done_[i] = true;
  }
  return true;
}

void Store::load(bool strangers_too) {
  std::size_t strangers = 0;
  for (const fs::path& file : run_names::stored(folder_)) {
    const Provenance theirs = read_provenance(file);
    for (const auto& [name, value] : session_.made_by())
      if (const auto it = theirs.find(name); it == theirs.end() || it->second != value)
        throw FileError(
            fmt::format("{} was written by {} {}, and this is {}: rows of both would stand side by side; finish it by "
                        "that one, or run again with --force or another --out",
                        file.string(), name, it == theirs.end() ? "unknown" : it->second, value));
    for (const Row& row : rows_of(file)) strangers += !accept(row);
  }
  if (strangers > 0 && !strangers_too)
    throw FileError(fmt::format(
        "{} holds {} rows of other scenes than this sweep's, which --resume would lose; use the same parameters (and "
        "the same scenes where accuracy chooses the step: trials of them chose it), --force, or another --out",
        folder_.string(), strangers));
}

}  // namespace ricochet
