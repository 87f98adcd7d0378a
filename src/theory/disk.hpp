#pragma once
// Normal contact and impact in two dimensions: forces, masses and moduli are per unit thickness (E in M T^-2, rho in M
// L^-2). [Hayakawa & Kuninaka 2003, section II B; Johnson 1985, section 5.6]

#include "theory/argument.hpp"

namespace ricochet::theory {

/// E* = E/(1 - nu^2), c = sqrt(E*/rho).
struct DiskCompression {
  double R = 1, E = 1, nu = 0.25, h = 0, rate = 0, tau0 = 0;
  static Arguments<DiskCompression> fields();
};

/// F = pi E* h / ln(4R/h) + tau0 pi E* h' / ln(4R/h), repulsive if positive (the paper's F_tot has the other sign).
/// Valid for h << R.
double disk_force(const DiskCompression& at);

struct DiskImpact {
  double R = 1, E = 1, nu = 0.25, rho = 1, v = 0.01, tau0 = 0;
  static Arguments<DiskImpact> fields();
};

struct DiskRebound {
  double t_c, e, c;
  static Arguments<DiskRebound> fields();
};

/// The logarithm as a constant: t_c = (pi R/c) sqrt(ln(4c/v)), within 2 % of the whole log law (disk_impact) up to v =
/// 0.02 c, 4 % at 0.1 c. With dissipation to first order e = 1 - (pi/2) (tau0 c/R) / sqrt(ln(4c/v)): of h'' + tau0 w^2
/// h' + w^2 h = 0 half a period, t_c = pi/w, leaves e = exp(-tau0 w^2 t_c/2) = exp(-pi tau0 w/2). The paper prints e =
/// 1 - 2 pi E*/(rho R c sqrt(ln(4c/v))), which has no tau0, and E*/(rho R c) = c/R is a rate, not a number.
DiskRebound disk_log_law(const DiskImpact& impact);

struct DiskLoad {
  double R = 1, E = 1, nu = 0.25, F = 0;
  static Arguments<DiskLoad> fields();
};

struct DiskApproach {
  double delta, a;
  static Arguments<DiskApproach> fields();
};

/// Johnson's disk on a rigid plane: a = sqrt(4FR/(pi E*)), delta = (F/(pi E*)) [2 ln(4R/a) - 1]. Valid for a <= R.
DiskApproach disk_on_plane(const DiskLoad& load);

struct DiskSlowImpact {
  double R = 1, E = 1, nu = 0.25, rho = 1, v = 0.01;
  static Arguments<DiskSlowImpact> fields();
};

struct DiskImpactOnPlane {
  double t_c, delta, a, F, c;
  static Arguments<DiskImpactOnPlane> fields();
};

/// The impact by Johnson's law, quasi-static: m delta'' = -F(delta), m = pi R^2 rho, by quadrature. Valid while the
/// contact stays narrower than the disk.
DiskImpactOnPlane disk_impact(const DiskSlowImpact& impact);

}  // namespace ricochet::theory
