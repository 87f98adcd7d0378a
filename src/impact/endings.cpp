#include "impact/endings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/turn.hpp"
#include "force/contact/candidates.hpp"
#include "lattice/outline.hpp"

namespace ricochet {
namespace {

// True if the projectile never comes down to `level` along n. Its lowest point falls no faster than spin times radius,
// so time can advance by the gap over that speed.
bool stays_clear(const Points& projectile, const Flight& flight, const Vec2& n, double speed, double level) {
  Points arms;
  double radius = 0;
  for (const Vec2& p : projectile) {
    arms.push_back(p - flight.centre);
    radius = std::max(radius, arms.back().norm());
  }
  double time = 0;
  for (int advance = 0; advance < 1000; ++advance) {
    const double height = n.dot(flight.centre) + speed * time - level;
    if (height > radius) return true;
    const double c = std::cos(flight.spin * time), s = std::sin(flight.spin * time);
    double lowest = radius;
    for (const Vec2& a : arms) lowest = std::min(lowest, n.dot(turned(a, c, s)));
    if (height + lowest <= 0) return false;
    time += flight.spin == 0 ? radius / speed
                             : std::min((height + lowest) / (std::abs(flight.spin) * radius), radius / speed);
  }
  return false;  // too close to tell: asked again at the next look
}

}  // namespace

bool clear_for_good(const Points& projectile, const Points& target, const Flight& flight) {
  const auto clear_along = [&](const Vec2& n) {
    const double speed = flight.velocity.dot(n);
    if (speed <= 0) return false;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Vec2& p : projectile) lowest = std::min(lowest, n.dot(p));
    for (const Vec2& p : target) highest = std::max(highest, n.dot(p));
    return lowest > highest && stays_clear(projectile, flight, n, speed, highest);
  };
  return clear_along(Vec2(0, 1)) || clear_along((flight.centre - flight.target_centre).normalized());
}

std::optional<Intruder> inside_one_another(const Points& projectile, const Points& target, bool two_sided, double gap) {
  const ChainTree upper(projectile), lower(target);
  for (std::size_t k = 0; k < projectile.size(); ++k)
    if (contains(lower, projectile[k])) return Intruder{0, k, 0};
  for (std::size_t k = 0; k < target.size(); ++k)
    if (contains(upper, target[k])) {
      const double depth = distance_from(upper, target[k], std::numeric_limits<double>::infinity());
      if (two_sided || depth > gap) return Intruder{1, k, depth};
    }
  return std::nullopt;
}

}  // namespace ricochet
