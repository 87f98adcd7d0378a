#pragma once
// A scene: everything that fixes one impact. Plain data with a canonical text; equal texts give equal outcomes, bit for
// bit.

#include <cmath>
#include <memory>
#include <string>

#include "body/description.hpp"
#include "contact/exponential_repulsion.hpp"
#include "core/units.hpp"
#include "effect/catalogue.hpp"
#include "integrate/method.hpp"

namespace ricochet {

/// How the projectile comes in. The normal is +y: it falls along -y and moves along +x, or along -x where
/// what slants it is below 0. Either `speed` with `psi1` or `angle`, or `normal_speed` with `tangential_speed`.
struct Launch {
  double speed = not_given;
  double psi1 = not_given;
  double angle = not_given;
  double normal_speed = not_given;
  double tangential_speed = not_given;
  double spin = 0;
  double at = 0;
  double height = not_given;

  static const std::vector<Member<Launch>>& fields();
  /// Velocity of the projectile's centre of mass. Throws FieldError if the fields contradict each other.
  Vec2 velocity() const;
};

/// How the impact is computed.
struct Integration {
  std::string method = "auto";
  double step = not_given;
  double theta = not_given;
  double accuracy = not_given;
  std::string accuracy_of = "e";
  double time_limit = not_given;
  double energy_tolerance = 1e-2;

  static const std::vector<Member<Integration>>& fields();
  /// Throws FieldError if more than one of step, theta and accuracy is given.
  void check() const;
};

/// When an impact is over.
struct EndRule {
  std::string at = "parted";
  double force = 1e-3;
  double gap = not_given;
  double time = not_given;

  static const std::vector<Member<EndRule>>& fields();
  /// Throws FieldError if the fields contradict each other, or a time limit.
  void check(const Integration& integration) const;
};

struct Scene {
  std::shared_ptr<const Body> projectile, target;
  Launch launch;
  ExponentialRepulsion contact;
  Integration integration;
  EndRule ending;
  std::vector<Effect> effects;  ///< what acts beside springs and contact
  /// Estimated, of integration.accuracy_of, if trials chose the step. Only that they did is part of the text: a chosen
  /// step under which the impact fails is shortened.
  double error_step = not_given;
  /// Estimated, of integration.accuracy_of, from the softness of a contact that the program chose; no part of the text.
  double error_contact = not_given;
  bool step_is_chosen() const { return !std::isnan(error_step); }
  bool mirrored = false;  ///< its row tells the impact as seen in a mirror, x to -x
  Units units;            ///< of its user; nothing that computes looks at them

  /// By index, as the engine moves them.
  std::vector<const Body*> bodies() const { return {projectile.get(), target.get()}; }

  /// The method named, or the one that `auto` stands for: verlet beside effects that are split off the step, pefrl
  /// else.
  const Method& method() const;
  /// Why a method cannot be used beside the effects of the scene; empty if it can.
  std::string conflict_with(const Method& method) const;

  /// The same bodies struck from the other side, whose row tells the impact as seen in a mirror.
  Scene struck_from_other_side() const;

  /// One line a quantity, shortest exact numbers.
  std::string text() const;
  std::string hash() const;
  /// Scenes of equal group share lattices and method, so they can advance in one batch.
  std::string group() const;
};

}  // namespace ricochet
