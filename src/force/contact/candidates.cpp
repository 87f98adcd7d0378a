#include "force/contact/candidates.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "lattice/outline.hpp"

namespace ricochet {
namespace {

struct Box {
  Vec2 low, high;
};

Box box_of(const Points& points) {
  Box box{points[0], points[0]};
  for (const Vec2& p : points) box.low = box.low.cwiseMin(p), box.high = box.high.cwiseMax(p);
  return box;
}

}  // namespace

std::vector<Pair> pairs_within(const Points& nodes, const Points& rim, double distance) {
  // Segments by their left end: for each node only those whose x range comes near are looked at.
  struct Extent {
    double left, right;
    int segment;
  };
  const int n = static_cast<int>(rim.size());
  const Box box = box_of(nodes);
  std::vector<Extent> extents;
  double longest = 0;
  for (int s = 0; s < n; ++s) {
    const Vec2 &a = rim[s], &b = rim[(s + 1) % n];
    const double left = std::min(a.x(), b.x()), right = std::max(a.x(), b.x());
    const double bottom = std::min(a.y(), b.y()), top = std::max(a.y(), b.y());
    if (left > box.high.x() + distance || right < box.low.x() - distance || bottom > box.high.y() + distance || top < box.low.y() - distance)
      continue;
    extents.push_back({left, right, s});
    longest = std::max(longest, right - left);
  }
  // A rim that has blown up has no neighbours; its impact is ended by its ledger.
  std::erase_if(extents, [](const Extent& e) { return std::isnan(e.left) || std::isnan(e.right); });
  std::sort(extents.begin(), extents.end(), [](const Extent& a, const Extent& b) { return std::pair(a.left, a.segment) < std::pair(b.left, b.segment); });
  std::vector<Pair> pairs;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    const double x = nodes[i].x();
    const std::size_t before = pairs.size();
    auto e = std::lower_bound(extents.begin(), extents.end(), x - distance - longest, [](const Extent& a, double value) { return a.left < value; });
    for (; e != extents.end() && e->left <= x + distance; ++e)
      if (e->right >= x - distance && closest(nodes[i], rim[e->segment], rim[(e->segment + 1) % n]).distance <= distance)
        pairs.push_back({i, e->segment});
    std::sort(pairs.begin() + before, pairs.end(), [](const Pair& a, const Pair& b) { return a.segment < b.segment; });
  }
  return pairs;
}

double box_distance(const Points& a, const Points& b) {
  const Box p = box_of(a), q = box_of(b);
  const Vec2 gap = (q.low - p.high).cwiseMax(p.low - q.high).cwiseMax(0.0);
  return gap.norm();
}

double chain_distance(const Points& a, const Points& b) {
  if (outlines_overlap(a, b)) return 0;
  double least = std::numeric_limits<double>::infinity();
  const auto one_way = [&](const Points& nodes, const Points& rim) {
    double longest = 0;
    for (std::size_t s = 0; s < rim.size(); ++s) longest = std::max(longest, (rim[(s + 1) % rim.size()] - rim[s]).norm());
    for (const Vec2& p : nodes)
      for (std::size_t s = 0; s < rim.size(); ++s) {
        const double skip = least + longest;  // a segment whose start is farther than this is no nearer
        if (std::abs(p.y() - rim[s].y()) > skip || std::abs(p.x() - rim[s].x()) > skip) continue;
        least = std::min(least, closest(p, rim[s], rim[(s + 1) % rim.size()]).distance);
      }
  };
  one_way(a, b), one_way(b, a);
  return least;
}

}  // namespace ricochet
