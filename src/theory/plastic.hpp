#pragma once
// Plastic impact of a sphere. [Johnson 1985, sections 11.5; Hayakawa & Kuninaka 2003, section II D]

#include "theory/argument.hpp"

namespace ricochet::theory {

/// What of two spheres is told to a theory of one that yields.
template <class S>
Arguments<S> yielding_sphere() {
  return {{{"R", "number", "L", "effective radius R R2/(R + R2)", positive}, &S::R},
          {{"E_star", "number", "M L^-1 T^-2", "E* of both bodies, 1/E* = (1 - nu^2)/E + (1 - nu2^2)/E2", positive},
           &S::E_star},
          {{"Y", "number", "M L^-1 T^-2", "yield stress in simple tension of the softer body", positive}, &S::Y}};
}

template <class S>
Arguments<S> effective_mass() {
  return {{{"m", "number", "M", "effective mass m m2/(m + m2)", positive}, &S::m}};
}

struct PlasticImpact {
  double R = 1, E_star = 1, m = 1, Y = 1e-3, pressure = 3, v = 1;
  static Arguments<PlasticImpact> fields();
};

struct PlasticRebound {
  double e, a, p_d;
  static Arguments<PlasticRebound> fields();
};

/// Fully plastic: the contact pressure stays p_d = `pressure` Y, the work is W = m v^2/2 = pi p_d a^4/(4R), and the
/// rebound releases W' = 3 F^2/(10 a E*), F = pi a^2 p_d: e^2 = W'/W = (3 pi^{5/4} 4^{3/4}/10) (p_d/E*) (p_d
/// R^3/W)^{1/4}, e ~ v^{-1/4}. The paper has the same without its number. Valid far above the yield speed, where e < 1.
PlasticRebound plastic(const PlasticImpact& impact);

struct YieldPoint {
  double R = 1, E_star = 1, m = 1, Y = 1e-3;
  static Arguments<YieldPoint> fields();
};

struct Yield {
  double v, F, p0;
  static Arguments<Yield> fields();
};

/// Yield begins where the greatest pressure p0 = 3F/(2 pi a^2) = (6 F E*^2/(pi^3 R^2))^{1/3} reaches 1.60 Y (von Mises,
/// nu = 0.3); the paper prints 1.6 E, which no solid would reach: (p0)_Y is a stress of yield. m v^2/2 = pi^5 R^3
/// p0^5/(60 E*^4) = 53 R^3 Y^5/E*^4.
Yield yield_speed(const YieldPoint& point);

}  // namespace ricochet::theory
