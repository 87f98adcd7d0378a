#include "theory/wu_li_thornton.hpp"

#include <fmt/format.h>

#include <cmath>

#include "theory/plastic.hpp"

namespace ricochet::theory {

Arguments<FlowingImpact> FlowingImpact::fields() {
  using S = FlowingImpact;
  return joined<S>({yielding_sphere<S>(),
                    effective_mass<S>(),
                    {{{"v", "number", "L T^-1", "normal speed, of 18.7 yield speeds or more", positive}, &S::v}}});
}

Arguments<FlowingRebound> FlowingRebound::fields() {
  using S = FlowingRebound;
  return {{{"e", "number", "", "restitution coefficient"}, &S::e},
          {{"over_yield", "number", "", "v over the yield speed"}, &S::over_yield},
          {{"window", "number", "", "the same where the -1/4 law ends"}, &S::window}};
}

FlowingRebound wu_li_thornton(const FlowingImpact& impact) {
  checked(impact);
  constexpr double flows = 2.08, finite = 0.62;
  const double x = impact.v / yield_speed({impact.R, impact.E_star, impact.m, impact.Y}).v;
  const double window = std::pow(finite / flows, 4) * std::pow(impact.E_star / impact.Y, 2);
  const double e = x < window ? flows * std::pow(x, -0.25) : finite / std::sqrt(x * impact.Y / impact.E_star);
  if (!(e <= 1)) throw FieldError("v", fmt::format("is too low for a plastic impact: e would be {:.3g}", e));
  return {e, x, window};
}

}  // namespace ricochet::theory
