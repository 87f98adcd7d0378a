#include "store/table.hpp"

#include <fmt/format.h>

#include "store/files.hpp"
#include "store/hdf5.hpp"
#include "store/sealed_table.hpp"

namespace ricochet {

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

Table table_in(hid_t file) {
  const hdf5::Handle rows = hdf5::open_group(file, rows_group);
  Table table;
  for (const std::string& name : hdf5::link_names(rows)) {
    const Field field = hdf5::described(rows, name);
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

}  // namespace

void write_table(const std::filesystem::path& path, const Table& table, const Provenance& provenance) {
  const hdf5::Handle file = hdf5::memory_file();
  ContentHash content;
  for (const NumberColumn& column : table.numbers) content.add(column.field, column.values);
  for (const TextColumn& column : table.texts) content.add(column.field, column.values);
  {
    const hdf5::Handle rows = hdf5::group(file, rows_group);
    for (const NumberColumn& column : table.numbers)
      hdf5::describe(hdf5::numbers(rows, column.field.name.c_str(), column.values), column.field);
    for (const TextColumn& column : table.texts)
      hdf5::describe(hdf5::texts(rows, column.field.name.c_str(), column.values), column.field);
    hdf5::write_provenance(file, provenance);
  }
  keep_additions(path, file);
  write_atomically(path, hdf5::image(file, content.text(provenance)));
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
