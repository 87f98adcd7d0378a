#include "theory/disk.hpp"

#include <fmt/format.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

namespace ricochet::theory {
namespace {

using std::numbers::pi;

template <class S>
Arguments<S> material() {
  return {{{"R", "number", "L", "radius of the disk", positive}, &S::R},
          {{"E", "number", "M T^-2", "Young's modulus per unit thickness", positive}, &S::E},
          {{"nu", "number", "", "Poisson's ratio", {-1, 0.5, true}}, &S::nu}};
}

template <class S>
double modulus(const S& s) {
  return s.E / (1 - s.nu * s.nu);
}

}  // namespace

Arguments<DiskCompression> DiskCompression::fields() {
  using S = DiskCompression;
  return joined<S>({material<S>(),
                    {{{"h", "number", "L", "compression, below R", positive}, &S::h},
                     {{"rate", "number", "L T^-1", "dh/dt", any_number, "0"}, &S::rate},
                     {{"tau0", "number", "T", "time scale of dissipation", not_negative, "0"}, &S::tau0}}});
}

double disk_force(const DiskCompression& at) {
  checked(at);
  if (at.h >= at.R) throw FieldError("h", fmt::format("must be below R = {:g}, is {:g}", at.R, at.h));
  return pi * modulus(at) * (at.h + at.tau0 * at.rate) / std::log(4 * at.R / at.h);
}

Arguments<DiskImpact> DiskImpact::fields() {
  using S = DiskImpact;
  return joined<S>(
      {material<S>(),
       {{{"rho", "number", "M L^-2", "mass per area", positive}, &S::rho},
        {{"v", "number", "L T^-1", "normal speed, below c", positive}, &S::v},
        {{"tau0", "number", "T", "time scale of dissipation, far below R/c", not_negative, "0"}, &S::tau0}}});
}

Arguments<DiskRebound> DiskRebound::fields() {
  return {{{"t_c", "number", "T", "contact time"}, &DiskRebound::t_c},
          {{"e", "number", "", "restitution coefficient, to first order in tau0"}, &DiskRebound::e},
          {{"c", "number", "L T^-1", "sound speed sqrt(E*/rho)"}, &DiskRebound::c}};
}

DiskRebound disk_log_law(const DiskImpact& impact) {
  checked(impact);
  const double c = std::sqrt(modulus(impact) / impact.rho);
  if (impact.v >= c) throw FieldError("v", fmt::format("must be below the sound speed {:g}, is {:g}", c, impact.v));
  const double root = std::sqrt(std::log(4 * c / impact.v));
  const double e = 1 - pi / 2 * impact.tau0 * c / impact.R / root;
  if (e < 0.5) throw FieldError("tau0", fmt::format("must be small: to first order e would be {:.3g}", e));
  return {pi * impact.R / c * root, e, c};
}

Arguments<DiskLoad> DiskLoad::fields() {
  return joined<DiskLoad>(
      {material<DiskLoad>(), {{{"F", "number", "M L T^-2", "force per unit thickness", not_negative}, &DiskLoad::F}}});
}

Arguments<DiskApproach> DiskApproach::fields() {
  return {{{"delta", "number", "L", "approach of the disk's centre to the plane"}, &DiskApproach::delta},
          {{"a", "number", "L", "half width of the contact"}, &DiskApproach::a}};
}

DiskApproach disk_on_plane(const DiskLoad& load) {
  checked(load);
  const double f = load.F / (pi * modulus(load)), a = std::sqrt(4 * f * load.R);
  if (a > load.R)
    throw FieldError("F", fmt::format("is too great: the contact's half width would be {:.3g} R", a / load.R));
  return {a > 0 ? f * (2 * std::log(4 * load.R / a) - 1) : 0, a};
}

Arguments<DiskSlowImpact> DiskSlowImpact::fields() {
  using S = DiskSlowImpact;
  return joined<S>({material<S>(),
                    {{{"rho", "number", "M L^-2", "mass per area", positive}, &S::rho},
                     {{"v", "number", "L T^-1", "normal speed, below c/3", positive}, &S::v}}});
}

Arguments<DiskImpactOnPlane> DiskImpactOnPlane::fields() {
  using S = DiskImpactOnPlane;
  return {{{"t_c", "number", "T", "contact time"}, &S::t_c},
          {{"delta", "number", "L", "greatest approach"}, &S::delta},
          {{"a", "number", "L", "greatest half width of the contact"}, &S::a},
          {{"F", "number", "M L T^-2", "greatest force per unit thickness"}, &S::F},
          {{"c", "number", "L T^-1", "sound speed sqrt(E*/rho)"}, &S::c}};
}

DiskImpactOnPlane disk_impact(const DiskSlowImpact& impact) {
  checked(impact);
  // In units of R, c and rho R^2, with L = ln(4/a): F = pi a^2/4, d delta/da = a (L - 1), and the energy is
  // U = int F d delta = int (pi/4) a^3 (L - 1) da = (pi/16) a^4 (L - 3/4); m v^2/2 = (pi/2) v^2.
  const double c = std::sqrt(modulus(impact) / impact.rho), v = impact.v / c;
  const auto energy = [](double a) { return a * a * a * a / 8 * (std::log(4 / a) - 0.75); };  // U / (pi/2)
  if (v * v > energy(1))
    throw FieldError("v", fmt::format("must be below {:.4g}, where the contact is as wide as the disk; is {:g}",
                                      std::sqrt(energy(1)) * c, impact.v));
  // U > a^4/8 (ln 4 - 3/4) for a < 1, so the root lies below the a at which that is v^2.
  const double most =
      root_between([&](double a) { return energy(a) - v * v; }, 0.1 * std::sqrt(v) * std::min(1.0, std::sqrt(v)), 1.0);
  // t_c = 2 int da a (L - 1) / sqrt(v^2 - 2U/m); a = most (1 - w^2) takes the root's singularity away.
  const auto slowness = [&](double w) {
    const double a = most * (1 - w * w);
    return a <= 0 ? 0.0 : a * (std::log(4 / a) - 1) / std::sqrt(v * v - energy(a)) * 2 * most * w;
  };
  const double time = 2 * boost::math::quadrature::gauss_kronrod<double, 61>::integrate(slowness, 0, 1, 10, 1e-10);
  const double F = most * most / 4 * pi;
  return {time * impact.R / c, most * most / 4 * (2 * std::log(4 / most) - 1) * impact.R, most * impact.R,
          F * modulus(impact) * impact.R, c};
}

}  // namespace ricochet::theory
