#pragma once
// Bodies cut into slices at right angles to an axis: how the matter of each moves along it.

#include <span>
#include <vector>

#include "core/frame.hpp"

namespace ricochet {

/// Equally thick slices of one body, by where its nodes are in a first frame. Refers to the mesh.
class Slices {
 public:
  /// Of body `body`, along axis 0 or 1, `count` or more slices no thicker than `thickness` [R].
  Slices(const FrameMesh& mesh, const Frame& first, int body, int axis, double thickness);

  int count() const { return static_cast<int>(place_.size()); }
  /// [slice] its middle in the first frame. [R]
  std::span<const double> place() const { return place_; }
  /// [slice] the mean velocity along the axis, weighed by mass; NaN in a slice without nodes. [c]
  std::vector<double> velocity(const Frame& frame) const;

 private:
  const FrameMesh& mesh_;
  int body_, axis_;
  std::vector<double> place_;
  std::vector<int> slice_;  // [node of the body]
};

/// Whether anything of a body moves.
bool moves(const FrameMesh& mesh, int body);

/// The extent of a body along an axis in a frame. [R]
double extent(const FrameMesh& mesh, const Frame& frame, int body, int axis);

}  // namespace ricochet
