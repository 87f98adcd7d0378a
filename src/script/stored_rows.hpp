#pragma once
// What is stored of a sweep, whoever is writing there.

#include <filesystem>

#include "store/table.hpp"

namespace ricochet {

/// The rows of a sweep's folder so far: its results, and parts of a run or of shards, each scene once. The sweep's own
/// parameters stand first, then what a row has. Takes no lock. Throws FileError if a file is damaged.
Table stored_rows(const std::filesystem::path& folder);

}  // namespace ricochet
