#include "script/row_index.hpp"

#include <fmt/format.h>

#include <map>
#include <unordered_set>

#include "core/error.hpp"
#include "script/known_rows.hpp"
#include "store/long_table.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

constexpr const char* hash_column = "scene_hash";

std::vector<double> column_of(const fs::path& file, const std::string& column, double) {
  return stored_numbers(file, column);
}
std::vector<std::string> column_of(const fs::path& file, const std::string& column, const std::string&) {
  return stored_texts(file, column);
}

template <class Value, class PathOf>
std::vector<Value> gathered(const std::string& column, const std::vector<RowPlace>& rows, PathOf path_of) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_file;
  for (std::size_t i = 0; i < rows.size(); ++i) by_file[rows[i].file].push_back(static_cast<std::uint32_t>(i));
  std::vector<Value> values(rows.size());
  for (const auto& [file, places] : by_file) {
    const std::vector<Value> stored = column_of(path_of(file), column, Value{});
    for (const std::uint32_t i : places) values[i] = stored.at(rows[i].row);
  }
  return values;
}

}  // namespace

std::uint32_t RowIndex::enter(const fs::path& file) {
  std::error_code error;
  files_.push_back({file, fs::last_write_time(file, error), fs::file_size(file, error)});
  return static_cast<std::uint32_t>(files_.size() - 1);
}

void RowIndex::add(const fs::path& file) {
  refuse_other_program(file);
  const StoredTable table(file, true);  // just read whole
  refuse_missing_columns(file, table.numbers(), table.texts());
  const std::vector<std::string> hashes = table.texts(hash_column);
  const std::uint32_t entered = enter(file);
  places_.reserve(places_.size() + hashes.size());
  std::vector<Twin> twins;
  for (std::uint32_t row = 0; row < hashes.size(); ++row) {
    const auto [place, is_new] = places_.try_emplace(HashKey::of(hashes[row]), RowPlace{entered, row});
    if (!is_new) twins.emplace_back(place->second, row);
  }
  compare(twins, entered);
}

void RowIndex::add(const fs::path& file, const std::vector<HashKey>& rows) {
  const std::uint32_t entered = enter(file);
  for (std::uint32_t row = 0; row < rows.size(); ++row) places_[rows[row]] = {entered, row};
}

void RowIndex::clear() {
  files_.clear();
  places_.clear();
}

const RowPlace* RowIndex::find(const HashKey& scene) const {
  const auto found = places_.find(scene);
  return found == places_.end() ? nullptr : &found->second;
}

std::size_t RowIndex::strangers(const std::vector<HashKey>& scenes) const {
  const std::unordered_set<HashKey, HashKey::Spread> own(scenes.begin(), scenes.end());
  std::size_t met = 0;
  for (const HashKey& key : own) met += places_.contains(key);
  return rows() - met;
}

void RowIndex::compare(const std::vector<Twin>& twins, std::uint32_t file) const {
  if (twins.empty()) return;
  std::vector<RowPlace> one, other;
  for (const auto& [place, row] : twins) {
    one.push_back(place);
    other.push_back({file, row});
  }
  const std::vector<std::string> hashes = texts(hash_column, other);
  const auto refuse = [&](std::size_t i, const std::string& differs) {
    refuse_difference(hashes[i], differs, files_[one[i].file].path, files_[file].path);
  };
  const Table columns = table_of({});
  for (const NumberColumn& column : columns.numbers) {
    const std::string& name = column.field.name;
    if (name == "wall_seconds") continue;
    const std::vector<double> a = numbers(name, one), b = numbers(name, other);
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!same_bits(a[i], b[i])) refuse(i, fmt::format("{} {} and {}", name, a[i], b[i]));
  }
  for (const TextColumn& column : columns.texts) {
    const std::string& name = column.field.name;
    const std::vector<std::string> a = texts(name, one), b = texts(name, other);
    for (std::size_t i = 0; i < a.size(); ++i)
      if (a[i] != b[i]) refuse(i, fmt::format("{} '{}' and '{}'", name, a[i], b[i]));
  }
}

std::vector<double> RowIndex::numbers(const std::string& column, const std::vector<RowPlace>& rows) const {
  return gathered<double>(column, rows, [this](std::uint32_t file) { return files_[file].path; });
}

std::vector<std::string> RowIndex::texts(const std::string& column, const std::vector<RowPlace>& rows) const {
  return gathered<std::string>(column, rows, [this](std::uint32_t file) { return files_[file].path; });
}

void RowIndex::refuse_changed() const {
  std::error_code error;
  std::vector<bool> used(files_.size());
  for (const auto& [key, place] : places_) used[place.file] = true;
  for (std::size_t k = 0; k < files_.size(); ++k) {
    const File& file = files_[k];
    if (!used[k]) continue;
    if (fs::last_write_time(file.path, error) != file.written || fs::file_size(file.path, error) != file.bytes)
      throw FileError(
          fmt::format("{} was replaced by another process while its rows were read; wait for its end and give the same "
                      "command again",
                      file.path.string()));
  }
}

}  // namespace ricochet
