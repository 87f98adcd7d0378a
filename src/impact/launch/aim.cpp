#include "impact/launch/aim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

// Of a flight towards the target: each closes most of the gap unless the flight is almost parallel to the surface.
constexpr int most_advances = 100000;

struct Circle {
  Vec2 centre;
  double radius;
};

Circle circle_around(const Points& points) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {(low + high) / 2, (high - low).norm() / 2};
}

Points shifted(Points points, const Vec2& by) {
  for (Vec2& p : points) p += by;
  return points;
}

double farthest_apart(const Points& a, const Points& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

}  // namespace

Flight::Flight(const Solid& projectile, const Solid& target, const Vec2& shift, double target_spin)
    : projectile_(projectile),
      target_(target),
      shift_(shift),
      centre_(projectile.centre()),
      target_spin_(target_spin),
      rim_(surface_points(projectile)),
      placed_target_(target.surface, shifted(surface_points(target), shift)) {
  for (const Vec2& p : rim_) radius_ = std::max(radius_, (p - centre_).norm());
  const Vec2 target_centre = target.centre();
  for (const Vec2& p : placed_target_.points()) target_radius_ = std::max(target_radius_, (p - target_centre).norm());
}

double Flight::fastest(const Placement& placement) const {
  return in_plane(placement.velocity).stableNorm() + std::abs(placement.spin.z()) * radius_ +
         std::abs(target_spin_) * target_radius_;
}

std::array<double, 2> Flight::landing_range() const {
  if (placed_target_.plane())
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const Box own = bounding_box(projectile_.smooth), other = bounding_box(target_.smooth);
  return {other.low.x() - (own.high.x() - centre_.x()), other.high.x() - (own.low.x() - centre_.x())};
}

double Flight::resting_lift(double at) const {
  const auto [first, last] = landing_range();
  const double rounding = 1e-12 * (last - first);
  if (at <= first + rounding || at >= last - rounding) return not_given;  // alike at both edges
  Points smooth = projectile_.smooth;
  for (Vec2& p : smooth) p.x() += at - centre_.x();
  const PlacedSurface above(projectile_.surface, smooth), below(target_.surface, target_.smooth);
  double lift = not_given;
  const auto consider = [&](double x) {
    const double bottom = above.height(x, false), top = below.height(x, true);
    if (!std::isnan(bottom) && !std::isnan(top) && !(top - bottom <= lift)) lift = top - bottom;
  };
  for (const Vec2& p : smooth) consider(p.x());
  for (const Vec2& p : target_.smooth) consider(p.x());
  return lift;
}

double Flight::usual_height(double reach) const {
  // A shifted target's displacement is included.
  return reach + farthest_apart(rim_, projectile_.smooth) + farthest_apart(placed_target_.points(), target_.smooth);
}

double Flight::distance(const Placement& placement) const {
  const PlacedSurface projectile(projectile_.surface, placed(rim_, centre_, placement));
  if (target_spin_ == 0) return distance_of(projectile, placed_target_);
  Placement turned = placed_at_rest(target_);
  turned.turn = Turn(target_spin_ * placement.time);
  return distance_of(projectile,
                     PlacedSurface(target_.surface, placed(placed_target_.points(), target_.centre(), turned)));
}

bool Flight::gone_past(const Placement& placement, double reach) const {
  const Vec2 velocity = in_plane(placement.velocity), centre = in_plane(placement.centre);
  const Vec2 acceleration = in_plane(placement.acceleration);
  if (const Plane* plane = placed_target_.plane())
    return in_plane(plane->normal).dot(velocity) >= 0 && in_plane(plane->normal).dot(acceleration) >= 0 &&
           in_plane(plane->normal).dot(centre) - plane->offset > radius_ + reach;
  const Circle around =
      target_spin_ == 0 ? circle_around(placed_target_.points()) : Circle{target_.centre(), target_radius_};
  const Vec2 offset = centre - around.centre;
  return offset.dot(velocity) >= 0 && offset.dot(acceleration) >= 0 &&
         offset.norm() > around.radius + (radius_ + reach);
}

// s t + a t^2 / 2 = distance, written without a difference.
double Flight::time_to_cover(const Placement& placement, double distance) const {
  const double speed = fastest(placement), growth = placement.acceleration.norm();
  return growth == 0 ? distance / speed : 2 * distance / (speed + std::sqrt(speed * speed + 2 * growth * distance));
}

