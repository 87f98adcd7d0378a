#pragma once
// The contact of two smooth bodies along a line, quasi-static: what force, depth and time an impact is to expect. In
// closed form but for one quadrature, so that a launch may ask it. Plane moduli: E2 and nu2 are E and nu in plane
// stress, E/(1 - nu^2) and nu/(1 - nu) in plane strain; forces and masses are per unit of thickness. [Johnson 1985,
// section 5.6; the joining of two bodies, and what lies beyond its range: here]

#include <limits>

#include "contact/quasi_static.hpp"

namespace ricochet {

/// One body at the contact.
struct LineBody {
  double modulus = std::numeric_limits<double>::infinity();  ///< E2; infinite: rigid [m0 c^2/R^2]
  double radius = std::numeric_limits<double>::infinity();   ///< of curvature; infinite: flat [R]
  double length = 1;  ///< pressed by F over 2a it gives way by F/(pi E2) (2 ln(length/a) - 1) [R]

  /// A disk: length = 4 radius. [Johnson 1985, section 5.6]
  static LineBody disk(double modulus, double radius) { return {modulus, radius, 4 * radius}; }
  /// A block held at that depth: 2 ln(2 depth/a) - nu2 = 2 ln(length/a) - 1. [Johnson 1985, section 5.6]
  static LineBody block(double modulus, double poisson_ratio, double depth);
  static LineBody rigid_plane() { return {}; }
};

/// Two bodies as one on a rigid plane: a^2 = 4 F radius/(pi modulus), and they approach by
/// F/(pi modulus) (2 ln(length/a) - 1).
struct LinePair {
  double modulus, radius, length;
};

/// 1/E = 1/E_1 + 1/E_2, 1/R = 1/R_1 + 1/R_2, and ln L is the mean of ln L_i weighted by 1/E_i. Two rigid or two flat
/// bodies give an infinite modulus or radius.
LinePair pressed_together(const LineBody& one, const LineBody& other);

/// The impact at that relative normal speed of a pair of that reduced mass. From where the contact would be as wide as
/// the bodies (a = radius, or a = length/4 in a thin one) it goes on with the stiffness that it has there, `in_range`
/// is false, and the numbers give no more than the order of magnitude. p = 2 F/(pi a). All arguments positive and
/// finite.
QuasiStaticImpact line_impact(const LinePair& pair, double mass, double speed);

}  // namespace ricochet
