#include "impact/watch/smooth_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ricochet {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Radii of a circle's outline agree to this share.
constexpr double round_share = 0.01;

bool is_smooth(const Solid& solid, const Mesh<2>& mesh) {
  for (std::size_t i = 0; i < mesh.node.size(); ++i)
    if (solid.smooth[i] != solid.points[at(mesh.node[i])]) return false;
  return true;
}

// A side that turns by less from the one before goes on straight, but for rounding.
constexpr double least_turn = 1e-9;

// The slopes of a rim as the other body feels them, where the point of touch moves along it.
double slope_of(const Facing& facing, double xi) {
  if (std::isinf(facing.side)) return 0;
  const double bend = facing.curvature == Facing::corner ? 0 : std::abs(facing.curvature);
  return bend * facing.side / std::sqrt(12.0) + 2 * std::numbers::ln2 / (xi * facing.side);
}

}  // namespace

SmoothOutline::SmoothOutline(const Solid& solid) {
  if (const auto* plane = std::get_if<Plane>(&solid.surface)) {
    plane_ = in_plane(plane->normal);
    return;
  }
  nodes_.resize(at(solid.nodes()));
  face_cells(solid, std::get<Mesh<2>>(solid.surface));
  round_ = is_round(solid);
}

// Every cell faces away from its left; a node that is no corner faces between its cells, and is curved by the turn from
// the one to the other.
void SmoothOutline::face_cells(const Solid& solid, const Mesh<2>& mesh) {
  std::vector<double> length(nodes_.size(), 0);  // of both cells of a node
  std::vector<int> cells(nodes_.size(), 0);
  for (const auto& [a, b] : mesh.cell) {
    const Vec2 edge = solid.smooth[at(b)] - solid.smooth[at(a)];
    const Vec2 normal = -perpendicular(edge) / edge.norm();
    Sides &from = nodes_[at(mesh.node[at(a)])], &to = nodes_[at(mesh.node[at(b)])];
    from.after.normal = to.before.normal = normal;
    for (const int end : {a, b}) {
      length[at(mesh.node[at(end)])] += edge.norm();
      ++cells[at(mesh.node[at(end)])];
    }
  }
  const bool smooth = is_smooth(solid, mesh);
  std::vector<bool> corner(nodes_.size(), false);
  for (const int place : solid.corners) corner[at(mesh.node[at(place)])] = true;
  for (const int node : mesh.node) {
    Sides& sides = nodes_[at(node)];
    if (smooth) sides.own.side = sides.before.side = sides.after.side = length[at(node)] / cells[at(node)];
    if (cells[at(node)] != 2) {  // an end of an open chain
      const Vec2 only = sides.before.normal + sides.after.normal;
      sides.own.normal = sides.before.normal = sides.after.normal = only;
      continue;
    }
    const Vec2 &before = sides.before.normal, &after = sides.after.normal;
    sides.own.normal = (before + after).normalized();
    if (corner[at(node)]) {
      sides.own.curvature = Facing::corner;
      continue;
    }
    const double turn = std::atan2(cross(before, after), before.dot(after));
    const double curvature = std::abs(turn) < least_turn ? 0 : turn / (length[at(node)] / 2);
    sides.own.curvature = sides.before.curvature = sides.after.curvature = curvature;
    sides.before.normal = sides.after.normal = sides.own.normal;
  }
}

bool SmoothOutline::is_round(const Solid& solid) const {
  if (!solid.corners.empty() || solid.smooth.size() < 3) return false;
  const auto chains = chains_of(std::get<Mesh<2>>(solid.surface).cell);
  if (chains.size() != 1 || !chains.front().closed) return false;
  Vec2 centre = Vec2::Zero();
  for (const Vec2& p : solid.smooth) centre += p / static_cast<double>(solid.smooth.size());
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Vec2& p : solid.smooth) {
    least = std::min(least, (p - centre).norm());
    most = std::max(most, (p - centre).norm());
  }
  return most - least < round_share * most;
}

Facing SmoothOutline::at_cell(const Push& push) const {
  if (push.plane) return {plane_, 0};
  const Sides &a = nodes_[at(push.cell[0])], &b = nodes_[at(push.cell[1])];
  if (push.along == 0) return a.own;
  if (push.along == 1) return b.own;
  const Vec2 normal = (1 - push.along) * a.after.normal + push.along * b.before.normal;
  return {normal.normalized(), (1 - push.along) * a.after.curvature + push.along * b.before.curvature,
          (1 - push.along) * a.after.side + push.along * b.before.side};
}

Vec2 normal_between(const Facing& projectile, const Facing& target) {
  const double p = std::max(0.0, projectile.curvature), t = std::max(0.0, target.curvature);
  if (p == Facing::corner && t == Facing::corner) return (target.normal - projectile.normal).normalized();
  if (p == Facing::corner || t == 0) return target.normal;
  if (t == Facing::corner) return -projectile.normal;
  return (p * target.normal - t * projectile.normal).normalized();
}

Unevenness unevenness_between(const Facing& projectile, const Facing& target, double xi) {
  const double k = std::max(0.0, projectile.curvature), other = std::max(0.0, target.curvature);
  const double slope = slope_of(projectile, xi), other_slope = slope_of(target, xi);
  if (k == other && (k == 0 || k == Facing::corner)) return {slope + other_slope, 0};
  if (k == Facing::corner) return {other_slope, 0};
  if (other == Facing::corner) return {slope, 0};
  return {(other * slope + k * other_slope) / (k + other), (slope + other_slope) / (k + other)};
}

}  // namespace ricochet
