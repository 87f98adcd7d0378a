#pragma once
// Impacts that are far beyond yielding: the pressure is the same all over the contact, and the bodies flow as far as it
// takes to spend the energy on it.

#include "contact/line_contact.hpp"
#include "contact/point_contact.hpp"

namespace ricochet {

/// The pressure at which a metal of that yield stress flows under a blunt body, of Tabor. [Johnson 1985, section 6.3]
inline double flow_pressure(double yield) { return 3 * yield; }

/// At the greatest compression, as of a round body that is pressed flat to a^2 = 2 R delta.
struct PlasticImpact {
  double force;       ///< [m0 c^2/R]
  double half_width;  ///< a [R]
  double kept;        ///< elastic energy, which drives the bodies apart [m0 c^2]
};

/// With p pi R delta^2 = energy: F = pi a^2 p, and 0.3 F^2/(a E*) is kept. [Johnson 1985, section 11.5]
PlasticImpact plastic_point_impact(const PointBody& pair, double energy, double pressure);

/// With p (2/3) a^3/R = energy: F = 2 a p, and F^2/(2 pi E) (2 ln(length/a) - 1) is kept, as of a line contact that is
/// let go. [here]
PlasticImpact plastic_line_impact(const LinePair& pair, double energy, double pressure);

}  // namespace ricochet
