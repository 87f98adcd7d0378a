#pragma once
#include <string>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

/// Elements of a metal: they yield where the von Mises stress passes Y + H a, a: plastic strain, and keep the strain
/// that they flow by (J2 plasticity, linear isotropic hardening). The law is material/hencky_flow.hpp, in place of the
/// body's own, which it equals at small strains; it is asked at every evaluation of the sweep over the elements.
struct Yielding {
  static constexpr const char* name = "yielding";
  static constexpr const char* doc =
      "Elements that yield, as metals do: past a von Mises stress of yield + hardening times the plastic strain they "
      "flow at constant volume, and the work of that is lost. Of plane_strain and axisymmetric bodies.";
  static constexpr const char* example = "ricochet.yielding { yield = 20, hardening = 10 }";
  static constexpr const char* energy_doc = "energy lost to elements that yield, their plastic work";
  static constexpr const char* count_doc = "elements that have yielded";

  static constexpr bool lets_elements_flow = true;

  double yield = not_given;
  double hardening = not_given;
  std::string on = "projectile";

  static const std::vector<Member<Yielding>>& fields() {
    static const std::vector<Member<Yielding>> list{
        {{"yield", "number", "m0 c^2/R^2",
          "yield stress in tension, in units of E; that of the body's material unless given", positive, "", true},
         &Yielding::yield},
        {{"hardening", "number", "m0 c^2/R^2",
          "rise of the yield stress with the plastic strain, in units of E; that of the body's material, else 0, "
          "unless given",
          not_negative, "", true},
         &Yielding::hardening},
        {{"on",
          "string",
          "",
          "the bodies whose elements yield; unless given the projectile, or, where yield is left to the materials, "
          "every one of elements that may whose material has a yield stress",
          any_number,
          "",
          true,
          {"projectile", "target", "both"}},
         &Yielding::on},
    };
    return list;
  }
};

}  // namespace ricochet
