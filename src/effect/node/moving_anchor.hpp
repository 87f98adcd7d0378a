#pragma once
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "core/vec2.hpp"

namespace ricochet {

/// A shaken wall: the target's anchors move together by a(t) = A sin(omega t + phase), t from the rims' coming within
/// reach on. The target starts displaced and moving as a whole. The anchors do work on the springs that they hold: with
/// time as one more coordinate, which drifts, each kick h books h F . da/dt, F: force of the springs on the anchors.
/// [the extended phase space: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2006, section VIII.2; the
/// booking is ours]
struct MovingAnchor {
  static constexpr const char* name = "moving_anchor";
  static constexpr const char* doc =
      "A shaken wall: the target's anchors move by amplitude sin(omega t + phase), t from the rims' coming within "
      "reach on; the target starts displaced and moving as a whole. e and all velocities are those in the frame at "
      "rest. An impact ends when the bodies first part.";
  static constexpr const char* example = "ricochet.moving_anchor { amplitude = 0.02, omega = 0.5, phase = 90 }";
  static constexpr const char* energy_doc = "energy given to the anchors; below 0 if they did work on the target";

  static constexpr bool needs_anchors = true;

  double amplitude = 0;
  double omega = 0;
  double phase = 0;
  std::string along = "normal";

  static const std::vector<Member<MovingAnchor>>& fields() {
    static const std::vector<Member<MovingAnchor>> list{
        {{"amplitude", "number", "R", "greatest displacement", positive}, &MovingAnchor::amplitude},
        {{"omega", "number", "c/R", "angular frequency", positive}, &MovingAnchor::omega},
        {{"phase", "number", "degrees",
          "at the rims' coming within reach; at 0 the wall passes its middle, upwards or forwards", any_number, "0"},
         &MovingAnchor::phase},
        {{"along",
          "string",
          "",
          "normal: up and down; tangential: to and fro",
          any_number,
          "normal",
          false,
          {"normal", "tangential"}},
         &MovingAnchor::along},
    };
    return list;
  }

  Vec2 direction() const { return along == "normal" ? Vec2(0, 1) : Vec2(1, 0); }
  Vec2 displacement(double time) const {
    return amplitude * std::sin(omega * time + phase * std::numbers::pi / 180) * direction();
  }
  Vec2 velocity(double time) const {
    return amplitude * omega * std::cos(omega * time + phase * std::numbers::pi / 180) * direction();
  }
};

}  // namespace ricochet
