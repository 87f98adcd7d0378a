#pragma once
// Bounds of the highest frequency of a body of elements.

#include <cmath>
#include <vector>

#include "body/bound.hpp"
#include "body/elements/stiffness.hpp"

namespace ricochet {

/// omega^2 <= the largest row sum of absolute values of M^-1/2 K M^-1/2 over the free coordinates, K: the second
/// derivatives of the energy where the body is, assembled from its elements: no eigenvalue of a matrix exceeds its
/// largest row sum [Gerschgorin]. 1.20 to 1.30 times the highest frequency itself; those of single elements bound it
/// only by 1.7 to 2.0 times. [here]
template <int W>
SquaredBounds<W> squared_frequency_bound(const Motion<W>& body, const Elements& elements) {
  const Solid& solid = *body.solid;
  static thread_local AssembledStiffness<W> K;
  K.assemble(body, elements);
  const auto root = [&](int node) { return std::sqrt(solid.mass.inverse()[static_cast<std::size_t>(node)]); };
  std::vector<Place<W, 2>> rows(static_cast<std::size_t>(solid.free));
  for (int i = 0; i < solid.free; ++i) {
    const NodeStiffness<W>& own = K.diagonal[static_cast<std::size_t>(i)];
    rows[static_cast<std::size_t>(i)] = root(i) * Place<W, 2>(own.xx.abs() + own.xy.abs(), own.yx.abs() + own.yy.abs());
  }
  for (std::size_t s = 0; s < elements.edge.size(); ++s) {
    const auto& [i, j] = elements.edge[s];
    if (j >= solid.free) continue;
    const NodeStiffness<W>& between = K.off_diagonal[s];
    const Lane<W> xx = between.xx.abs(), xy = between.xy.abs(), yx = between.yx.abs(), yy = between.yy.abs();
    rows[static_cast<std::size_t>(i)] += root(j) * Place<W, 2>(xx + xy, yx + yy);
    rows[static_cast<std::size_t>(j)] += root(i) * Place<W, 2>(xx + yx, xy + yy);
  }
  SquaredBounds<W> largest;
  for (int i = 0; i < solid.free; ++i) {
    const Place<W, 2>& row = rows[static_cast<std::size_t>(i)];
    largest.raise(root(i) * row.at[0].max(row.at[1]), i);
  }
  return largest;
}

/// The same of the body at rest.
inline FrequencyBound frequency_bound(const Solid& solid, const Elements& elements, double stiffness) {
  Motion<1> body = at_rest<1>(solid);
  body.stiffness = stiffness;
  const SquaredBounds<1> bound = squared_frequency_bound(body, elements);
  return {std::sqrt(bound.omega2[0]), bound.node[0]};
}

}  // namespace ricochet
