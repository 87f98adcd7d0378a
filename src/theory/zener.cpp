#include "theory/zener.hpp"

#include <fmt/format.h>

#include <cmath>

#include "theory/kuwabara_kono.hpp"

namespace ricochet::theory {

Arguments<PlateImpact> PlateImpact::fields() {
  return joined<PlateImpact>(
      {fields_of<PlateImpact>(), {{{"thickness", "number", "L", "of the plate", positive}, &PlateImpact::thickness}}});
}

Arguments<PlateRebound> PlateRebound::fields() {
  using S = PlateRebound;
  return {{{"lambda", "number", "", "Zener's inelasticity parameter", positive}, &S::lambda},
          {{"e", "number", "", "restitution coefficient if nothing else takes energy", positive}, &S::e},
          {{"t_c", "number", "T", "contact time", positive}, &S::t_c}};
}

PlateRebound zener(const PlateImpact& impact) {
  checked(impact);
  const SphereImpact hertzian = impact.hertzian();
  const double root = impact.thickness * impact.thickness *
                      std::sqrt(impact.E2 * impact.rho2 / (12 * (1 - impact.nu2 * impact.nu2)));  // sqrt(D rho2 h)
  const double length = std::pow(0.8, 0.4) * hertzian.h0();                                       // S
  const double lambda = impact.m * impact.v / (8 * length * root);
  const double eta = 1.5 * std::pow(1.25, 0.6) * lambda;
  if (eta > 50)
    throw FieldError(
        "thickness",
        fmt::format("is too small: Zener's parameter would be {:.3g}, and beyond 29 e is below 0.01 and the "
                    "equation stiff",
                    lambda));
  const ViscousRebound rebound = kuwabara_kono({eta, "overlap"});
  return {lambda, rebound.e, rebound.t * hertzian.h0() / impact.v};
}

}  // namespace ricochet::theory
