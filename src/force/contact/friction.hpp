#pragma once
#include <algorithm>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

/// Coulomb's law with a tangential spring: every rim node that the other body's rim repels with a load N holds on to it by a spring of
/// stiffness k, whose stretch s follows their relative motion as long as k |s| <= mu N; beyond that the node slides, and the spring is let go to the limit.
/// [Cundall & Strack 1979, Geotechnique 29, 47] A contact's history is its s; it ends with the contact.
struct Friction {
  static constexpr const char* name = "friction";
  static constexpr const char* doc = "Coulomb friction of the rims: every touching node holds on by a tangential spring, and slides where that would pull more than mu times the load.";
  static constexpr const char* example = "ricochet.friction { mu = 0.3 }";
  static constexpr const char* energy_doc = "energy lost to sliding";

  double mu = 0;
  double stiffness = 1e4;

  static const std::vector<Member<Friction>>& fields() {
    static const std::vector<Member<Friction>> list{
        {{"mu", "number", "", "coefficient of friction", not_negative}, &Friction::mu},
        {{"stiffness", "number", "m0 c^2/R^2", "of a touching node's tangential spring", positive, "10000"}, &Friction::stiffness},
    };
    return list;
  }

  /// The stretch after a motion `by`, and the energy lost to sliding meanwhile: that of the mean force over what was slid. [here]
  struct Slid {
    double stretch, lost;
  };
  Slid slide(double stretch, double by, double load) const {
    const double limit = mu * load / stiffness, trial = stretch + by, now = std::clamp(trial, -limit, limit);
    return {now, 0.5 * stiffness * (stretch + now) * (trial - now)};
  }
};

}  // namespace ricochet
