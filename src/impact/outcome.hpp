#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "core/field.hpp"
#include "force/catalogue.hpp"

namespace ricochet {

/// How an impact ended. Only `finished` is data.
enum class Status { finished, energy_drift, not_finite, unstable, tunnelled, no_contact, out_of_time, not_run };

inline std::string name_of(Status status) {
  static const char* names[] = {"finished",  "energy_drift", "not_finite",  "unstable",
                                "tunnelled", "no_contact",   "out_of_time", "not_run"};
  return names[static_cast<int>(status)];
}

/// Where the energy is. [m0 c^2] Vibration: kinetic energy beside the rigid motion, and spring energy.
struct Ledger {
  double projectile_translation = 0, projectile_rotation = 0, projectile_vibration = 0;
  double target_translation = 0, target_rotation = 0, target_vibration = 0;
  double contact = 0;
  double effects = 0;  ///< gained in the potentials of effects and lost to those that dissipate, since the start

  double total() const {
    return projectile_translation + projectile_rotation + projectile_vibration + target_translation + target_rotation +
           target_vibration + contact + effects;
  }
};

/// What one impact gave; the quantities named in the paper and the ledger. Undefined ones (beta at psi1 = 0) are NaN.
/// Velocities are those of the projectile relative to the target; n = +y, t = +x; v_c = v - R omega x n.
struct Outcome {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  Status status = Status::not_run;
  std::string reason;  ///< a sentence if it did not finish

  double e = undefined, beta = undefined, mu = undefined, psi1 = undefined, psi2 = undefined;
  double vn = undefined, vt = undefined, omega = undefined;
  double impulse_n = undefined, impulse_t = undefined;
  double contact_time = undefined, touches = undefined, indentation = undefined;
  double contact_length = undefined, centre_offset = undefined, tan_alpha = undefined, e_alpha = undefined;
  Ledger before, after;
  double energy_closure = undefined, energy_drift = undefined;
  double inverted = undefined, inversion_time = undefined;
  double certified = 0, time = undefined, step = undefined, theta = undefined, theta_most = undefined, steps = 0;
  double momentum_residual = undefined, error_estimate = undefined;

  using OfEffects = std::array<double, effect_kinds>;
  static constexpr OfEffects no_effects() {
    OfEffects none{};
    none.fill(undefined);
    return none;
  }
  OfEffects effect_energy =
      no_effects();  ///< of each kind that the scene names: lost to it, or gained in its potential [m0 c^2]
  OfEffects effect_count = no_effects();  ///< of each kind that changes springs: how many it changed

  static const std::vector<std::pair<Field, std::function<double(const Outcome&)>>>& fields();
};

}  // namespace ricochet
