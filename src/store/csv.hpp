#pragma once
#include <filesystem>
#include <string>

#include "store/table.hpp"

namespace ricochet {

/// The rows as comma-separated text, units in the header, numbers in the shortest form that reads back exactly.
std::string csv(const Table& table);

/// Throws FileError.
void write_csv(const std::filesystem::path& path, const Table& table, const Provenance& provenance);

}  // namespace ricochet
