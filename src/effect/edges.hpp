#pragma once
// Edges whose dashpots let waves out, of all bodies and in W lanes.

#include <cmath>
#include <utility>
#include <vector>

#include "body/motion.hpp"
#include "core/carrier.hpp"
#include "effect/element/absorbing_edges.hpp"

namespace ricochet {

template <int W>
class Edges {
 public:
  explicit Edges(std::size_t bodies) : of_(bodies) {}

  void let(std::size_t body, const std::vector<EdgeDashpot>& dashpots) {
    of_[body].clear();
    for (const EdgeDashpot& dashpot : dashpots)
      of_[body].push_back({dashpot, Lane<W>::Ones(), Lane<W>::Zero(), Lane<W>::Ones()});
  }

  /// An impact begins in a lane, whose velocities are taken for `half` a step at a time.
  void begin(int lane, double half, const Motions<W>& bodies) {
    for (std::size_t b = 0; b < of_.size(); ++b)
      for (Kept& kept : of_[b])
        set(kept, lane, half * std::sqrt(bodies[b].stiffness[lane]) / bodies[b].solid->mass[kept.dashpot.node]);
  }

  void carry(int lane, Carrier& carrier) {
    for (std::vector<Kept>& nodes : of_)
      for (Kept& kept : nodes)
        for (Lane<W>* number : {&kept.xx, &kept.xy, &kept.yy}) carrier.pass((*number)[lane]);
  }

  /// Half a step of the dashpots of a body; returns what they took. [m0 c^2]
  Lane<W> damp(Motion<W>& body, std::size_t b) const {
    Place<W, 2>* velocity = body.v.template places<2>();
    Lane<W> lost = Lane<W>::Zero();
    for (const Kept& kept : of_[b]) {
      Place<W, 2>& v = velocity[kept.dashpot.node];
      const Lane<W> before = dot(v, v);
      const Lane<W> x = kept.xx * v.at[0] + kept.xy * v.at[1];
      v.at[1] = kept.xy * v.at[0] + kept.yy * v.at[1];
      v.at[0] = x;
      lost += (0.5 * body.solid->mass[kept.dashpot.node]) * (before - dot(v, v));
    }
    return lost;
  }

 private:
  // What is left of a velocity: exp(-C by) of its dashpot's C.
  struct Kept {
    EdgeDashpot dashpot;
    Lane<W> xx, xy, yy;
  };

  // C = m + [d c; c -d], whose eigenvalues are m +- r: exp(-C t) = exp(-m t) (cosh(r t) - sinh(r t)/r [d c; c -d]).
  static void set(Kept& kept, int lane, double by) {
    const auto& [node, xx, xy, yy] = kept.dashpot;
    const double mean = (xx + yy) / 2, half = (xx - yy) / 2, radius = std::hypot(half, xy);
    const double slow = std::exp(-(mean - radius) * by), fast = std::exp(-(mean + radius) * by);
    const double even = (slow + fast) / 2, odd = radius > 0 ? (fast - slow) / (2 * radius) : 0;
    kept.xx[lane] = even + odd * half;
    kept.xy[lane] = odd * xy;
    kept.yy[lane] = even - odd * half;
  }

  std::vector<std::vector<Kept>> of_;  // [body][node with a dashpot]
};

}  // namespace ricochet
