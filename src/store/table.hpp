#pragma once
// A sweep's results: one row an impact, columns of numbers and of text, and where they came from.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

struct NumberColumn {
  Field field;
  std::vector<double> values;
};

struct TextColumn {
  Field field;
  std::vector<std::string> values;
};

struct Table {
  std::vector<NumberColumn> numbers;
  std::vector<TextColumn> texts;

  std::size_t rows() const {
    return !texts.empty() ? texts.front().values.size() : numbers.empty() ? 0 : numbers.front().values.size();
  }
  const TextColumn* text(const std::string& name) const;
  const NumberColumn* number(const std::string& name) const;
};

/// What a result came from: names and texts (script, arguments, version, host, times ...).
using Provenance = std::map<std::string, std::string>;

/// `/rows/<column>` with attributes unit and doc, `/provenance/<name>`. What somebody has put beside these two groups
/// into the file that is replaced is kept. Written atomically. Throws FileError.
void write_table(const std::filesystem::path& path, const Table& table, const Provenance& provenance);

/// Throws FileError that names the file and the remedy if it is damaged. What was added beside the groups is no damage.
Table read_table(const std::filesystem::path& path);
Provenance read_provenance(const std::filesystem::path& path);

}  // namespace ricochet
