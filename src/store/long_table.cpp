#include "store/long_table.hpp"

#include <fmt/format.h>

#include "store/files.hpp"
#include "store/hdf5.hpp"
#include "store/run_names.hpp"
#include "store/sealed_table.hpp"

namespace ricochet {

struct LongTable::Open {
  explicit Open(const std::filesystem::path& path)
      : file(hdf5::new_file_beside(path)), rows(hdf5::group(file, rows_group)) {}
  hdf5::Handle file, rows;
  ContentHash content;
};

LongTable::LongTable(std::filesystem::path path) : path_(std::move(path)), open_(std::make_unique<Open>(path_)) {}

LongTable::~LongTable() {
  if (!open_) return;
  open_.reset();
  std::error_code ignored;
  std::filesystem::remove(run_names::unfinished(path_), ignored);
}

void LongTable::add(const Field& field, const std::vector<double>& values) {
  hdf5::describe(hdf5::numbers(open_->rows, field.name.c_str(), values), field);
  open_->content.add(field, values);
}

void LongTable::add(const Field& field, const std::vector<std::string>& values) {
  hdf5::describe(hdf5::many_texts(open_->rows, field.name.c_str(), values), field);
  open_->content.add(field, values);
}

void LongTable::finish(const Provenance& provenance) {
  hdf5::write_provenance(open_->file, provenance);
  keep_additions(path_, open_->file);
  const std::string content = open_->content.text(provenance);
  if (H5Fflush(open_->file, H5F_SCOPE_GLOBAL) < 0)
    throw FileError(fmt::format("cannot write {}; free some space or give another folder with --out, then --resume",
                                path_.string()));
  open_.reset();
  try {
    hdf5::seal(run_names::unfinished(path_), content);
    finish_beside(path_);
  } catch (const FileError&) {
    std::error_code ignored;
    std::filesystem::remove(run_names::unfinished(path_), ignored);
    throw;
  }
}

struct StoredTable::Open {
  Open(const std::filesystem::path& path, bool known)
      : file(known ? hdf5::open_known_file(path) : open_table(path)), rows(hdf5::open_group(file, rows_group)) {}
  hdf5::Handle file, rows;
};

StoredTable::StoredTable(StoredTable&& other) noexcept = default;
StoredTable::~StoredTable() = default;

StoredTable::StoredTable(const std::filesystem::path& path, bool known) : open_(std::make_unique<Open>(path, known)) {
  for (const std::string& name : hdf5::link_names(open_->rows)) {
    const std::size_t length = hdf5::length_of(open_->rows, name.c_str());
    const bool first = numbers_.empty() && texts_.empty();
    if (!first && length != rows_)
      throw FileError(
          fmt::format("{} is no table of results (its columns differ in length); restore it from a copy, "
                      "or run again with --force or another --out",
                      path.string()));
    rows_ = length;
    const bool text = hdf5::holds_text(open_->rows, name.c_str());
    (text ? texts_ : numbers_).push_back(hdf5::described(open_->rows, name));
  }
}

std::vector<double> StoredTable::numbers(const std::string& name, std::size_t first, std::size_t count) const {
  return hdf5::read_numbers(open_->rows, name.c_str(), first, count);
}

std::vector<std::string> StoredTable::texts(const std::string& name, std::size_t first, std::size_t count) const {
  return hdf5::read_texts(open_->rows, name.c_str(), first, count);
}

std::vector<double> stored_numbers(const std::filesystem::path& path, const std::string& column) {
  const hdf5::Handle file = hdf5::open_known_file(path);
  return hdf5::read_numbers(hdf5::open_group(file, rows_group), column.c_str());
}

std::vector<std::string> stored_texts(const std::filesystem::path& path, const std::string& column) {
  const hdf5::Handle file = hdf5::open_known_file(path);
  return hdf5::read_texts(hdf5::open_group(file, rows_group), column.c_str());
}

}  // namespace ricochet
