#pragma once
#include "body/interior.hpp"
#include "contact/pair.hpp"

namespace ricochet {

/// The node where a lane ceased to be finite. A node that is not finite takes its neighbours along in the same
/// evaluation, so the one with the most of them is where it began.
template <int W>
BodyNode where_it_broke(const Motions<W>& bodies, int lane) {
  BodyNode where;
  int most = -1;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Motion<W>& body = bodies[b];
    const Solid& solid = *body.solid;
    const auto lost = [&](int i) { return i < solid.free && !(body.q.at(i, lane) + body.v.at(i, lane)).allFinite(); };
    std::vector<int> neighbours(static_cast<std::size_t>(solid.nodes()));
    each_joint(solid, [&](int i, int j) {
      neighbours[static_cast<std::size_t>(i)] += lost(j);
      neighbours[static_cast<std::size_t>(j)] += lost(i);
    });
    for (int i = 0; i < solid.free; ++i)
      if (lost(i) && neighbours[static_cast<std::size_t>(i)] > most) {
        most = neighbours[static_cast<std::size_t>(i)];
        where = {static_cast<int>(b), i};
      }
  }
  return where;
}

}  // namespace ricochet
