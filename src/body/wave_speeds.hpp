#pragma once
#include "body/solid.hpp"

namespace ricochet {

/// Of elastic waves far from any rim, and along a flat one. [c] NaN where a body has none of its own.
struct WaveSpeeds {
  double pressure = not_given, shear = not_given, surface = not_given;
};

/// Of waves longer than the spacing of nodes: c_P^2 = E2/(rho (1 - nu2^2)), c_S^2 = E2/(2 rho (1 + nu2)), with the
/// moduli in the plane that usual_moduli() gives, which of lattices are good to 2 %, and Rayleigh's along the surface.
/// NaN of a rigid body, and of one whose stiffness or density differs from place to place, or that is prestressed.
WaveSpeeds wave_speeds(const Body& body, const Solid& solid);

/// c_R/c_S: y of (2 - y^2)^2 = 4 sqrt(1 - y^2) sqrt(1 - (y c_S/c_P)^2).   [Rayleigh 1885, Proc. Lond. Math. Soc. 17, 4]
double surface_over_shear(double shear_over_pressure);

}  // namespace ricochet
