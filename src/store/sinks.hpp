#pragma once
// The formats in which a run leaves its results and recorded impacts. A new one is a header with its function and a
// line in sinks.cpp: whoever writes, replaces, protects or lists files asks these lists.

#include <filesystem>
#include <span>

#include "store/table.hpp"
#include "store/trajectory.hpp"

namespace ricochet {

/// Writes a table at a path, atomically, or throws FileError.
struct RowsSink {
  const char* extension;
  void (*write)(const std::filesystem::path& path, const Table& table, const Provenance& provenance);
};

/// Writes a recorded impact (its mesh, its frames with their energies) at a path, atomically, or throws FileError.
struct TrajectorySink {
  const char* extension;
  void (*write)(const std::filesystem::path& path, const Trajectory& trajectory, const Provenance& provenance);
};

/// Written in this order; the first is the one that can be read back.
std::span<const RowsSink> rows_sinks();
std::span<const TrajectorySink> trajectory_sinks();

/// `path` without extension: FILE.h5, FILE.csv ...
void write_everywhere(const std::filesystem::path& path, const Table& table, const Provenance& provenance);
void write_everywhere(const std::filesystem::path& path, const Trajectory& trajectory, const Provenance& provenance);

}  // namespace ricochet
