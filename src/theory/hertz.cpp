#include "theory/hertz.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace ricochet::theory {

double Contact::kappa() const { return 0.8 / D() * std::sqrt(R_eff()); }

double SphereImpact::h0() const { return std::pow(m_eff() / kappa(), 0.4) * std::pow(v, 0.8); }

Arguments<Compression> Compression::fields() {
  return joined<Compression>(
      {fields_of<Compression>(),
       {{{"h", "number", "L", "compression; no force below 0", not_negative}, &Compression::h}}});
}

Arguments<ContactForce> ContactForce::fields() {
  return {{{"F", "number", "M L T^-2", "repulsive force"}, &ContactForce::F},
          {{"a", "number", "L", "radius of the contact"}, &ContactForce::a}};
}

Arguments<SphereImpact> SphereImpact::fields() {
  return joined<SphereImpact>({fields_of<SphereImpact>(), masses_of<SphereImpact>()});
}

Arguments<HertzImpact> HertzImpact::fields() {
  return {{{"h0", "number", "L", "greatest compression", positive}, &HertzImpact::h0},
          {{"t_c", "number", "T", "contact time", positive}, &HertzImpact::t_c},
          {{"F", "number", "M L T^-2", "greatest force", positive}, &HertzImpact::F},
          {{"a", "number", "L", "greatest radius of the contact", positive}, &HertzImpact::a},
          {{"kappa", "number", "M L^-1/2 T^-2", "m_eff v^2 = m_eff (dh/dt)^2 + kappa h^(5/2)", positive},
           &HertzImpact::kappa},
          {{"D", "number", "M^-1 L T^2", "(3/4) [(1 - nu^2)/E + (1 - nu2^2)/E2]", positive}, &HertzImpact::D},
          {{"R_eff", "number", "L", "R R2 / (R + R2)", positive}, &HertzImpact::R_eff},
          {{"m_eff", "number", "M", "m m2 / (m + m2)", positive}, &HertzImpact::m_eff}};
}

ContactForce hertz_force(const Compression& at) {
  checked(at);
  const double F = std::pow(at.h, 1.5) * std::sqrt(at.R_eff()) / at.D();
  return {F, std::cbrt(F * at.D() * at.R_eff())};
}

double hertz_time_constant() {
  return 4 * boost::math::constants::root_pi<double>() * boost::math::tgamma(0.4) / (5 * boost::math::tgamma(0.9));
}

HertzImpact hertz(const SphereImpact& impact) {
  checked(impact);
  const double m = impact.m_eff(), kappa = impact.kappa(), h0 = impact.h0();
  const Compression most{static_cast<const Contact&>(impact), h0};
  const ContactForce at = hertz_force(most);
  return {h0,
          hertz_time_constant() * std::pow(m * m / (kappa * kappa * impact.v), 0.2),
          at.F,
          at.a,
          kappa,
          impact.D(),
          impact.R_eff(),
          m};
}

}  // namespace ricochet::theory
