#include "shape/curvature.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace ricochet {
namespace {

double turn_between(const Vec2& before, const Vec2& after) {
  return std::atan2(cross(before, after), before.dot(after));
}

// Of the edge that comes nearest to the point.
Vec2 nearest_normal(const Points& outline, const Vec2& point) {
  double least = std::numeric_limits<double>::infinity();
  Vec2 normal(0, 1);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], edge = outline[(i + 1) % outline.size()] - a;
    const double along = std::clamp((point - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const double distance = (a + along * edge - point).norm();
    if (distance >= least) continue;
    least = distance;
    normal = Vec2(edge.y(), -edge.x()).normalized();
  }
  return normal;
}

}  // namespace

OutlineAt outline_at(const Points& outline, const Vec2& point, double reach) {
  constexpr double most_smooth = std::numbers::pi / 6;
  OutlineAt at;
  double arc = 0, turn = 0;
  Vec2 normals = Vec2::Zero();
  for (std::size_t i = 0, n = outline.size(); i < n; ++i) {
    if ((outline[i] - point).norm() > reach) continue;
    const Vec2 before = outline[i] - outline[(i + n - 1) % n], after = outline[(i + 1) % n] - outline[i];
    const double here = turn_between(before, after);
    at.corner = at.corner || std::abs(here) > most_smooth;
    turn += here;
    arc += (before.norm() + after.norm()) / 2;
    const Vec2 along = before.normalized() + after.normalized();
    if ((outline[i] - point).norm() < 1e-9 * reach) normals = Vec2(along.y(), -along.x());
  }
  at.normal = normals.norm() > 0 ? Vec2(normals.normalized()) : nearest_normal(outline, point);
  constexpr double rounding = 1e-9;
  at.radius = std::abs(turn) > rounding ? arc / turn : std::numeric_limits<double>::infinity();
  return at;
}

Figure figure_of(const Points& outline) {
  const Vec2 origin = outline.front();
  double area = 0, moment = 0;
  Vec2 first = Vec2::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - origin, b = outline[(i + 1) % outline.size()] - origin;
    const double twice = cross(a, b);
    area += twice / 2;
    first += twice / 6 * (a + b);
    moment += twice / 12 * (a.dot(a) + a.dot(b) + b.dot(b));
  }
  const Vec2 centre = first / area;
  return {origin + centre, area, moment - area * centre.squaredNorm()};
}

}  // namespace ricochet
