#include "theory/radiation.hpp"

#include <fmt/format.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "theory/hertz.hpp"

namespace ricochet::theory {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

// c_S/c_P = 1/zeta; zeta^2 = 2 (1 - nu)/(1 - 2 nu).
double zeta_squared(double nu) { return 2 * (1 - nu) / (1 - 2 * nu); }

// Takes x^2, so that sqrt(x^2 - 1) here and in Theta2 has the same rounding: at nu = 0, where F0(1) = 0, their ratio
// then stays finite.
Complex F0(double x2, double zeta2) {
  const auto root = [](double square) {
    return square >= 0 ? Complex(std::sqrt(square), 0) : Complex(0, std::sqrt(-square));
  };
  return (2 * x2 - zeta2) * (2 * x2 - zeta2) - 4 * x2 * root(x2 - zeta2) * root(x2 - 1);
}

double Theta1(double sin, double zeta2) {
  const double cos = std::sqrt(1 - sin * sin);
  return cos == 0 ? 0 : cos * (zeta2 - 2 * sin * sin) / F0(sin * sin, zeta2).real();
}

double Theta2(double sin, double zeta2) {
  double x2 = zeta2 * sin * sin;
  if (x2 == 1) x2 = std::nextafter(1.0, 2.0);  // 0/0 at nu = 0
  return 2 * sin * std::sqrt(1 - sin * sin) * std::sqrt(std::abs(x2 - 1)) / std::abs(F0(x2, zeta2));
}

// Over x = from + (to - from) sin^2(s): square roots at the ends become smooth, and the ends themselves are never
// evaluated.
template <class F>
double integral(const F& f, double from, double to) {
  const auto smooth = [&](double s) {
    return f(from + (to - from) * std::sin(s) * std::sin(s)) * (to - from) * std::sin(2 * s);
  };
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(smooth, 0, pi / 2, 15, 1e-12);
}

Field poisson() { return {"nu", "number", "", "Poisson's ratio of the half-space", {-1, 0.49, true}}; }

}  // namespace

Arguments<Direction> Direction::fields() {
  return {{poisson(), &Direction::nu},
          {{"theta", "number", "", "polar angle from the force's axis, in radians", {0, pi / 2}}, &Direction::theta}};
}
Arguments<Pattern> Pattern::fields() {
  return {{{"Theta1", "number", "", "of P waves"}, &Pattern::Theta1},
          {{"Theta2", "number", "", "of S waves, its modulus"}, &Pattern::Theta2}};
}
Arguments<Solid> Solid::fields() { return {{poisson(), &Solid::nu}}; }

Pattern radiation_pattern(const Direction& direction) {
  checked(direction);
  const double sin = std::min(1.0, std::sin(direction.theta)), zeta2 = zeta_squared(direction.nu);
  return {Theta1(sin, zeta2), Theta2(sin, zeta2)};
}

Arguments<Shares> Shares::fields() {
  return {{{"zeta", "number", "", "c_P/c_S"}, &Shares::zeta},
          {{"I1", "number", "", "integral of Theta1^2 sin(theta)"}, &Shares::I1},
          {{"I2", "number", "", "integral of |Theta2|^2 sin(theta)"}, &Shares::I2},
          {{"P", "number", "", "share of P waves in the energy"}, &Shares::P},
          {{"S", "number", "", "share of S waves"}, &Shares::S},
          {{"rayleigh", "number", "", "share of Rayleigh's surface waves"}, &Shares::rayleigh},
          {{"T", "number", "", "energy = T/(2 pi G c_P) times the integral of (dF/dt)^2"}, &Shares::T},
          {{"T_body", "number", "", "T of P and S waves"}, &Shares::T_body},
          {{"T_rayleigh", "number", "", "T of Rayleigh waves"}, &Shares::T_rayleigh}};
}

double radiated_by_work(const Solid& solid) {
  const double zeta2 = zeta_squared(checked(solid).nu), zeta = std::sqrt(zeta2);
  const auto work = [&](double x) { return x * zeta2 * (std::sqrt(Complex(x * x - 1)) / F0(x * x, zeta2)).imag(); };
  return integral(work, 0, 1) + integral(work, 1, zeta);
}

Shares radiation_shares(const Solid& solid) {
  const double zeta2 = zeta_squared(checked(solid).nu), zeta = std::sqrt(zeta2);
  Shares s{};
  s.zeta = zeta;
  const auto square = [](double x) { return x * x; };
  s.I1 = integral([&](double t) { return square(Theta1(std::sin(t), zeta2)) * std::sin(t); }, 0, pi / 2);
  // Beyond the critical angle the S waves' F0 is complex; the pattern has a cusp there.
  const double critical = std::asin(1 / zeta);
  const auto shear = [&](double t) { return square(Theta2(std::sin(t), zeta2)) * std::sin(t); };
  s.I2 = integral(shear, 0, critical) + integral(shear, critical, pi / 2);
  s.T_body = zeta2 * (s.I1 + std::pow(zeta, 5) * s.I2);
  const auto real_F0 = [&](double x) { return F0(x * x, zeta2).real(); };
  const double x = root_between(real_F0, zeta * (1 + 1e-12), 3 * zeta), a = std::sqrt(x * x - 1),
               b = std::sqrt(x * x - zeta2);
  // F0' = 8x(2x^2 - zeta^2) - 8x a b - 4x^3 (a/b + b/a).
  const double slope = 8 * x * (2 * x * x - zeta2) - 8 * x * a * b - 4 * x * x * x * (a / b + b / a);
  s.T_rayleigh = pi * x * zeta2 * a / std::abs(slope);
  s.T = s.T_body + s.T_rayleigh;
  s.rayleigh = s.T_rayleigh / s.T;
  s.P = s.T_body / s.T * s.I1 / (s.I1 + std::pow(zeta, 5) * s.I2);
  s.S = 1 - s.P - s.rayleigh;
  return s;
}

