#pragma once
#include "impact/launch/start.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// Endings and the contact's shape are looked at every so many force evaluations.
inline constexpr int evaluations_between_looks = 64;

/// The repulsion of a node that arrives with speed v grows e-fold in 1/(xi v), and its stiffness is xi^2 m v^2 / 2: a
/// step this share of that time resolves both, however soft the springs. With the paper's disk it counts from 0.3 c on.
inline constexpr double onset_share = 0.3;

/// Kicks of the contact that share a step evenly.
inline double contact_kicks(const Method& method) {
  return method.multirate() ? static_cast<double>(method.stages.size()) : 1;
}

struct Step {
  double step, theta;
};

/// Why a method cannot move these bodies, or cannot be used beside the scene's effects; empty if it can.
std::string conflict_of(const Scene& scene, const Method& method, const Solids& solids);

/// The step that a scene asks for, or the one that resolves its fastest vibration, the contact's onset, and the contact
/// that a heavy body presses on a light one. `fastest`: no node of the projectile is faster [c]; `expected`: bound of
/// the frequency of a contact that the program chose, 0 if it did not [c/R]. Throws FieldError if it is unstable.
Step choose_step(const Scene& scene, const Solids& solids, double fastest, double expected = 0);

}  // namespace ricochet
