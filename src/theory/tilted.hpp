#pragma once
// Impact on a surface that the contact has tilted: why e may exceed 1. [Louge & Adams 2002; Kuninaka & Hayakawa 2004;
// Hayakawa & Kuninaka 2003, section V C]

#include "theory/argument.hpp"

namespace ricochet::theory {

struct TiltedSurface {
  double psi1 = 1, mu = 0.3, e_alpha = 0.9, offset = 0.55, nu = 0.3, beta_x = 3;
  static Arguments<TiltedSurface> fields();
};

struct TiltedRebound {
  double e, e_rotated, theta, tan_alpha, mu_alpha, psi1_alpha, psi2_alpha;
  static Arguments<TiltedRebound> fields();
};

/// theta = (1/pi) arctan((1 - 2 nu)/(mu (2 - 2 nu))), (x_c - x_a)/l = 1 - theta, tan(alpha) = (1 - 2 theta)/(2 - 2
/// theta) |x_c - x_a|/R, e = (e_alpha + Psi2a tan(alpha))/(1 - Psi1a tan(alpha)), Psi1a = (Psi1 - tan(alpha))/(1 + Psi1
/// tan(alpha)), Psi2a = Psi1a - beta_x (1 + e_alpha) mu_alpha, mu_alpha = (mu + tan(alpha))/(1 - mu tan(alpha)), all as
/// printed, where beta_x is 3. Psi1a is that of a surface that rises in the direction of motion. An impulse with the
/// ratio mu, which leans back by arctan(mu), has against that surface's normal, which leans back by alpha itself, the
/// ratio (mu - tan(alpha))/(1 + mu tan(alpha)) [here]: e_rotated takes this one.
TiltedRebound tilted_surface(const TiltedSurface& impact);

struct MeasuredCurve {
  Numbers psi1, mu, e_alpha, offset, at;
  double nu = 0.3, beta_x = 3;
  static Arguments<MeasuredCurve> fields();
};

struct TiltedCurve {
  Numbers e, e_rotated, tan_alpha;
  static Arguments<TiltedCurve> fields();
};

/// The whole chain, as the paper draws it: e at each measured point, and the points joined by the curve of spline.hpp.
/// Boost.Math of Debian 12 (1.74) has a cubic spline only for equally spaced points; its pchip and makima are but once
/// differentiable.
TiltedCurve tilted_curve(const MeasuredCurve& measured);

}  // namespace ricochet::theory
