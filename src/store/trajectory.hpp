#pragma once
// Positions of one impact over time, as H5MD 1.1, readable in MDAnalysis and, through the .xdmf beside it, in ParaView.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "core/vec2.hpp"
#include "store/table.hpp"

namespace ricochet {

/// Nodes are those of the projectile, then those of the target.
class Trajectory {
 public:
  struct Layout {
    int projectile_nodes, nodes;
    double mass_projectile, mass_target;
    std::vector<std::array<int, 2>> springs;
    std::vector<std::array<int, 3>> triangles;
  };

  explicit Trajectory(Layout layout) : layout_(std::move(layout)) {}

  /// One frame: positions and velocities of every node, and one value of each observable named in `observables`.
  void add(double time, double step, const Points& positions, const Points& velocities, const std::vector<double>& observables);

  /// Writes trajectory.h5 and trajectory.xdmf at `path` (its .h5 name), atomically. Positions are 32-bit. Throws FileError.
  void write(const std::filesystem::path& path, const std::vector<Field>& observables, const Provenance& provenance) const;

  std::size_t frames() const { return time_.size(); }

 private:
  Layout layout_;
  std::vector<double> time_;
  std::vector<std::int64_t> step_;
  std::vector<float> position_, velocity_;      // [frame][node][3]
  std::vector<std::vector<double>> observable_;  // [observable][frame]
};

/// True if the file is one of these.
bool is_trajectory(const std::filesystem::path& path);

}  // namespace ricochet
