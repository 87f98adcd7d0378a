#include "shape/hull.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace ricochet {

// The lower chain from left to right, then the upper one back. [Andrew 1979, Inf. Process. Lett. 9, 216]
std::vector<std::size_t> convex_hull(const Points& points) {
  std::vector<std::size_t> order(points.size()), hull;
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return std::array{points[i].x(), points[i].y()}; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  const auto turns_left = [&](std::size_t a, std::size_t b, std::size_t c) {
    const Vec2 before = points[b] - points[a], after = points[c] - points[b];
    return before.x() * after.y() - before.y() * after.x() > 1e-12 * before.norm() * after.norm();
  };
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t begin = hull.size();
    for (auto i = first; i != last; ++i) {
      while (hull.size() >= begin + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *i)) hull.pop_back();
      hull.push_back(*i);
    }
    hull.pop_back();  // the next chain begins there
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  return hull;
}

}  // namespace ricochet
