#pragma once
#include <filesystem>
#include <string>

namespace ricochet {

/// Runs gnuplot on a file in a folder; its status as waitpid gives it. `confined`: it can start no program. Throws
/// FileError if it cannot be run.
int run_gnuplot(const std::filesystem::path& folder, const std::string& file, bool confined);

}  // namespace ricochet
