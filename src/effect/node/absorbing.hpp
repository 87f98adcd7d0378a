#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "body/solid.hpp"
#include "core/field.hpp"

namespace ricochet {

/// A sponge along the target's anchored edges: dv/dt = -rate (1 - d/width)^2 v at a distance d < width from the nearest
/// anchor, so that waves fade before they come back and the target acts as a half-space. The square makes the layer's
/// own reflection small: it begins without a kink. A wave of speed c_w loses rate/2 of its amplitude in a unit of time
/// where half of its energy moves, so a wave much shorter than the width comes back with exp(-rate width / (3 c_w)) of
/// it. [here; the profile: e.g. Israeli & Orszag 1981, J. Comput. Phys. 41, 115]
struct Absorbing {
  static constexpr const char* name = "absorbing";
  static constexpr const char* doc =
      "A layer along the target's anchored edges in which waves fade, so that the target acts as a half-space. A wave "
      "much shorter than the width, of speed c_w, comes back with exp(-rate width / 3 c_w) of its amplitude.";
  static constexpr const char* example = "ricochet.absorbing { width = 1, rate = 5 }";
  static constexpr const char* energy_doc = "energy lost in the absorbing layer";

  static constexpr bool needs_anchors = true;

  double width = 0;
  double rate = 0;

  static const std::vector<Member<Absorbing>>& fields() {
    static const std::vector<Member<Absorbing>> list{
        {{"width", "number", "R", "of the layer, from the anchors inwards", positive}, &Absorbing::width},
        {{"rate", "number", "c/R", "share of the velocity lost in a unit of time at the anchors", not_negative},
         &Absorbing::rate},
    };
    return list;
  }

  /// Of each free node [c/R].
  std::vector<double> rates(const Solid& solid) const {
    std::vector<double> list(static_cast<std::size_t>(solid.free), 0.0);
    // Sorted along x, only anchors less than a width away along x are looked at.
    std::vector<Vec2> anchors(solid.points.begin() + solid.free, solid.points.end());
    std::sort(anchors.begin(), anchors.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
    for (int i = 0; i < solid.free; ++i) {
      const Vec2& p = solid.points[i];
      double nearest = width;
      for (auto a = std::lower_bound(anchors.begin(), anchors.end(), p.x() - width,
                                     [](const Vec2&q, double x) { return q.x() < x; });
           a != anchors.end() && a->x() < p.x() + width; ++a)
        nearest = std::min(nearest, (*a - p).norm());
      const double inside = 1 - nearest / width;
      list[static_cast<std::size_t>(i)] = rate * inside * inside;
    }
    return list;
  }
};

}  // namespace ricochet
