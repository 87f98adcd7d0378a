#pragma once
// Trajectories as H5MD 1.1, readable in MDAnalysis. What pictures need beyond H5MD (springs' laws, rims, anchors,
// forces of contact) stands in /ricochet.

#include <filesystem>

#include "store/table.hpp"
#include "store/trajectory.hpp"

namespace ricochet {

/// Written atomically; places are 32-bit. Throws FileError.
void write_h5md(const std::filesystem::path& path, const Trajectory& trajectory, const Provenance& provenance);

/// What write_h5md() has written. Throws FileError that names the file if it is none of these, or does not fit
/// together.
Trajectory read_trajectory(const std::filesystem::path& path);

/// True if the file is one of these.
bool is_trajectory(const std::filesystem::path& path);

}  // namespace ricochet
