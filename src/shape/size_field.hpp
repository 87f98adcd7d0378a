#pragma once
#include <algorithm>
#include <cmath>

#include "core/vec2.hpp"

namespace ricochet {

/// How long the sides of triangles are to be at a place: `least` up to `within` of `fine_at`, and longer by `grade` for
/// every unit of length farther away, up to `most`. [R]
struct SizeField {
  double least, most, grade;
  Vec2 fine_at;
  double within;

  double operator()(const Vec2& place) const {
    return std::clamp(least + grade * ((place - fine_at).norm() - within), least, most);
  }
};

/// About how many nodes fill a disk of this radius around `fine_at`: nearly equilateral triangles have a node in every
/// sqrt(3)/2 h^2.
inline double nodes_within(const SizeField& size, double radius) {
  constexpr int rings = 2000;
  double sum = 0;
  for (int k = 0; k < rings; ++k) {
    const double r = radius * (k + 0.5) / rings, h = size(size.fine_at + Vec2(r, 0));
    sum += 2 * 3.141592653589793 * r * (radius / rings) / (0.866 * h * h);
  }
  return sum;
}

}  // namespace ricochet
