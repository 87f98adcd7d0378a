#pragma once
#include <array>
#include <string>
#include <vector>

#include "body/springs/rest.hpp"
#include "body/springs/springs.hpp"
#include "core/field.hpp"

namespace ricochet {

/// Springs that break: T = 0 for good once the stretch has exceeded `strain` times the rest length at the end of a
/// step; the energy that a spring held is booked as lost. Cracks stay inside: springs of the rim do not break, because
/// contact is with the closed chain of rim nodes, and the faces of a crack do not touch each other: what breaks off
/// inside may leave through the rim. The moment of a break is known to a step: outcomes then converge at order 1 at
/// best, and not at all where breaking is a matter of chance.
struct Breaking {
  static constexpr const char* name = "breaking";
  static constexpr const char* doc =
      "Springs that break when drawn out too far. Springs of the rim hold, and only rims touch: what breaks off inside "
      "may leave through the rim. A break falls on the end of a step.";
  static constexpr const char* example = "ricochet.breaking { strain = 0.05 }";
  static constexpr const char* energy_doc = "energy that springs held when they broke";
  static constexpr const char* count_doc = "broken springs";
  static constexpr bool changes_at_step_ends = true;
  static constexpr bool breaks = true;  ///< a spring may be gone
  static constexpr int order = 1;       ///< of outcomes, at best

  double strain = 0;
  std::string on = "projectile";

  static const std::vector<Member<Breaking>>& fields() {
    static const std::vector<Member<Breaking>> list{
        {{"strain", "number", "", "stretch over rest length beyond which a spring breaks", positive},
         &Breaking::strain},
        {{"on",
          "string",
          "",
          "the bodies whose springs break",
          any_number,
          "projectile",
          false,
          {"projectile", "target", "both"}},
         &Breaking::on},
    };
    return list;
  }

  /// memory: { 1 if broken, unused }
  template <class Number>
  static SpringRest<Number> rest(const Number& stretch, const std::array<Number, 2>& memory) {
    return {stretch, 1.0 - memory[0]};
  }

  bool exceeded(double of_rest_length) const { return of_rest_length > strain; }

  /// Breaks a spring that is too long; gives the energy lost, per unit of k.
  template <class Law, class Number>
  Number change(const Law& law, const Spring& spring, const Number& stretch, std::array<Number, 2>& memory) const {
    if (spring.on_rim) return Number::Zero();
    const Number lost =
        (stretch > strain * spring.length).select((1.0 - memory[0]) * law.energy(stretch), Number::Zero());
    memory[0] = (stretch > strain * spring.length).select(Number::Ones(), memory[0]);
    return lost;
  }

  template <class Number>
  static auto counted(const std::array<Number, 2>& memory) {
    return memory[0] > 0.0;
  }
};

}  // namespace ricochet
