#pragma once
// Bounds of the highest frequency of a body.

#include <array>

#include "core/lane.hpp"

namespace ricochet {

struct FrequencyBound {
  double omega = 0;  ///< no vibration of the body at rest is faster [c/R]
  int node = 0;      ///< the node that sets it
};

/// A bound of the highest frequency in W lanes.
template <int W>
struct SquaredBounds {
  Lane<W> omega2 = Lane<W>::Zero();  ///< [c^2/R^2]
  std::array<int, W> node{};         ///< the node that sets it

  /// Takes a node's value where it is the greatest yet.
  void raise(const Lane<W>& value, int at) {
    for (int lane = 0; lane < W; ++lane)
      if (value[lane] > omega2[lane]) {
        omega2[lane] = value[lane];
        node[static_cast<std::size_t>(lane)] = at;
      }
  }
};

}  // namespace ricochet
