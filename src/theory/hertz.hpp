#pragma once
// Normal contact and impact of elastic spheres, quasi-static. [Hertz 1882; Hayakawa & Kuninaka 2003, eqs. hertz,
// 2-ene_cons, tc]

#include "theory/argument.hpp"

namespace ricochet::theory {

/// Two elastic spheres; the second one may be a plane (no R2) and rigid (no E2).
struct Contact {
  double R = 1, E = 1, nu = 0.25;
  double R2 = without_bound, E2 = without_bound, nu2 = 0;

  /// D = (3/4) [(1 - nu^2)/E + (1 - nu2^2)/E2]. The paper prints (1 - nu) once; (1 - nu^2) is right: only with it comes
  /// F = (4/3) E* sqrt(R) h^{3/2}, and Chung & Ooi's test 1 to four digits (tests/theory). [M^-1 L T^2]
  double D() const { return 0.75 * ((1 - nu * nu) / E + (1 - nu2 * nu2) / E2); }
  /// E* = 3 / (4 D). [M L^-1 T^-2]
  double E_star() const { return 0.75 / D(); }
  /// R R2 / (R + R2). [L]
  double R_eff() const { return parallel(R, R2); }
  /// kappa = (4/(5D)) sqrt(R_eff): the energy of a compression h is kappa h^{5/2} / 2. [M L^-1/2 T^-2]
  double kappa() const;

  template <class Struct>
  static Arguments<Struct> fields_of() {
    return {
        {{"R", "number", "L", "radius of the sphere", positive}, &Struct::R},
        {{"E", "number", "M L^-1 T^-2", "its Young's modulus", positive}, &Struct::E},
        {{"nu", "number", "", "its Poisson's ratio", {-1, 0.5, true}}, &Struct::nu},
        {{"R2", "number", "L", "radius of the other sphere; a plane unless given", positive, "", true}, &Struct::R2},
        {{"E2", "number", "M L^-1 T^-2", "its Young's modulus; rigid unless given", positive, "", true}, &Struct::E2},
        {{"nu2", "number", "", "its Poisson's ratio", {-1, 0.5, true}, "0"}, &Struct::nu2}};
  }
};

struct Compression : Contact {
  double h = 0;
  static Arguments<Compression> fields();
};

struct ContactForce {
  double F, a;
  static Arguments<ContactForce> fields();
};

/// F = h^{3/2} sqrt(R_eff) / D, a = (F D R_eff)^{1/3} = sqrt(R_eff h).
ContactForce hertz_force(const Compression& at);

/// An impact of two spheres; the second one may be immovable (no m2). v is the relative normal speed.
struct SphereImpact : Contact {
  double m = 1, m2 = without_bound, v = 1;

  double m_eff() const { return parallel(m, m2); }
  /// h0 = (m_eff/kappa)^{2/5} v^{4/5}. [L]
  double h0() const;

  template <class Struct>
  static Arguments<Struct> masses_of() {
    return {{{"m", "number", "M", "mass of the sphere", positive}, &Struct::m},
            {{"m2", "number", "M", "mass of the other; immovable unless given", positive, "", true}, &Struct::m2},
            {{"v", "number", "L T^-1", "relative normal speed", positive}, &Struct::v}};
  }
  static Arguments<SphereImpact> fields();
};

struct HertzImpact {
  double h0, t_c, F, a, kappa, D, R_eff, m_eff;
  static Arguments<HertzImpact> fields();
};

/// c_t = 4 sqrt(pi) Gamma(2/5) / (5 Gamma(9/10)) = 2.9432752...
double hertz_time_constant();

/// Greatest compression h0, contact time t_c = c_t (m_eff^2/(kappa^2 v))^{1/5}, greatest force and contact radius.
HertzImpact hertz(const SphereImpact& impact);

}  // namespace ricochet::theory
