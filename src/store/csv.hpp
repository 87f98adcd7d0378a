#pragma once
#include <filesystem>
#include <string>

#include "store/long_table.hpp"

namespace ricochet {

/// The rows as comma-separated text, units in the header, numbers in the shortest form that reads back exactly.
std::string csv(const Table& table);

/// The same of a table that is read and written in blocks of rows, its columns in the order of these names. Throws
/// FileError.
void write_long_csv(const std::filesystem::path& path, const StoredTable& table, const std::vector<std::string>& names);

/// Throws FileError.
void write_csv(const std::filesystem::path& path, const Table& table, const Provenance& provenance);

}  // namespace ricochet
