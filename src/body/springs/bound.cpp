#include "body/springs/bound.hpp"

namespace ricochet {
namespace {

// [node] the sum over its springs, at rest.
std::vector<NodeBlock<1>> blocks_of(const Solid& solid, const Springs& springs) {
  std::vector<NodeBlock<1>> blocks(static_cast<std::size_t>(solid.nodes()));
  const Linear law;  // what a higher term adds at rest is far below the bound's own slack
  each_spring(springs, solid.free, [&](int i, int, const Spring& spring) {
    const Vec2 d = solid.points[static_cast<std::size_t>(spring.other)] - solid.points[static_cast<std::size_t>(i)];
    const double r = d.norm(), x = r - spring.length;  // not 0 under prestress
    Place<1, 2> n;
    for (int k = 0; k < 2; ++k) n.at[k][0] = d[k] / r;
    const Lane<1> along = Lane<1>::Constant(spring.stiffness * law.tangent(x)),
                  across = Lane<1>::Constant(spring.stiffness * std::abs(law.tension(x)) / r);
    for (const int node : {i, spring.other}) blocks[static_cast<std::size_t>(node)].add(n, along, across);
  });
  return blocks;
}

}  // namespace

FrequencyBound frequency_bound(const Solid& solid, const Springs& springs, double stiffness) {
  const std::vector<NodeBlock<1>> blocks = blocks_of(solid, springs);
  FrequencyBound bound;
  for (int i = 0; i < solid.free; ++i) {
    const NodeBlock<1>& b = blocks[static_cast<std::size_t>(i)];
    const double xx = b.xx[0], xy = b.xy[0], yy = b.yy[0];
    const double eigenvalue = (xx + yy) / 2 + std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
    const double omega = std::sqrt(2 * stiffness * eigenvalue / solid.mass[i]);
    if (omega > bound.omega) bound = {omega, i};
  }
  return bound;
}

}  // namespace ricochet
