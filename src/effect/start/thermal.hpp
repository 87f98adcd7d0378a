#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

/// Bodies that are warm when they meet: vibrations drawn from the canonical ensemble of the linearised body
/// (body/vibration.hpp), without a rigid motion. Every mode holds `temperature` on average, half of it in
/// motion.
struct Thermal {
  static constexpr const char* name = "thermal";
  static constexpr const char* doc =
      "Bodies that are warm when they meet: vibrations drawn from the canonical ensemble of the linearised body at "
      "a temperature, without a rigid motion.";
  static constexpr const char* example = "ricochet.thermal { temperature = 1e-5 }";
  static constexpr const char* energy_doc =
      nullptr;  // what it brings is in before_projectile_vibration, before_target_vibration

  static constexpr bool only_at_start = true;

  double temperature = 0;
  std::int64_t seed = 1;
  std::string on = "both";

  static const std::vector<Member<Thermal>>& fields() {
    static const std::vector<Member<Thermal>> list{
        {{"temperature", "number", "m0 c^2", "energy of a mode, on average", positive}, &Thermal::temperature},
        {{"seed", "integer", "", "chooses the vibration", {0, 9007199254740992.0}, "1"}, &Thermal::seed},
        {{"on", "string", "", "the warm bodies", any_number, "both", false, {"projectile", "target", "both"}},
         &Thermal::on},
    };
    return list;
  }
};

}  // namespace ricochet
