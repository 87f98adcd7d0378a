#pragma once
#include <array>
#include <vector>

#include "force/spring/rest.hpp"
#include "force/springs.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

struct FrequencyBound {
  double omega;  ///< no vibration of the lattice at rest is faster [c/R]
  int node;      ///< the node that sets it
};

/// omega^2 <= 2 max_i lambda_max(K_ii) / m with K_ii = sum of k n n^T (prestressed: and |T|/r (1 - n n^T)) over the
/// springs of node i: for a network whose every spring joins two nodes, K <= 2 blockdiag(K_ii) as a quadratic form,
/// because k (n.(u_i - u_j))^2 <= 2k (n.u_i)^2 + 2k (n.u_j)^2. [here]
FrequencyBound frequency_bound(const Lattice& lattice, double stiffness);

/// A bound of the highest frequency in W lanes.
template <int W>
struct SquaredBounds {
  Lane<W> omega2 = Lane<W>::Zero();  ///< [c^2/R^2]
  std::array<int, W> node{};         ///< the node that sets it
};

/// The largest 2 lambda_max(K_ii) / m over the free nodes as the springs are stretched now: K_ii is the sum of
/// T'(x) n n^T + (|T|/r) (1 - n n^T). The half list gives a spring's block to both its ends. rest(s, x): what is left
/// of spring s at a stretch x.
template <int W, class Rest>
SquaredBounds<W> squared_frequency_bound(const Moving<W>& body, Rest&& rest) {
  const Lattice& lattice = *body.lattice;
  struct Block {
    Lane<W> xx = Lane<W>::Zero(), xy = Lane<W>::Zero(), yy = Lane<W>::Zero();
  };
  static thread_local std::vector<Block> blocks;
  blocks.assign(static_cast<std::size_t>(lattice.nodes()), Block{});
  for (int i = 0; i < lattice.free; ++i)
    for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) {
      const Spring spring = lattice.spring[s];
      const Lane<W> dx = body.position.x(spring.other) - body.position.x(i),
                    dy = body.position.y(spring.other) - body.position.y(i);
      const Lane<W> r = (dx * dx + dy * dy).sqrt();
      const SpringRest<Lane<W>> left = rest(s, Lane<W>(r - spring.length));
      const Lane<W>& x = left.elastic;
      const Lane<W> along = left.share * spring.stiffness * (1.0 + 3 * lattice.quartic * (x * x));
      const Lane<W> across = left.share * spring.stiffness * (x * (1.0 + lattice.quartic * (x * x))).abs() / r;
      const Lane<W> nx = dx / r, ny = dy / r, more = along - across;
      for (const int node : {i, spring.other}) {
        Block& b = blocks[node];
        b.xx += across + more * nx * nx;
        b.xy += more * nx * ny;
        b.yy += across + more * ny * ny;
      }
    }
  SquaredBounds<W> largest;
  for (int i = 0; i < lattice.free; ++i) {
    const Block& b = blocks[i];
    const Lane<W> half = (b.xx - b.yy) / 2;
    const Lane<W> eigenvalue = (b.xx + b.yy) / 2 + (half * half + b.xy * b.xy).sqrt();
    for (int lane = 0; lane < W; ++lane)
      if (eigenvalue[lane] > largest.omega2[lane]) {
        largest.omega2[lane] = eigenvalue[lane];
        largest.node[static_cast<std::size_t>(lane)] = i;
      }
  }
  largest.omega2 *= 2 / lattice.mass * body.stiffness;
  return largest;
}

/// The same for springs without a past.
template <int W>
SquaredBounds<W> squared_frequency_bound(const Moving<W>& body) {
  return squared_frequency_bound(body, [](int, const Lane<W>& x) { return SpringRest<Lane<W>>{x, Lane<W>::Ones()}; });
}

}  // namespace ricochet
