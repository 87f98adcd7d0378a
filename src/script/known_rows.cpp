#include "script/known_rows.hpp"

#include <fmt/format.h>

#include <cstring>

#include "core/error.hpp"
#include "core/units.hpp"
#include "impact/outcome.hpp"
#include "script/session.hpp"

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

// The rows of a file. Throws FileError if it is damaged, or was written by another version or commit than this.
std::vector<Row> checked_rows(const fs::path& file) {
  const Provenance theirs = read_provenance(file);
  for (const auto& [name, value] : Session::made_by())
    if (const auto it = theirs.find(name); it == theirs.end() || it->second != value)
      throw FileError(
          fmt::format("{} was written by {} {}, and this is {}: rows of both would stand side by side; finish it by "
                      "that one, or run again with --force or another --out",
                      file.string(), name, it == theirs.end() ? "unknown" : it->second, value));
  return rows_of(file);
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }

// "beta 0.51 and 0.52": the first column in which rows of one scene differ; empty if none does but the time.
std::string difference(const Row& a, const Row& b) {
  for (std::size_t c = 0; c < a.outcomes.size(); ++c)
    if (!same_bits(a.outcomes[c], b.outcomes[c]))
      return fmt::format("{} {} and {}", Outcome::fields()[c].first.name, a.outcomes[c], b.outcomes[c]);
  for (const Member<Row>& member : Row::fields())
    if (const auto* text = std::get_if<std::string Row::*>(&member.place); text && a.*(*text) != b.*(*text))
      return fmt::format("{} '{}' and '{}'", member.field.name, a.*(*text), b.*(*text));
  return "";
}

// "out/s/shards/001.h5, written on node7"; `file`: none for a row that was computed here.
std::string named(const fs::path& file) {
  if (file.empty()) return "what was computed here";
  const Provenance theirs = read_provenance(file);
  const auto host = theirs.find("host");
  return file.string() + (host == theirs.end() ? "" : ", written on " + host->second);
}

}  // namespace

KnownRows::KnownRows(const std::vector<std::string>& hashes)
    : rows_(hashes.size()), done_(hashes.size(), false), origins_(hashes.size()) {
  for (std::size_t i = 0; i < hashes.size(); ++i) scenes_[hashes[i]].push_back(i);
}

bool KnownRows::accept(const Row& row, const fs::path& origin) {
  const auto scenes = scenes_.find(row.hash);
  if (scenes == scenes_.end()) return false;
  for (const std::size_t i : scenes->second) {
    if (done_[i]) {
      const std::string differs = difference(rows_[i], row);
      if (!differs.empty())
        throw FileError(fmt::format(
            "two rows of one scene ({}) differ: {}, in {}, and in {}; equal work gives equal bits, so one of these "
            "files was changed or one of these machines computes wrongly: remove the wrong file, and run that shard "
            "again",
            row.hash, differs, named(origins_[i]), named(origin)));
      continue;
    }
    ++count_;
    rows_[i] = row;
    done_[i] = true;
    origins_[i] = origin;
  }
  return true;
}

std::size_t KnownRows::load(const fs::path& file) {
  std::size_t strangers = 0;
  for (const Row& row : checked_rows(file)) strangers += !accept(row, file);
  return strangers;
}

std::vector<std::size_t> KnownRows::places() const {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (done_[i]) places.push_back(i);
  return places;
}

std::vector<const Row*> KnownRows::list() const {
  std::vector<const Row*> list;
  for (const std::size_t i : places()) list.push_back(&rows_[i]);
  return list;
}

}  // namespace ricochet
