#include "theory/plastic.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace ricochet::theory {
using std::numbers::pi;

Arguments<PlasticImpact> PlasticImpact::fields() {
  using S = PlasticImpact;
  return joined<S>({yielding_sphere<S>(),
                    effective_mass<S>(),
                    {{{"pressure", "number", "", "contact pressure p_d over Y", {1, 10}, "3"}, &S::pressure},
                     {{"v", "number", "L T^-1", "normal speed, far above the yield speed", positive}, &S::v}}});
}

Arguments<PlasticRebound> PlasticRebound::fields() {
  return {{{"e", "number", "", "restitution coefficient"}, &PlasticRebound::e},
          {{"a", "number", "L", "greatest radius of the contact"}, &PlasticRebound::a},
          {{"p_d", "number", "M L^-1 T^-2", "contact pressure"}, &PlasticRebound::p_d}};
}

PlasticRebound plastic(const PlasticImpact& impact) {
  checked(impact);
  const double p = impact.pressure * impact.Y, W = 0.5 * impact.m * impact.v * impact.v, R = impact.R;
  const double e2 =
      0.3 * std::pow(pi, 1.25) * std::pow(4.0, 0.75) * p / impact.E_star * std::pow(p * R * R * R / W, 0.25);
  if (e2 > 1)
    throw FieldError("v", fmt::format("is too low for a fully plastic impact: e would be {:.3g}", std::sqrt(e2)));
  const double a = std::pow(4 * R * W / (pi * p), 0.25);
  if (a > R) throw FieldError("v", fmt::format("is too high: the contact's radius would be {:.3g} R", a / R));
  return {std::sqrt(e2), a, p};
}

Arguments<YieldPoint> YieldPoint::fields() {
  return joined<YieldPoint>({yielding_sphere<YieldPoint>(), effective_mass<YieldPoint>()});
}

Arguments<Yield> Yield::fields() {
  return {{{"v", "number", "L T^-1", "normal speed at which yield begins", positive}, &Yield::v},
          {{"F", "number", "M L T^-2", "force at which it begins", positive}, &Yield::F},
          {{"p0", "number", "M L^-1 T^-2", "greatest pressure of the contact then, 1.60 Y", positive}, &Yield::p0}};
}

Yield yield_speed(const YieldPoint& point) {
  checked(point);
  const double p0 = 1.6 * point.Y, R = point.R, E = point.E_star;
  const double strain = pi * p0 / E;  // powers of pressures would leave the range of numbers
  return {std::sqrt(std::pow(strain, 5) * R / 30 * E / point.m) * R, std::pow(strain, 3) / 6 * E * R * R, p0};
}

}  // namespace ricochet::theory
