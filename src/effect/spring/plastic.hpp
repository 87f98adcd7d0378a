#pragma once
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "body/springs/rest.hpp"
#include "body/springs/springs.hpp"
#include "core/field.hpp"

namespace ricochet {

/// Springs that yield: T = T0(x - p), T0: the body's own law, x: stretch, p: plastic stretch, by which the rest length
/// has moved. |x - p| <= y + H a with the yield stretch y = `yield` times the rest length and a = sum |dp| (linear
/// isotropic hardening); past it, p follows: with s = |x - p| - (y + H a) > 0, dp = s / (1 + H). [the return map: Simo
/// & Hughes, Computational Inelasticity, 1998, section 1.4, in stretches instead of stresses] All plastic work T dp >=
/// 0 is booked as lost.
struct Plastic {
  static constexpr const char* name = "plastic";
  static constexpr const char* doc =
      "Springs that yield: past a share of its rest length a spring's rest length moves along, and the work of that is "
      "lost.";
  static constexpr const char* example = "ricochet.plastic { yield = 0.02 }";
  static constexpr const char* energy_doc = "energy lost to springs that yield; that of elements is yielding_energy";
  static constexpr const char* count_doc = "springs that have yielded";
  static constexpr bool changes_at_step_ends = false;

  double yield = 0;
  double hardening = 0;
  std::string on = "projectile";

  static const std::vector<Member<Plastic>>& fields() {
    static const std::vector<Member<Plastic>> list{
        {{"yield", "number", "", "stretch over rest length at which a spring yields, drawn out or pressed", positive},
         &Plastic::yield},
        {{"hardening", "number", "", "by how much the yield stretch grows with the plastic stretch", not_negative, "0"},
         &Plastic::hardening},
        {{"on",
          "string",
          "",
          "the bodies whose springs yield",
          any_number,
          "projectile",
          false,
          {"projectile", "target", "both"}},
         &Plastic::on},
    };
    return list;
  }

  /// memory: { p, a } [R]
  template <class Number>
  static SpringRest<Number> rest(const Number& stretch, const std::array<Number, 2>& memory) {
    return {stretch - memory[0], Number::Ones()};
  }

  bool exceeded(double strain) const { return std::abs(strain) > yield; }

  /// The return map; gives the energy lost, per unit of k.
  template <class Law, class Number>
  Number change(const Law& law, const Spring& spring, const Number& stretch, std::array<Number, 2>& memory) const {
    auto& [plastic, worked] = memory;
    const Number elastic = stretch - plastic, limit = yield * spring.length + hardening * worked;
    const Number excess = ((elastic.abs() - limit) / (1 + hardening)).max(Number::Zero());
    const Number after = limit + hardening * excess;
    plastic += (elastic > 0.0).select(excess, -excess);
    worked += excess;
    return 0.5 * (law.tension(limit) + law.tension(after)) * excess;
  }

  template <class Number>
  static auto counted(const std::array<Number, 2>& memory) {
    return memory[1] > 0.0;
  }
};

}  // namespace ricochet
