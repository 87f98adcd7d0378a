#pragma once
// Spheres with viscous loss: x'' + eta sqrt(x) x' + (5/4) x^{3/2} = 0, x(0) = 0, x'(0) = 1, lengths in h0, times in
// h0/v. [Kuwabara & Kono 1987; Hayakawa & Kuninaka 2003, eqs. dissip-f, kk-9]

#include "theory/hertz.hpp"

namespace ricochet::theory {

struct ViscousImpact {
  double eta = 0;
  std::string ends = "overlap";  ///< when contact ends: "overlap", at x = 0; "force", where the force would become
                                 ///< tensile [Schwager & Poeschel 2008]
  static Arguments<ViscousImpact> fields();
};

struct ViscousRebound {
  double e, t;
  static Arguments<ViscousRebound> fields();
};

/// The whole equation, by Dormand & Prince's method of order 5 to 1e-12.
ViscousRebound kuwabara_kono(const ViscousImpact& impact);

struct SmallLoss {
  double eta = 0;
  static Arguments<SmallLoss> fields();
};

/// e = 1 - (4/5) B(3/5, 3/2) eta = 1 - 1.00890979 eta, the first order. Valid for eta << 1.
double kuwabara_kono_first_order(const SmallLoss& loss);

/// e = 1 - C1 s + C2 s^2 - C3 s^3, s = eta/(5/4)^{3/5}; C1 = 1.1534489, C2 = 0.7982666, C3 = 0.5229 (contact ends at x
/// = 0). Valid for s << 1: off by 2e-5 at eta = 0.1, 3e-4 at 0.2, 1e-2 at 0.5. C3 is often quoted as 0.4836 (Ramirez et
/// al. 1999), which disagrees with the equation: fitted to it here at small eta (tests/theory).
double kuwabara_kono_series(const SmallLoss& loss);

/// A sphere impact and the viscosities of Rayleigh's dissipation function: of shear and bulk, as G and K of an elastic
/// solid.
struct ViscousMaterial : SphereImpact {
  double shear = 1, bulk = 1, shear2 = 0, bulk2 = 0;

  /// The paper's D~: D with G and K replaced by the viscosities of shear and bulk. [M^-1 L T]
  double D_viscous() const;
  static Arguments<ViscousMaterial> fields();
};

/// eta = (5/2) kappa~ (v/(kappa^3 m_eff^2))^{1/5}, kappa~ = (4/(5 D~)) sqrt(R_eff), from the paper's F = -2 sqrt(R_eff
/// h) h'/D~. If the viscous stress is tau times the rate of the elastic one, then F = tau dF_el/dt = (3/2) sqrt(R_eff
/// h) h' / D~ with D~ = D/tau: the 2 of the paper should be 3/2 there, and eta three quarters of this one. [here]
double kuwabara_kono_eta(const ViscousMaterial& material);

}  // namespace ricochet::theory
