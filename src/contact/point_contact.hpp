#pragma once
// The contact of two smooth bodies of revolution at a point of their common axis, quasi-static. [Hertz 1882; Johnson
// 1985, sections 4.2 and 11.4]

#include <limits>

#include "contact/quasi_static.hpp"

namespace ricochet {

/// One body at the contact.
struct PointBody {
  double modulus = std::numeric_limits<double>::infinity();  ///< E/(1 - nu^2); infinite: rigid [m0 c^2/R^3]
  double radius = std::numeric_limits<double>::infinity();   ///< of curvature; infinite: flat [R]
};

/// 1/E* and 1/R are the sums of the bodies' own: the two as one sphere on a rigid plane.
PointBody pressed_together(const PointBody& one, const PointBody& other);

/// The impact at that relative speed of a pair of that reduced mass: with F = (4/3) E* sqrt(R) delta^(3/2),
/// delta = (15 m v^2/(16 E* sqrt(R)))^(2/5), a = sqrt(R delta), p = 3 F/(2 pi a^2) and t = 2.9432752 delta/v. From
/// where the contact is as wide as half of R `in_range` is false. All arguments positive and finite.
QuasiStaticImpact point_impact(const PointBody& pair, double mass, double speed);

}  // namespace ricochet
