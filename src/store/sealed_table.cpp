#include "store/sealed_table.hpp"

#include <fmt/format.h>

#include <cstring>
#include <optional>

#include "core/hash.hpp"
#include "core/hash_pieces.hpp"

namespace ricochet {

namespace {

std::string described_by(const Field& field, const std::string& hash) {
  return fmt::format("{}\n{}\n{}", field.unit, field.doc, hash);
}

}  // namespace

void ContentHash::add(const Field& field, const std::vector<double>& values) {
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  columns_[field.name] = described_by(field, hash_text(bytes));
}

void ContentHash::add(const Field& field, const std::vector<std::string>& values) {
  Hasher hasher;
  for (const std::string& value : values) hasher.add({value.c_str(), std::strlen(value.c_str()) + 1});
  columns_[field.name] = described_by(field, hasher.text());
}

std::string ContentHash::text(const Provenance& provenance) const {
  std::string all;
  for (const auto& [name, text] : columns_) all += name + "\n" + text + "\n";
  for (const auto& [name, text] : provenance) all += fmt::format("{} {}\n", name, hash_text(text.c_str()));
  return hash_text(all);
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

namespace {

// A column at a time: a table may be longer than memory.
std::string content_in(hid_t file) {
  ContentHash content;
  const hdf5::Handle rows = hdf5::open_group(file, rows_group);
  for (const std::string& name : hdf5::link_names(rows)) {
    const Field field = hdf5::described(rows, name);
    if (hdf5::holds_text(rows, name.c_str()))
      content.add(field, hdf5::read_texts(rows, name.c_str()));
    else
      content.add(field, hdf5::read_numbers(rows, name.c_str()));
  }
  return content.text(provenance_in(file));
}

}  // namespace

hdf5::Handle open_table(const std::filesystem::path& path) {
  hdf5::Opened opened = hdf5::open_with_additions(path);
  if (opened.content.empty()) return std::move(opened.file);
  std::string content;
  try {
    content = content_in(opened.file);
  } catch (const FileError&) {  // then it is not what was written
  }
  if (content != opened.content)
    throw FileError(
        fmt::format("{} is damaged, or something in its groups '{}' and '{}' was changed or added there (data sets of "
                    "one's own belong beside them); {}",
                    path.string(), rows_group, provenance_group, hdf5::damage_remedy));
  return std::move(opened.file);
}

void keep_additions(const std::filesystem::path& path, hid_t successor) {
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
    if (H5Ocopy(*earlier, name.c_str(), successor, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
      throw FileError(fmt::format("{} holds '{}', which somebody added and HDF5 cannot copy into the new file; move it",
                                  path.string(), name));
  }
}

}  // namespace ricochet
