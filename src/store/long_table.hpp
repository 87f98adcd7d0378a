#pragma once
// Tables that are too long for memory: written a column at a time, read by parts.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "store/table.hpp"

namespace ricochet {

/// Writes a table as write_table() does: nothing is at its path before finish(). All members throw FileError.
class LongTable {
 public:
  explicit LongTable(std::filesystem::path path);
  LongTable(const LongTable&) = delete;
  LongTable& operator=(const LongTable&) = delete;
  ~LongTable();

  void add(const Field& field, const std::vector<double>& values);
  void add(const Field& field, const std::vector<std::string>& values);
  void finish(const Provenance& provenance);

 private:
  struct Open;

  std::filesystem::path path_;
  std::unique_ptr<Open> open_;
};

/// A file of write_table() or LongTable, of which as much is read as is asked for. All members throw FileError.
class StoredTable {
 public:
  /// Its seal is checked, unless this process has `known` it whole before.
  explicit StoredTable(const std::filesystem::path& path, bool known = false);
  StoredTable(StoredTable&& other) noexcept;
  ~StoredTable();

  std::size_t rows() const { return rows_; }
  const std::vector<Field>& numbers() const { return numbers_; }
  const std::vector<Field>& texts() const { return texts_; }

  std::vector<double> numbers(const std::string& name, std::size_t first, std::size_t count) const;
  std::vector<std::string> texts(const std::string& name, std::size_t first, std::size_t count) const;
  std::vector<double> numbers(const std::string& name) const { return numbers(name, 0, rows_); }
  std::vector<std::string> texts(const std::string& name) const { return texts(name, 0, rows_); }

  /// `count` rows from the one at `first` on, of those columns that `wanted` takes.
  template <class Wanted>
  Table part(std::size_t first, std::size_t count, Wanted wanted) const {
    Table table;
    for (const Field& field : numbers_)
      if (wanted(field)) table.numbers.push_back({field, numbers(field.name, first, count)});
    for (const Field& field : texts_)
      if (wanted(field)) table.texts.push_back({field, texts(field.name, first, count)});
    return table;
  }

 private:
  struct Open;

  std::unique_ptr<const Open> open_;
  std::size_t rows_ = 0;
  std::vector<Field> numbers_, texts_;
};

/// A column of such a file, which this process has known whole before. Throws FileError.
std::vector<double> stored_numbers(const std::filesystem::path& path, const std::string& column);
std::vector<std::string> stored_texts(const std::filesystem::path& path, const std::string& column);

}  // namespace ricochet
