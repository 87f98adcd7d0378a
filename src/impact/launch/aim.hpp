#pragma once
// Where the projectile starts so that it lands where it was aimed, and its rigid flight.

#include <optional>

#include "impact/launch/start.hpp"
#include "impact/scene.hpp"
#include "shape/placed_surface.hpp"

namespace ricochet {

/// The rigid flight of the projectile towards the target's surface.
class Flight {
 public:
  /// `shift`: of the target from where it is at rest [R]. Refers to the solids.
  Flight(const Solid& projectile, const Solid& target, const Vec2& shift);

  double radius() const { return radius_; }  ///< no surface node is farther from the projectile's centre
  /// No node of the projectile is faster. [c]
  double fastest(const Placement& placement) const;
  /// The smooth outlines just touch with the projectile's centre this high above its place at rest, at x = `at`; NaN if
  /// they pass beside each other.
  double resting_lift(double at) const;
  /// A height of the smooth outlines at which rough surfaces are `reach` apart. [R]
  double usual_height(double reach) const;
  /// Of the surfaces, with the projectile placed so. [R]
  double distance(const Placement& placement) const;
  /// A body that flies on like this and reaches so far from its centre comes no nearer any more.
  bool gone_past(const Placement& placement, double reach) const;
  /// The least time in which a node of the projectile can come by so much nearer. [R/c]
  double time_to_cover(const Placement& placement, double distance) const;
  /// Flies on until the surfaces are at most `reach` apart: false if it passes by. Throws FieldError if the flight is
  /// too shallow to find that.
  bool advance(Placement& placement, double reach) const;
  /// The least distance of the surfaces, or the first one found that is at most `enough` (above 0); in a flight almost
  /// parallel to the surface only as far as 100,000 advances go.
  double closest_approach(Placement placement, double enough) const;

 private:
  const Solid &projectile_, &target_;
  Vec2 shift_, centre_;
  Points rim_;
  PlacedSurface placed_target_;
  double radius_ = 0;
};

/// A placement upstream of the landing point launch.at, where the repulsion does not show. Throws FieldError if a given
/// height is too low for that; nothing if a body that flies along the surface never comes down.
std::optional<Placement> upstream(const Scene& scene, const Start& start, const Flight& flight, double lift,
                                  const Vec2& centre);

/// The least distance of the surfaces [R] on the straight flight from a start; see Flight.
double closest_approach(const Start& start, const Solids& solids, double enough);

}  // namespace ricochet