bool Flight::advance(Placement& placement, double reach) const {
  double apart = distance(placement);
  for (int advance = 0; apart > reach; ++advance) {
    if (advance == most_advances)
      throw FieldError("launch",
                       fmt::format("the flight is too shallow to find the first touch (normal speed {:g} c of {:g} c)",
                                   -placement.velocity.y(), in_plane(placement.velocity).stableNorm()));
    placement = flown(placement, time_to_cover(placement, std::max(apart - reach, 1e-3 * reach)));
    if (gone_past(placement, reach)) return false;
    apart = distance(placement);
  }
  return true;
}

double Flight::closest_approach(Placement placement, double enough) const {
  const double fastest_node = fastest(placement);
  double least = std::numeric_limits<double>::infinity();
  for (int advance = 0; advance < most_advances; ++advance) {
    const double apart = distance(placement);
    least = std::min(least, apart);
    if (least <= enough || gone_past(placement, 0)) break;
    placement = flown(placement, std::max(apart - enough, 0.05 * enough) / fastest_node);
  }
  return least;
}

Placement seen_by_target(const Start& start) {
  Placement seen = start.bodies[0];
  seen.velocity -= start.bodies[1].velocity;
  return seen;
}

namespace {

/// The launch along the line of flight, by its height above touching.
class Line {
 public:
  Line(const Scene& scene, const Start& start, const Flight& flight, double lift, const Vec2& centre)
      : scene_(scene), start_(start), flight_(flight), lift_(lift), centre_(centre) {}

  Placement at(double above) const {
    Placement placement = seen_by_target(start_);
    const Vec3& v = placement.velocity;
    const double ahead = ahead_of_landing(above);
    placement.centre = Vec3(scene_.launch.at - v.x() * ahead, centre_.y() + lift_ + above, 0);
    return placement;
  }
  double distance(double above) const { return flight_.distance(at(above)); }
  bool too_near(double apart) const {
    return scene_.contact.V0 * std::exp(-scene_.contact.xi * apart) > touch_share * energy();
  }
  // How far apart the surfaces must be.
  double needed() const { return std::log(scene_.contact.V0 / (touch_share * energy())) / scene_.contact.xi; }

 private:
  // How long it flies from so high.
  double ahead_of_landing(double above) const {
    const Placement launched = seen_by_target(start_);
    const double speed = -launched.velocity.y(), growth = -launched.acceleration.y();
    if (growth > 0 && above > 0) return 2 * above / (speed + std::sqrt(speed * speed + 2 * growth * above));
    return speed > 0 ? above / speed : 0.0;
  }
  double energy() const { return std::max(start_.energy, 1e-300); }

  const Scene& scene_;
  const Start& start_;
  const Flight& flight_;
  double lift_;
  Vec2 centre_;
};

// A height that works, found as if none were given, and the least one below it.
double least_height(const Line& line, double low, double high) {
  const auto works = [&](double above) { return !line.too_near(line.distance(above)); };
  while (!works(high) && high < 1e3) {
    low = high;
    high *= 2;
  }
  while (high - low > 1e-3 * high) {
    const double middle = (low + high) / 2;
    (works(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

std::optional<Placement> upstream(const Scene& scene, const Start& start, const Flight& flight, double lift,
                                  const Vec2& centre) {
  const Line line(scene, start, flight, lift, centre);
  const double reach = start.contact.reach, usual = flight.usual_height(reach);
  const bool given = !std::isnan(scene.launch.height);
  const double height = given ? scene.launch.height : usual;
  if (seen_by_target(start).velocity.y() >= 0 && !given) return std::nullopt;
  double above = height, distance = line.distance(above);
  // Where the outlines slope, a height is less of a distance: go higher until the rims are apart.
  for (double higher = 2 * height; !given && distance < reach && higher < 1e3 * height; higher *= 2) {
    above = higher;
    distance = line.distance(above);
  }
  if (line.too_near(distance))
    throw FieldError("height", fmt::format("the bodies overlap at the start (rims {:.3g} R apart, {:.3g} R needed); "
                                           "raise launch.height to {:.3g} R or more, or leave it out",
                                           distance, line.needed(), 1.01 * least_height(line, height, usual)));
  return line.at(above);
}

double closest_approach(const Start& start, const Solids& solids, double enough) {
  const Flight flight(*solids[0], *solids[1], Vec2::Zero(), start.bodies[1].spin.z());
  return flight.closest_approach(seen_by_target(start), enough);
}

}  // namespace ricochet
