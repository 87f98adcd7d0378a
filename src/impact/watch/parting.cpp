#include "impact/watch/parting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/turn.hpp"
#include "impact/axes.hpp"

namespace ricochet {
namespace {

constexpr int most_parting_advances = 1000;

/// A body's surface about its centre, turning as a rigid body does.
class Turning {
 public:
  Turning(const Points& points, const Vec2& centre, double turning) : turning_(turning) {
    for (const Vec2& p : points) {
      arms_.push_back(p - centre);
      radius_ = std::max(radius_, arms_.back().norm());
    }
  }

  double radius() const { return radius_; }
  /// No point is faster.
  double fastest() const { return std::abs(turning_) * radius_; }
  /// The least n . arm after a time.
  double lowest(const Vec2& n, double time) const {
    const Turn turn(turning_ * time);
    double lowest = radius_;
    for (const Vec2& a : arms_) lowest = std::min(lowest, n.dot(turn(a)));
    return lowest;
  }

 private:
  Points arms_;
  double turning_, radius_ = 0;
};

// True if the one never comes down to the other along n, whose highest point is now at `level`. Their gap closes no
// faster than their points turn, so time can advance by the gap over that speed.
bool stays_clear(const PlacedSurface& one, const PlacedSurface& other, const RelativeFlight& flight, const Vec2& n,
                 double level) {
  const double speed = flight.velocity.dot(n), other_height = n.dot(flight.other_centre) - level;
  const bool other_turns = flight.other_turning != 0;
  const Turning above(one.points(), flight.centre, flight.turning),
      below(other_turns ? other.points() : Points{}, flight.other_centre, flight.other_turning);
  const double most_rise = other_turns ? other_height + below.radius() : 0, turning = above.fastest() + below.fastest();
  double time = 0;
  for (int advance = 0; advance < most_parting_advances; ++advance) {
    const double height = n.dot(flight.centre) + speed * time - level;
    if (height > above.radius() + most_rise) return true;
    const double rise = other_turns ? other_height - below.lowest(-n, time) : 0;
    const double gap = height + above.lowest(n, time) - rise;
    if (gap <= 0) return false;
    const double whole = above.radius() / speed;
    time += turning == 0 ? whole : std::min(gap / turning, whole);
  }
  return false;  // too close to tell: asked again at the next look
}

}  // namespace

bool clear_for_good(const PlacedSurface& one, const PlacedSurface& other, const RelativeFlight& flight) {
  const auto clear_along = [&](const Vec2& n) {
    if (flight.velocity.dot(n) <= 0) return false;
    const double highest = other.support(n);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec2& p : one.points()) lowest = std::min(lowest, n.dot(p));
    return lowest > highest && stays_clear(one, other, flight, n, highest);
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
