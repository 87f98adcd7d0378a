#include "store/table.hpp"

#include <fmt/format.h>

#include <optional>

#include "core/hash.hpp"
#include "store/files.hpp"
#include "store/hdf5.hpp"

namespace ricochet {
namespace {

void describe(const hdf5::Handle& set, const Field& field) {
  hdf5::attribute(set, "unit", field.unit);
  hdf5::attribute(set, "doc", field.doc);
}

}  // namespace

const TextColumn* Table::text(const std::string& name) const {
  for (const TextColumn& column : texts)
    if (column.field.name == name) return &column;
  return nullptr;
}

const NumberColumn* Table::number(const std::string& name) const {
  for (const NumberColumn& column : numbers)
    if (column.field.name == name) return &column;
  return nullptr;
}

namespace {

constexpr const char* rows_group = "rows";
constexpr const char* provenance_group = "provenance";

// Of all that a table and its provenance are, in whatever order the columns stand.
std::string hash_of(const Table& table, const Provenance& provenance) {
  std::map<std::string, std::string> columns;
  const auto add = [&](const Field& field, std::string bytes) {
    columns[field.name] = fmt::format("{}\n{}\n{}", field.unit, field.doc, hash_text(bytes));
  };
  for (const NumberColumn& column : table.numbers)
    add(column.field, {reinterpret_cast<const char*>(column.values.data()), column.values.size() * sizeof(double)});
  for (const TextColumn& column : table.texts) {
    std::string texts;
    for (const std::string& value : column.values) (texts += value.c_str()) += '\0';
    add(column.field, texts);
  }
  std::string all;
  for (const auto& [name, text] : columns) all += name + "\n" + text + "\n";
  for (const auto& [name, text] : provenance) all += fmt::format("{} {}\n", name, hash_text(text.c_str()));
  return hash_text(all);
}

Table table_in(hid_t file) {
  const hdf5::Handle rows = hdf5::open_group(file, rows_group);
  Table table;
  for (const std::string& name : hdf5::link_names(rows)) {
    const hdf5::Handle set(H5Dopen2(rows, name.c_str(), H5P_DEFAULT), H5Dclose, "open a column");
    Field field{name, "", hdf5::text_attribute(set, "unit"), hdf5::text_attribute(set, "doc")};
    if (hdf5::holds_text(rows, name.c_str()))
      table.texts.push_back({field, hdf5::read_texts(rows, name.c_str())});
    else
      table.numbers.push_back({field, hdf5::read_numbers(rows, name.c_str())});
  }
  for (const auto& column : table.numbers)
    if (column.values.size() != table.rows()) throw FileError("its columns differ in length");
  for (const auto& column : table.texts)
    if (column.values.size() != table.rows()) throw FileError("its columns differ in length");
  return table;
}

Provenance provenance_in(hid_t file) {
  Provenance provenance;
  if (H5Lexists(file, provenance_group, H5P_DEFAULT) <= 0) return provenance;
  const hdf5::Handle origin = hdf5::open_group(file, provenance_group);
  for (const std::string& name : hdf5::link_names(origin)) {
    const auto text = hdf5::read_texts(origin, name.c_str());
    provenance[name] = text.empty() ? "" : text.front();
  }
  return provenance;
}

// A file that is open, of which what we wrote is as it was.
hdf5::Handle open_table(const std::filesystem::path& path) {
  hdf5::Opened opened = hdf5::open_with_additions(path);
  if (opened.content.empty()) return std::move(opened.file);
  std::string content;
  try {
    content = hash_of(table_in(opened.file), provenance_in(opened.file));
  } catch (const FileError&) {  // then it is not what was written
  }
  if (content != opened.content)
    throw FileError(
        fmt::format("{} is damaged, or something in its groups '{}' and '{}' was changed or added there (data sets of "
                    "one's own belong beside them); {}",
                    path.string(), rows_group, provenance_group, hdf5::damage_remedy));
  return std::move(opened.file);
}

// What somebody has added beside our groups to the file that is to be replaced; nothing of one that is not whole.
void keep_additions(const std::filesystem::path& path, const hdf5::Handle& file) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  std::optional<hdf5::Handle> earlier;
  try {
    earlier.emplace(open_table(path));
  } catch (const FileError&) {
    return;
  }
  for (const std::string& name : hdf5::link_names(*earlier)) {
    if (name == rows_group || name == provenance_group) continue;
    if (H5Ocopy(*earlier, name.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
      throw FileError(fmt::format("{} holds '{}', which somebody added and HDF5 cannot copy into the new file; move it",
                                  path.string(), name));
  }
}

}  // namespace

void write_table(const std::filesystem::path& path, const Table& table, const Provenance& provenance) {
  const hdf5::Handle file = hdf5::memory_file();
  {
    const hdf5::Handle rows = hdf5::group(file, rows_group);
    for (const NumberColumn& column : table.numbers)
      describe(hdf5::numbers(rows, column.field.name.c_str(), column.values), column.field);
    for (const TextColumn& column : table.texts)
      describe(hdf5::texts(rows, column.field.name.c_str(), column.values), column.field);
    hdf5::write_provenance(file, provenance);
  }
  keep_additions(path, file);
  write_atomically(path, hdf5::image(file, hash_of(table, provenance)));
}

Table read_table(const std::filesystem::path& path) {
  const hdf5::Handle file = open_table(path);
  try {
    return table_in(file);
  } catch (const FileError& error) {
    throw FileError(fmt::format(
        "{} is no table of results ({}); restore it from a copy, or run again with --force or another --out",
        path.string(), error.what()));
  }
}

Provenance read_provenance(const std::filesystem::path& path) {
  const hdf5::Handle file = open_table(path);
  try {
    return provenance_in(file);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{} has no readable provenance ({})", path.string(), error.what()));
  }
}

}  // namespace ricochet
