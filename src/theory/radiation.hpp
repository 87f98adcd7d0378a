#pragma once
// Energy radiated as elastic waves into a half-space. [Miller & Pursey 1954, 1955; Hunter 1957; Hayakawa & Kuninaka
// 2003, section II C]

#include "theory/hertz.hpp"

namespace ricochet::theory {

struct Direction {
  double nu = 0.25, theta = 0;
  static Arguments<Direction> fields();
};

struct Pattern {
  double Theta1, Theta2;
  static Arguments<Pattern> fields();
};

/// Amplitudes of a point force's P and S waves: Theta1 = cos(theta) (zeta^2 - 2 sin^2) / F0(sin), |Theta2| = |sin(2
/// theta) sqrt(zeta^2 sin^2 - 1) / F0(zeta sin)|, F0(x) = (2x^2 - zeta^2)^2 - 4 x^2 sqrt(x^2 - zeta^2) sqrt(x^2 - 1),
/// each root taken on its own: below x = 1 their product is negative. The paper prints one root of the product, which
/// would be positive there and has the wrong pattern: sum I1 + zeta^5 I2 would not equal the work done (tests/theory).
Pattern radiation_pattern(const Direction& direction);

struct Solid {
  double nu = 0.25;
  static Arguments<Solid> fields();
};

struct Shares {
  double zeta, I1, I2, P, S, rayleigh, T, T_body, T_rayleigh;
  static Arguments<Shares> fields();
};

/// A force F(t) on a small area radiates T/(2 pi G c_P) int (dF/dt)^2 dt, G the shear modulus: T = T_body + T_rayleigh,
/// T_body = zeta^2 (I1 + zeta^5 I2), I1 = int Theta1^2 sin, I2 = int |Theta2|^2 sin over 0 ... pi/2. T is also the
/// imaginary part of the surface's own displacement, the work done [here]: T_body = int_0^zeta x zeta^2 Im[alpha/F0]
/// dx, T_rayleigh = pi x zeta^2 alpha/|F0'| at F0(x) = 0, x > zeta, alpha = sqrt(x^2 - 1).
Shares radiation_shares(const Solid& solid);

/// T_body from the work done instead of from the waves.
double radiated_by_work(const Solid& solid);

struct RadiatingImpact {
  double R = 1, m = 1, E = 1, nu = 0.25, E2 = 1, nu2 = 0.25, rho2 = 1, v = 1e-3;

  /// The same bodies, of which nothing but their contact moves.
  SphereImpact hertzian() const;

  template <class Struct>
  static Arguments<Struct> fields_of() {
    return {{{"R", "number", "L", "radius of the sphere", positive}, &Struct::R},
            {{"m", "number", "M", "its mass", positive}, &Struct::m},
            {{"E", "number", "M L^-1 T^-2", "its Young's modulus", positive}, &Struct::E},
            {{"nu", "number", "", "its Poisson's ratio", {-1, 0.5, true}}, &Struct::nu},
            {{"E2", "number", "M L^-1 T^-2", "Young's modulus of what it strikes", positive}, &Struct::E2},
            {{"nu2", "number", "", "Poisson's ratio of that", {-1, 0.49, true}}, &Struct::nu2},
            {{"rho2", "number", "M L^-3", "density of that", positive}, &Struct::rho2},
            {{"v", "number", "L T^-1", "normal speed, far below that of sound", positive}, &Struct::v}};
  }
  static Arguments<RadiatingImpact> fields();
};

struct RadiationLoss {
  double energy, e, one_minus_e2;
  static Arguments<RadiationLoss> fields();
};

/// Of a sphere on a half-space, with Hertz's force: int (dF/dt)^2 dt = (45/16) B(4/5, 3/2) kappa^2 h0^2 v, so the
/// energy lost goes as v^{13/5} and 1 - e as v^{3/5}, Hunter's law. The paper prints the same loss, and then 1 - e ~
/// v^{1/5}: E_loss = m v^2 (1 - e) gives 13/5 - 2 = 3/5. Valid for slow impacts, 1 - e << 1.
RadiationLoss radiation_loss(const RadiatingImpact& impact);

/// C of 1 - e^2 = C (v/c0)^{3/5}, c0 = sqrt(E/rho), for sphere and half-space of one material: 1.11 at nu = 1/4, 1.13
/// at 0.3; Hunter as quoted by Johnson: 1.04.
double hunter_coefficient(const Solid& solid);

struct PrintedImpact {
  double R = 1, m = 1, E = 1, E2 = without_bound, nu2 = 0.25, rho = 1, v = 1e-3;
  static Arguments<PrintedImpact> fields();
};

struct PrintedLoss {
  double one_minus_e, energy, one_minus_e_of_energy;
  static Arguments<PrintedLoss> fields();
};

/// The paper's printed law for nu = 1/4: 1 - e = 0.5827 kappa^{6/5} v^{1/5}/(rho m^{1/5} E^{3/2}), E_loss = 0.5827
/// kappa^{6/5} m^{4/5} v^{13/5}/(rho E^{3/2}). Neither keeps its dimensions (k1^2 t_c should go as k1^3, and zeta^4 is
/// counted twice), so the numbers depend on the units. To be compared with, not to be used.
PrintedLoss radiation_printed(const PrintedImpact& impact);

}  // namespace ricochet::theory
