#pragma once
// Bounds of the highest frequency of a network of springs.

#include <cmath>
#include <vector>

#include "body/bound.hpp"
#include "body/springs/rest.hpp"
#include "body/springs/sweep.hpp"

namespace ricochet {

/// omega^2 <= 2 max_i lambda_max(K_ii) / m with K_ii = sum of k n n^T (prestressed: and |T|/r (1 - n n^T)) over the
/// springs of node i, by the linear part of their law: for a network whose every spring joins two nodes,
/// K <= 2 blockdiag(K_ii) as a quadratic form, because k (n.(u_i - u_j))^2 <= 2k (n.u_i)^2 + 2k (n.u_j)^2. [here]
FrequencyBound frequency_bound(const Solid& solid, const Springs& springs, double stiffness);

/// A symmetric D x D block of a node: in the plane the three numbers that differ.
template <int W>
struct NodeBlock {
  Lane<W> xx = Lane<W>::Zero(), xy = Lane<W>::Zero(), yy = Lane<W>::Zero();

  /// Of a spring of unit direction n: along n n^T + across (1 - n n^T).
  void add(const Place<W, 2>& n, const Lane<W>& along, const Lane<W>& across) {
    const Lane<W> more = along - across;
    xx += across + more * n.at[0] * n.at[0];
    xy += more * n.at[0] * n.at[1];
    yy += across + more * n.at[1] * n.at[1];
  }
  Lane<W> largest_eigenvalue() const {
    const Lane<W> half = (xx - yy) / 2;
    return (xx + yy) / 2 + (half * half + xy * xy).sqrt();
  }
};

/// The largest 2 lambda_max(K_ii) / m over the free nodes as the springs are stretched now: K_ii is the sum of
/// T'(x) n n^T + (|T|/r) (1 - n n^T). The half list gives a spring's block to both its ends. rest(s, x): what is left
/// of spring s at a stretch x.
template <int W, class Rest>
SquaredBounds<W> squared_frequency_bound(const Motion<W>& body, const Springs& springs, Rest&& rest) {
  static thread_local std::vector<NodeBlock<W>> blocks;
  const Solid& solid = *body.solid;
  blocks.assign(static_cast<std::size_t>(solid.nodes()), NodeBlock<W>{});
  each_spring<2>(body, springs,
                 [&](const auto& law, int i, int s, const Spring& spring, const Place<W, 2>& d, const Lane<W>& r) {
                   const SpringRest<Lane<W>> left = rest(s, Lane<W>(r - spring.length));
                   const Lane<W> along = left.share * spring.stiffness * law.tangent(left.elastic);
                   const Lane<W> across = left.share * spring.stiffness * law.tension(left.elastic).abs() / r;
                   Place<W, 2> n;
                   for (int k = 0; k < 2; ++k) n.at[k] = d.at[k] / r;
                   for (const int node : {i, spring.other})
                     blocks[static_cast<std::size_t>(node)].add(n, along, across);
                 });
  SquaredBounds<W> largest;
  for (int i = 0; i < solid.free; ++i) {
    Lane<W> eigenvalue = blocks[static_cast<std::size_t>(i)].largest_eigenvalue();
    if (!solid.mass.uniform()) eigenvalue *= solid.mass.inverse()[static_cast<std::size_t>(i)];
    largest.raise(eigenvalue, i);
  }
  const double per_mass = solid.mass.uniform() ? 2 / solid.mass.each() : 2;
  largest.omega2 *= per_mass * body.stiffness;
  return largest;
}

/// The same for springs without a past.
template <int W>
SquaredBounds<W> squared_frequency_bound(const Motion<W>& body, const Springs& springs) {
  return squared_frequency_bound(body, springs, [](int, const Lane<W>& x) {
    return SpringRest<Lane<W>>{x, Lane<W>::Ones()};
  });
}

}  // namespace ricochet
