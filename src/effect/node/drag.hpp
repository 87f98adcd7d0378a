#pragma once
#include <string>
#include <vector>

#include "body/solid.hpp"
#include "core/field.hpp"

namespace ricochet {

/// dv/dt = -rate v on every free node of a body: Stokes' drag of a medium at rest. Solved exactly, v -> v exp(-rate h).
struct Drag {
  static constexpr const char* name = "drag";
  static constexpr const char* doc =
      "Friction of every node against a medium at rest, in proportion to its velocity, from the first approach of the "
      "rims on.";
  static constexpr const char* example = "ricochet.drag { rate = 0.01 }";
  static constexpr const char* energy_doc = "energy lost to drag";

  double rate = 0;
  std::string on = "projectile";

  static const std::vector<Member<Drag>>& fields() {
    static const std::vector<Member<Drag>> list{
        {{"rate", "number", "c/R", "share of the velocity lost in a unit of time", not_negative}, &Drag::rate},
        {{"on",
          "string",
          "",
          "the bodies it acts on",
          any_number,
          "projectile",
          false,
          {"projectile", "target", "both"}},
         &Drag::on},
    };
    return list;
  }

  /// Of the velocity and the spin of a body that touches nothing. [c/R]
  double decay() const { return rate; }

  /// Of each free node [c/R].
  std::vector<double> rates(const Solid& solid) const {
    return std::vector<double>(static_cast<std::size_t>(solid.free), rate);
  }
};

}  // namespace ricochet
