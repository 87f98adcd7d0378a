#pragma once
// Oblique impact with a contact that is elastic along the surface too. [Maw, Barber & Fawcett 1976; Stronge 2000,
// section 5; Hayakawa & Kuninaka 2003, section III B]

#include "theory/argument.hpp"

namespace ricochet::theory {

struct Bilinear {
  double psi1 = 1, mu = 0.3, e = 1, nu = 0.3, beta_x = 3;

  /// sigma^2 = (2 - nu)/(2 (1 - nu)): normal over tangential stiffness.
  double sigma2() const { return (2 - nu) / (2 * (1 - nu)); }
  /// Below it the contact sticks at first: mu sigma^2.
  double stick_bound() const { return mu * sigma2(); }
  /// Above it the contact slides all along: mu max(beta_x, beta_x (1 + e) - sigma^2/e). The paper prints mu (1 + e)
  /// beta_x. Sliding ends where its speed, of the contact point less that of the tangential spring's end, w = v0 - mu
  /// beta_x + mu (beta_x e - sigma^2/e) cos(tau), is 0; its least value over the restitution is at the end, tau = pi,
  /// if beta_x e > sigma^2/e, and at its beginning, tau = pi/2, otherwise. [here; the first case as in the paper's own
  /// t2; both by direct integration in tests/theory]
  double slip_bound() const;
  static Arguments<Bilinear> fields();
};

struct BilinearRebound {
  double beta, psi2, regime, t1, t2, t3;
  static Arguments<BilinearRebound> fields();
};

/// Normal stiffness k in compression, k/e^2 in restitution: F_z = sin(tau), tau = Omega t up to t0 = pi/(2 Omega), then
/// Omega t/e + (pi/2)(1 - 1/e). Tangential spring k/sigma^2, omega = (Omega/sigma) sqrt(beta_x), beta_z = 1, with
/// friction mu F_z. Regimes: (i) 1: sticks until t1; (ii) 2: slides until t2, sticks until t3; (iii) 3: slides.
///   (i)   beta = -cos(omega t1) + s mu beta_x e [1 + cos(tau1)] cot(gamma), s = sgn(sin(omega t1)); printed: - instead
///   of + s (ii)  beta = -cos(phi) + mu beta_x {(1 - cos(Omega t2)) cos(phi) + (Omega/omega) sin(Omega t2) sin(phi) + s
///   e [1 + cos(tau3)]} cot(gamma), phi = omega (t3 - t2), if t2 < t0;
///         printed: the whole bracket with the sign of (i), and e + cos(Omega t3), which is the last term only if e = 1
///   (iii) beta = -1 + mu beta_x (1 + e) cot(gamma)
/// Times are bracketed roots. For psi1 = 0 the limit beta = -cos(omega t_f).
BilinearRebound maw(const Bilinear& impact);

struct BilinearSteps : Bilinear {
  double steps = 20000;
  static Arguments<BilinearSteps> fields();
};

struct IntegratedRebound {
  double beta, psi2;
  static Arguments<IntegratedRebound> fields();
};

/// The same contact integrated step by step, as springs and a slider: nothing of the formulas above is used. Error of
/// beta of the order of (1/steps)^2.
IntegratedRebound maw_integrated(const BilinearSteps& impact);

}  // namespace ricochet::theory
