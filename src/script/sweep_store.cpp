#include "script/sweep_store.hpp"

#include <fmt/format.h>

#include "core/hash.hpp"
#include "store/files.hpp"
#include "store/table.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

const Field status_field{
    "status", "string", "",
    "how it ended: finished, energy_drift, not_finite, unstable, tunnelled, no_contact, out_of_time"};
const Field reason_field{"reason", "string", "", "a sentence, if it did not finish"};
const Field hash_field{"scene_hash", "string", "", "hash of the scene's canonical text"};
const Field seed_field{"seed", "string", "", "seed of the projectile"};
const Field seconds_field{"wall_seconds", "number", "s",
                          "its share of the time of the thread that ran it; impacts in lanes share it evenly"};

Table table_of(const std::vector<const Row*>& rows) {
  Table table;
  for (std::size_t c = 0; c < Outcome::fields().size(); ++c) {
    table.numbers.push_back({Outcome::fields()[c].first, {}});
    for (const Row* row : rows) table.numbers.back().values.push_back(row->values[c]);
  }
  table.numbers.push_back({seconds_field, {}});
  for (const Row* row : rows) table.numbers.back().values.push_back(row->seconds);
  const auto text = [&](const Field& field, std::string Row::*member) {
    table.texts.push_back({field, {}});
    for (const Row* row : rows) table.texts.back().values.push_back(row->*member);
  };
  text(status_field, &Row::status);
  text(reason_field, &Row::reason);
  text(hash_field, &Row::hash);
  text(seed_field, &Row::seed);
  return table;
}

std::vector<Row> rows_of(const fs::path& path) {
  const Table table = read_table(path);
  const auto need = [&](const auto* column, const std::string& name) {
    if (!column)
      throw FileError(
          fmt::format("{} has no column '{}' (written by another version?); run again with --force or another --out",
                      path.string(), name));
    return column;
  };
  std::vector<Row> rows(table.rows());
  for (const auto& [field, value] : Outcome::fields()) {
    const NumberColumn* column = need(table.number(field.name), field.name);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].values.push_back(column->values[i]);
  }
  const NumberColumn* seconds = need(table.number("wall_seconds"), "wall_seconds");
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].seconds = seconds->values[i];
  const auto text = [&](const Field& field, std::string Row::*member) {
    const TextColumn* column = need(table.text(field.name), field.name);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = column->values[i];
  };
  text(status_field, &Row::status);
  text(reason_field, &Row::reason);
  text(hash_field, &Row::hash);
  text(seed_field, &Row::seed);
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
             const Parameters& parameters)
    : session_(session),
      folder_(session.folder(name)),
      hashes_(hashes),
      parameters_(parameters),
      rows_(hashes.size()),
      done_(hashes.size(), false) {
  for (std::size_t i = 0; i < hashes_.size(); ++i) scenes_[hashes_[i]].push_back(i);
  session.claim(folder_);
  if (session.options.resume) load();
}

void Store::add(const std::vector<std::pair<std::size_t, Row>>& batch) {
  std::vector<const Row*> rows;
  std::string key;
  for (const auto& [index, row] : batch) {
    rows.push_back(&row);
    key += row.hash;
  }
  session_.replace_results(folder_);
  make_folder(folder_ / "parts");
  write_table(folder_ / "parts" / (hash_text(key) + ".h5"), table_of(rows), session_.made_by());
  for (const auto& [index, row] : batch) take(row);
}

void Store::assemble() {
  session_.replace_results(folder_);
  std::vector<const Row*> rows;
  std::vector<std::size_t> scenes;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (done_[i]) {
      rows.push_back(&rows_[i]);
      scenes.push_back(i);
    }
  Table table = table_of(rows);
  for (std::size_t p = parameters_.names.size(); p-- > 0;) {
    const std::string& name = parameters_.names[p];
    // An outcome of the same name is what the impact had; the parameter is what the sweep asked for: keep both.
    const Field field{table.number(name) || table.text(name) ? "over_" + name : name, "number", "",
                      "parameter of the sweep"};
    if (!parameters_.texts[p].empty()) {
      table.texts.insert(table.texts.begin(), {field, {}});
      for (const std::size_t i : scenes) table.texts.front().values.push_back(parameters_.texts[p][i]);
    } else {
      table.numbers.insert(table.numbers.begin(), {field, {}});
      for (const std::size_t i : scenes) table.numbers.front().values.push_back(parameters_.numbers[p][i]);
    }
  }
  write_table(folder_ / "results.h5", table, session_.provenance());
  write_atomically(folder_ / "results.csv", csv(table));
  fs::remove_all(folder_ / "parts");
}

bool Store::take(const Row& row) {
  const auto scenes = scenes_.find(row.hash);
  if (scenes == scenes_.end()) return false;
  for (const std::size_t i : scenes->second) {
    count_ += !done_[i];
    rows_[i] = row;
    done_[i] = true;
  }
  return true;
}

void Store::load() {
  std::vector<fs::path> files;
  std::error_code error;
  if (fs::exists(folder_ / "results.h5", error)) files.push_back(folder_ / "results.h5");
  if (fs::exists(folder_ / "parts", error))
    for (const auto& entry : fs::directory_iterator(folder_ / "parts"))
      if (entry.path().extension() == ".h5") files.push_back(entry.path());
  std::size_t strangers = 0;
  for (const fs::path& file : files) {
    const Provenance theirs = read_provenance(file);
    for (const auto& [name, value] : session_.made_by())
      if (const auto it = theirs.find(name); it == theirs.end() || it->second != value)
        throw FileError(
            fmt::format("{} was written by {} {}, and this is {}: rows of both would stand side by side; finish it by "
                        "that one, or run again with --force or another --out",
                        file.string(), name, it == theirs.end() ? "unknown" : it->second, value));
    for (const Row& row : rows_of(file)) strangers += !take(row);
  }
  if (strangers > 0)
    throw FileError(fmt::format(
        "{} holds {} rows of other scenes than this sweep's, which --resume would lose; use the same parameters (and "
        "the same scenes where accuracy chooses the step: trials of them chose it), --force, or another --out",
        folder_.string(), strangers));
}

}  // namespace ricochet
