#include "theory/tilted.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "theory/spline.hpp"

namespace ricochet::theory {

using std::numbers::pi;

Arguments<TiltedSurface> TiltedSurface::fields() {
  using S = TiltedSurface;
  return {{{"psi1", "number", "", "tangent of the incident angle against the flat surface", not_negative}, &S::psi1},
          {{"mu", "number", "", "impulse ratio against the flat surface", not_negative}, &S::mu},
          {{"e_alpha", "number", "", "restitution against the turned normal"}, &S::e_alpha},
          {{"offset", "number", "", "|x_c - x_a|/R, from the trailing end of the contact to the disk's centre", {0, 2}},
           &S::offset},
          {{"nu", "number", "", "Poisson's ratio of the wall", {0, 0.5}}, &S::nu},
          {{"beta_x", "number", "", "1 + m R^2/I: 3 for a disk", {2, 100}, "3"}, &S::beta_x}};
}

Arguments<TiltedRebound> TiltedRebound::fields() {
  using S = TiltedRebound;
  return {
      {{"e", "number", "", "restitution against the flat surface's normal, as printed"}, &S::e},
      {{"e_rotated", "number", "", "the same with mu_alpha = (mu - tan_alpha)/(1 + mu tan_alpha)"}, &S::e_rotated},
      {{"theta", "number", "", "exponent of the frictional contact"}, &S::theta},
      {{"tan_alpha", "number", "", "slope of the chord between the ends of the contact"}, &S::tan_alpha},
      {{"mu_alpha", "number", "", "impulse ratio against the turned normal, as printed"}, &S::mu_alpha},
      {{"psi1_alpha", "number", "", "tangent of the incident angle against the turned normal"}, &S::psi1_alpha},
      {{"psi2_alpha", "number", "", "that of the rebound, by Walton's law of sliding, as printed"}, &S::psi2_alpha}};
}

TiltedRebound tilted_surface(const TiltedSurface& impact) {
  checked(impact);
  const double nu = impact.nu, psi1 = impact.psi1, mu = impact.mu;
  const double theta = std::atan2(1 - 2 * nu, mu * (2 - 2 * nu)) / pi;  // mu = 0: 1/2, no tilt
  const double t = (1 - 2 * theta) / (2 - 2 * theta) * impact.offset;
  if (mu * t >= 1)
    throw FieldError(
        "mu",
        fmt::format(
            "is too great: with tan(alpha) = {:.3g} the friction angle against the turned normal passes 90 degrees",
            t));
  const double psi1_alpha = (psi1 - t) / (1 + psi1 * t), mu_alpha = (mu + t) / (1 - mu * t);
  // 1 - Psi1a t = (1 + t^2)/(1 + Psi1 t): positive for every incident angle.
  const auto restitution = [&](double friction) {
    return (impact.e_alpha + (psi1_alpha - impact.beta_x * (1 + impact.e_alpha) * friction) * t) * (1 + psi1 * t) /
           (1 + t * t);
  };
  return {restitution(mu_alpha),
          restitution((mu - t) / (1 + mu * t)),
          theta,
          t,
          mu_alpha,
          psi1_alpha,
          psi1_alpha - impact.beta_x * (1 + impact.e_alpha) * mu_alpha};
}

Arguments<MeasuredCurve> MeasuredCurve::fields() {
  using S = MeasuredCurve;
  return {{{"psi1", "numbers", "", "tangents of the incident angles, rising", not_negative}, &S::psi1},
          {{"mu", "numbers", "", "impulse ratio at each", not_negative}, &S::mu},
          {{"e_alpha", "numbers", "", "restitution against the turned normal at each"}, &S::e_alpha},
          {{"offset", "numbers", "", "|x_c - x_a|/R at each", {0, 2}}, &S::offset},
          {{"at", "numbers", "", "where the curve is wanted, within psi1", not_negative}, &S::at},
          {{"nu", "number", "", "Poisson's ratio of the wall", {0, 0.5}}, &S::nu},
          {{"beta_x", "number", "", "1 + m R^2/I: 3 for a disk", {2, 100}, "3"}, &S::beta_x}};
}

Arguments<TiltedCurve> TiltedCurve::fields() {
  using S = TiltedCurve;
  return {{{"e", "numbers", "", "e at each of `at`, as printed"}, &S::e},
          {{"e_rotated", "numbers", "", "with the friction angle turned with the surface"}, &S::e_rotated},
          {{"tan_alpha", "numbers", "", "slope of the chord there"}, &S::tan_alpha}};
}

TiltedCurve tilted_curve(const MeasuredCurve& measured) {
  checked(measured);
  for (const auto& [name, list] :
       {std::pair{"mu", &measured.mu}, {"e_alpha", &measured.e_alpha}, {"offset", &measured.offset}})
    if (list->size() != measured.psi1.size())
      throw FieldError(
          name, fmt::format("must hold as many values as psi1, {}; holds {}", measured.psi1.size(), list->size()));
  Numbers e, e_rotated, slope;
  for (std::size_t i = 0; i < measured.psi1.size(); ++i) {
    const TiltedRebound at = tilted_surface(
        {measured.psi1[i], measured.mu[i], measured.e_alpha[i], measured.offset[i], measured.nu, measured.beta_x});
    e.push_back(at.e);
    e_rotated.push_back(at.e_rotated);
    slope.push_back(at.tan_alpha);
  }
  return {cubic_spline(measured.psi1, e, measured.at), cubic_spline(measured.psi1, e_rotated, measured.at),
          cubic_spline(measured.psi1, slope, measured.at)};
}

}  // namespace ricochet::theory
