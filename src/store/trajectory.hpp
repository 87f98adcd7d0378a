#pragma once
// Frames of one impact, to be stored.

#include <utility>
#include <vector>

#include "core/frame.hpp"

namespace ricochet {

class Trajectory {
 public:
  explicit Trajectory(FrameMesh mesh) : mesh_(std::move(mesh)) {}

  void add(Frame frame) { frames_.push_back(std::move(frame)); }

  const FrameMesh& mesh() const { return mesh_; }
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  FrameMesh mesh_;
  std::vector<Frame> frames_;
};

}  // namespace ricochet
