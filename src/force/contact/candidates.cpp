#include "force/contact/candidates.hpp"

#include <algorithm>
#include <limits>

#include "lattice/outline.hpp"

namespace ricochet {
namespace {

struct Box {
  Vec2 low, high;
};

Box box_of(const Points& points) {
  Box box{points[0], points[0]};
  for (const Vec2& p : points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

}  // namespace

std::vector<Pair> pairs_within(const Points& nodes, const Points& rim, double distance) {
  const ChainTree tree(rim);
  std::vector<Pair> pairs;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    const Vec2& p = nodes[static_cast<std::size_t>(i)];
    tree.search(
        [&](const Vec2& low, const Vec2& high) {
          return p.x() >= low.x() - distance && p.x() <= high.x() + distance && p.y() >= low.y() - distance &&
                 p.y() <= high.y() + distance;
        },
        [&](std::size_t s) {
          if (closest(p, tree.from(s), tree.to(s)).distance <= distance) pairs.push_back({i, static_cast<int>(s)});
        });
  }
  return pairs;
}

double box_distance(const Points& a, const Points& b) {
  const Box p = box_of(a), q = box_of(b);
  const Vec2 gap = (q.low - p.high).cwiseMax(p.low - q.high).cwiseMax(0.0);
  return gap.norm();
}

double distance_from(const ChainTree& chain, const Vec2& p, double least) {
  return chain.nearest(p, least, [&](std::size_t s) { return closest(p, chain.from(s), chain.to(s)).distance; });
}

double chain_distance(const Points& a, const Points& b) {
  const ChainTree of_a(a), of_b(b);
  if (outlines_overlap(of_a, of_b)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& p : a) least = distance_from(of_b, p, least);
  for (const Vec2& p : b) least = distance_from(of_a, p, least);
  return least;
}

}  // namespace ricochet
