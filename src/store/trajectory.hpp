#pragma once
// Frames of one impact, as H5MD 1.1, readable in MDAnalysis and, through the .xdmf beside it, in ParaView. What
// pictures need beyond H5MD (springs' laws, rims, anchors, forces of contact) stands in /ricochet.

#include <filesystem>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "core/frame.hpp"
#include "store/table.hpp"

namespace ricochet {

class Trajectory {
 public:
  explicit Trajectory(FrameMesh mesh) : mesh_(std::move(mesh)) {}

  void add(Frame frame) { frames_.push_back(std::move(frame)); }

  /// Writes trajectory.h5 and trajectory.xdmf at `path` (its .h5 name), atomically. Positions are 32-bit. Throws
  /// FileError.
  void write(const std::filesystem::path& path, const Provenance& provenance) const;

  const FrameMesh& mesh() const { return mesh_; }
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  FrameMesh mesh_;
  std::vector<Frame> frames_;
};

/// What write() has written. Throws FileError that names the file if it is none of these, or does not fit together.
Trajectory read_trajectory(const std::filesystem::path& path);

/// True if the file is one of these.
bool is_trajectory(const std::filesystem::path& path);

}  // namespace ricochet
