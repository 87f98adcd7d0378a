#pragma once
#include <algorithm>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

/// Coulomb's law with a tangential spring: every rim node that the other body's rim repels with a load N holds on to it
/// by a spring of stiffness k, whose stretch s follows their relative motion as long as k |s| <= mu N; beyond that the
/// node slides, and the spring is let go to the limit. [Cundall & Strack 1979, Geotechnique 29, 47] A contact's history
/// is its s; it ends with the contact.
struct Friction {
  static constexpr const char* name = "friction";
  static constexpr const char* doc =
      "Coulomb friction of the rims: every touching node holds on by a tangential spring, and slides where that would "
      "pull more than mu times the load.";
  static constexpr const char* example = "ricochet.friction { mu = 0.3 }";
  static constexpr const char* energy_doc = "energy lost to sliding";
  static constexpr int order =
      1;  ///< of outcomes: the motion between two evaluations is taken along the tangents at the second

  double mu = 0;
  double stiffness = 1;

  static const std::vector<Member<Friction>>& fields() {
    static const std::vector<Member<Friction>> list{
        {{"mu", "number", "", "coefficient of friction", not_negative}, &Friction::mu},
        {{"stiffness", "number", "",
          "of a touching node's tangential spring, over the mean of the softer body's springs", positive, "1"},
         &Friction::stiffness},
    };
    return list;
  }

  /// The stretch of a spring k after a motion `by`, and the energy lost to sliding meanwhile: that of the mean force
  /// over what was slid, which closes the ledger to the step's order. One huge step may let go of a stretch and slide
  /// back: the mean then points along the slide, as if friction drove it, and the loss is that of the limit's force.
  /// Never negative. [here]
  struct Slid {
    double stretch, lost;
  };
  Slid slide(double stretch, double by, double load, double k) const {
    const double limit = mu * load / k;
    const double trial = stretch + by;
    const double now = std::clamp(trial, -limit, limit);
    const double slid = trial - now;
    const double by_mean_force = 0.5 * k * (stretch + now) * slid;
    return {now, by_mean_force >= 0 ? by_mean_force : k * now * slid};
  }
};

}  // namespace ricochet