Arguments<RadiatingImpact> RadiatingImpact::fields() { return fields_of<RadiatingImpact>(); }

SphereImpact RadiatingImpact::hertzian() const {
  SphereImpact impact;
  impact.R = R;
  impact.E = E;
  impact.nu = nu;
  impact.E2 = E2;
  impact.nu2 = nu2;
  impact.m = m;
  impact.v = v;
  return impact;
}

Arguments<RadiationLoss> RadiationLoss::fields() {
  using S = RadiationLoss;
  return {{{"energy", "number", "M L^2 T^-2", "radiated", positive}, &S::energy},
          {{"e", "number", "", "restitution coefficient if nothing else takes energy"}, &S::e},
          {{"one_minus_e2", "number", "", "1 - e^2", positive}, &S::one_minus_e2}};
}

RadiationLoss radiation_loss(const RadiatingImpact& impact) {
  checked(impact);
  const SphereImpact hertzian = impact.hertzian();
  const double kappa = hertzian.kappa(), h0 = hertzian.h0(), nu = impact.nu2;
  const double G = impact.E2 / (2 * (1 + nu)), c_P = std::sqrt(zeta_squared(nu) * G / impact.rho2);
  // Products of the impact's own with the half-space's, which stay within the range of numbers.
  const double rates = 45.0 / 16 * boost::math::beta(0.8, 1.5) * (kappa * h0) * (kappa * h0 / G) * (impact.v / c_P);
  const double energy = radiation_shares({nu}).T / (2 * pi) * rates,
               loss = 2 * energy / (impact.m * impact.v * impact.v);
  if (loss >= 1) throw FieldError("v", fmt::format("is too high: {:.3g} of the energy would be radiated", loss));
  return {energy, std::sqrt(1 - loss), loss};
}

double hunter_coefficient(const Solid& solid) {
  const double nu = checked(solid).nu, v = 1e-6;
  return radiation_loss({1, 4 * pi / 3, 1, nu, 1, nu, 1, v}).one_minus_e2 / std::pow(v, 0.6);
}

Arguments<PrintedImpact> PrintedImpact::fields() {
  using S = PrintedImpact;
  return {{{"R", "number", "L", "radius of the sphere", positive}, &S::R},
          {{"m", "number", "M", "its mass", positive}, &S::m},
          {{"E", "number", "M L^-1 T^-2", "its Young's modulus; its Poisson's ratio is 1/4", positive}, &S::E},
          {{"E2", "number", "M L^-1 T^-2", "Young's modulus of the half-space; rigid unless given", positive, "", true},
           &S::E2},
          {{"nu2", "number", "", "Poisson's ratio of the half-space", {-1, 0.5, true}, "0.25"}, &S::nu2},
          {{"rho", "number", "M L^-3", "density", positive}, &S::rho},
          {{"v", "number", "L T^-1", "normal speed", positive}, &S::v}};
}

Arguments<PrintedLoss> PrintedLoss::fields() {
  using S = PrintedLoss;
  return {{{"one_minus_e", "number", "?", "as printed, with v^(1/5)"}, &S::one_minus_e},
          {{"energy", "number", "?", "the printed loss of energy, with v^(13/5)"}, &S::energy},
          {{"one_minus_e_of_energy", "number", "?", "energy/(m v^2), with v^(3/5)"}, &S::one_minus_e_of_energy}};
}

PrintedLoss radiation_printed(const PrintedImpact& impact) {
  checked(impact);
  SphereImpact hertzian;
  hertzian.R = impact.R;
  hertzian.E = impact.E;
  hertzian.nu = 0.25;
  hertzian.E2 = impact.E2;
  hertzian.nu2 = impact.nu2;
  const double kappa = std::pow(hertzian.kappa(), 1.2), v = impact.v;
  const double energy =
      0.5827 * kappa * std::pow(impact.m, 0.8) / (impact.rho * std::pow(impact.E, 1.5)) * std::pow(v, 2.6);
  return {0.5827 * kappa / (impact.rho * std::pow(impact.m, 0.2) * std::pow(impact.E, 1.5)) * std::pow(v, 0.2), energy,
          energy / (impact.m * v * v)};
}

}  // namespace ricochet::theory
