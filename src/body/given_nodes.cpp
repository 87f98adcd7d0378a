#include "body/given_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "shape/closest.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

// A point this share of the nodes' spacing from the rim lies on it: a curve is given as a polygon.
constexpr double on_rim_share = 1e-3;

std::string described(const Points& points, std::size_t i) {
  return fmt::format("point {} at ({:g}, {:g})", i + 1, points[i].x(), points[i].y());
}

void refuse_doubles(const Points& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return std::array{points[i].x(), points[i].y()}; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (key(order[k - 1]) == key(order[k]))
      throw FieldError(
          "points", fmt::format("{} is point {} again; leave one out", described(points, order[k]), order[k - 1] + 1));
}

/// A point on a chain: at which of its edges, and where along it.
struct OnChain {
  std::size_t edge;
  double along;
  Vec2 point;
};

// Nothing if it is farther than `tolerance` from the chain.
std::optional<OnChain> found_on(const CellTree& chain, const Vec2& p, double tolerance) {
  std::optional<OnChain> found;
  double least = tolerance;
  chain.search(
      [&](const Vec2& low, const Vec2& high) {
        return (p.array() >= low.array() - tolerance).all() && (p.array() <= high.array() + tolerance).all();
      },
      [&](std::size_t edge) {
        const Closest c = closest(p, chain.from(edge), chain.to(edge));
        if (c.distance > least) return;
        least = c.distance;
        found = {edge, c.along, p};
      });
  return found;
}

// Without a node at a corner the rim would cut it off.
void check_corners(const Points& chain, const Points& nodes, double tolerance) {
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const auto at_corner = [&](const Vec2& p) { return (p - chain[i]).norm() <= tolerance; };
    if (is_corner(chain, i) && std::none_of(nodes.begin(), nodes.end(), at_corner))
      throw FieldError("points", fmt::format("some lie on the outline, but none at its corner ({:g}, {:g}); give one "
                                             "there, or none on the outline",
                                             chain[i].x(), chain[i].y()));
  }
}

}  // namespace

GivenNodes given_nodes(const Points& points, const std::vector<Points>& chains) {
  refuse_doubles(points);
  double area = 0;
  Rim whole;
  for (const Points& chain : chains) {
    area += signed_area(chain);
    whole.add(chain);
  }
  const double tolerance = on_rim_share * std::sqrt(area / static_cast<double>(points.size()));
  const CellTree tree(whole.points, whole.cells);
  std::vector<OnChain> on_rim;
  GivenNodes given;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const auto found = found_on(tree, points[i], tolerance))
      on_rim.push_back(*found);
    else if (inside(tree, points[i]))
      given.inside.push_back(points[i]);
    else
      throw FieldError("points", described(points, i) + " lies outside of the body; leave it out, or move it");
  }
  std::stable_sort(on_rim.begin(), on_rim.end(), [](const OnChain& a, const OnChain& b) {
    return std::pair(a.edge, a.along) < std::pair(b.edge, b.along);
  });
  auto next = on_rim.begin();
  std::size_t end = 0;  // of the chain's edges among all
  for (const Points& chain : chains) {
    Points& nodes = given.on_chain.emplace_back();
    for (end += chain.size(); next != on_rim.end() && next->edge < end; ++next) nodes.push_back(next->point);
    if (!nodes.empty()) check_corners(chain, nodes, tolerance);
  }
  return given;
}

}  // namespace ricochet
