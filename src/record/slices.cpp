#include "record/slices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricochet {
namespace {

const BodyMesh& body_at(const FrameMesh& mesh, int body) { return mesh.bodies[static_cast<std::size_t>(body)]; }

// Of a node of a body, along an axis.
std::size_t entry(const FrameMesh& mesh, int body, int node, int axis) {
  return static_cast<std::size_t>(mesh.dim * (body_at(mesh, body).first + node) + axis);
}

struct Reach {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Reach range_of(const FrameMesh& mesh, const Frame& frame, int body, int axis) {
  Reach range;
  for (int i = 0; i < body_at(mesh, body).nodes; ++i) {
    const double at = frame.position[entry(mesh, body, i, axis)];
    range.low = std::min(range.low, at);
    range.high = std::max(range.high, at);
  }
  return range;
}

}  // namespace

bool moves(const FrameMesh& mesh, int body) {
  const BodyMesh& of = body_at(mesh, body);
  const auto first = mesh.anchored.begin() + of.first;
  return std::find(first, first + of.nodes, false) != first + of.nodes;
}

double extent(const FrameMesh& mesh, const Frame& frame, int body, int axis) {
  const Reach range = range_of(mesh, frame, body, axis);
  return range.high - range.low;
}

Slices::Slices(const FrameMesh& mesh, const Frame& first, int body, int axis, double thickness)
    : mesh_(mesh), body_(body), axis_(axis) {
  const Reach range = range_of(mesh, first, body, axis);
  const double length = range.high - range.low;
  // Places are single precision.
  const int count = std::max(1, static_cast<int>(std::ceil(length / thickness * (1 - 1e-6))));
  for (int s = 0; s < count; ++s) place_.push_back(range.low + length * (s + 0.5) / count);
  for (int i = 0; i < body_at(mesh, body).nodes; ++i) {
    const double share = (first.position[entry(mesh, body, i, axis)] - range.low) / length;
    slice_.push_back(std::clamp(static_cast<int>(share * count), 0, count - 1));
  }
}

std::vector<double> Slices::velocity(const Frame& frame) const {
  std::vector<double> momentum(place_.size(), 0.0), mass(place_.size(), 0.0);
  for (std::size_t i = 0; i < slice_.size(); ++i) {
    const auto s = static_cast<std::size_t>(slice_[i]);
    const int node = static_cast<int>(i);
    const double m = mesh_.mass[static_cast<std::size_t>(body_at(mesh_, body_).first + node)];
    momentum[s] += m * frame.velocity[entry(mesh_, body_, node, axis_)];
    mass[s] += m;
  }
  for (std::size_t s = 0; s < momentum.size(); ++s) momentum[s] /= mass[s];  // 0/0 is undefined, as it should be
  return momentum;
}

}  // namespace ricochet
