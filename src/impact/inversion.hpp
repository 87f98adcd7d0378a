#pragma once
#include "force/lane.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

/// The share of a body's area that lies in triangles turned over since they were at rest, in W lanes. A body of springs
/// resists no such fold; one that folded by more than slivers is no elastic solid any more.
template <int W>
Lane<W> inverted_share(const Moving<W>& body) {
  const Lattice& lattice = *body.lattice;
  double all = 0;
  Lane<W> inverted = Lane<W>::Zero();
  for (const Triangle& t : lattice.triangles) {
    const int a = t[0], b = t[1], c = t[2];
    const double at_rest = cross(lattice.points[b] - lattice.points[a], lattice.points[c] - lattice.points[a]);
    const NodeVectors<W>& p = body.position;
    const Lane<W> now = (p.x(b) - p.x(a)) * (p.y(c) - p.y(a)) - (p.y(b) - p.y(a)) * (p.x(c) - p.x(a));
    all += std::abs(at_rest);
    inverted += (now * at_rest < 0).select(Lane<W>::Constant(std::abs(at_rest)), Lane<W>::Zero());
  }
  return all > 0 ? Lane<W>(inverted / all) : inverted;
}

}  // namespace ricochet
