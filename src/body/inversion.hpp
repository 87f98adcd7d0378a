#pragma once
#include "body/motion.hpp"

namespace ricochet {

/// The share of a body's area that lies in cells turned over since they were at rest, in W lanes. A body of springs
/// resists no such fold; one that folded by more than slivers is no elastic solid any more.
template <int W>
Lane<W> inverted_share(const Motion<W>& body) {
  const Solid& solid = *body.solid;
  double all = 0;
  Lane<W> inverted = Lane<W>::Zero();
  const Place<W, 2>* position = body.q.template places<2>();
  const auto rest = [&](int node) { return solid.points[static_cast<std::size_t>(node)]; };
  for (const Triangle& t : solid.cells) {
    const double at_rest = cross(rest(t[1]) - rest(t[0]), rest(t[2]) - rest(t[0]));
    const Place<W, 2> b = position[t[1]] - position[t[0]], c = position[t[2]] - position[t[0]];
    const Lane<W> now = b.at[0] * c.at[1] - b.at[1] * c.at[0];
    all += std::abs(at_rest);
    inverted += (now * at_rest < 0).select(Lane<W>::Constant(std::abs(at_rest)), Lane<W>::Zero());
  }
  return all > 0 ? Lane<W>(inverted / all) : inverted;
}

}  // namespace ricochet
