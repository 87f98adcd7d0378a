#include "impact/watch/parting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/turn.hpp"
#include "impact/axes.hpp"

namespace ricochet {
namespace {

constexpr int most_advances = 1000;

// True if the one never comes down to `level` along n. Its lowest point falls no faster than its turning times its
// radius, so time can advance by the gap over that speed.
bool stays_clear(const Points& points, const RelativeFlight& flight, const Vec2& n, double speed, double level) {
  Points arms;
  double radius = 0;
  for (const Vec2& p : points) {
    arms.push_back(p - flight.centre);
    radius = std::max(radius, arms.back().norm());
  }
  double time = 0;
  for (int advance = 0; advance < most_advances; ++advance) {
    const double height = n.dot(flight.centre) + speed * time - level;
    if (height > radius) return true;
    const Turn turn(flight.turning * time);
    double lowest = radius;
    for (const Vec2& a : arms) lowest = std::min(lowest, n.dot(turn(a)));
    if (height + lowest <= 0) return false;
    const double whole = radius / speed;
    time += flight.turning == 0 ? whole : std::min((height + lowest) / (std::abs(flight.turning) * radius), whole);
  }
  return false;  // too close to tell: asked again at the next look
}

}  // namespace

bool clear_for_good(const PlacedSurface& one, const PlacedSurface& other, const RelativeFlight& flight) {
  const auto clear_along = [&](const Vec2& n) {
    const double speed = flight.velocity.dot(n);
    if (speed <= 0) return false;
    const double highest = other.support(n);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec2& p : one.points()) lowest = std::min(lowest, n.dot(p));
    return lowest > highest && stays_clear(one.points(), flight, n, speed, highest);
  };
  return clear_along(upwards()) || clear_along((flight.centre - flight.other_centre).normalized());
}

std::optional<Intruder> inside_one_another(const PlacedSurface& first, const PlacedSurface& second, bool two_sided,
                                           double gap) {
  if (second.plane()) return std::nullopt;
  for (std::size_t k = 0; k < first.points().size(); ++k)
    if (second.contains(first.points()[k])) return Intruder{0, k, 0};
  for (std::size_t k = 0; k < second.points().size(); ++k)
    if (first.contains(second.points()[k])) {
      const double depth = first.distance(second.points()[k], std::numeric_limits<double>::infinity());
      if (two_sided || depth > gap) return Intruder{1, k, depth};
    }
  return std::nullopt;
}

double deepest_inside(const PlacedSurface& first, const PlacedSurface& second) {
  double deepest = 0;
  for (const Vec2& p : first.points()) deepest = std::max(deepest, second.depth(p));
  for (const Vec2& p : second.points()) deepest = std::max(deepest, first.depth(p));
  return deepest;
}

}  // namespace ricochet
