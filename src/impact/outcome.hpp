#pragma once
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

/// How an impact ended. Only `finished` is data.
enum class Status { finished, energy_drift, not_finite, unstable, tunnelled, no_contact, out_of_time, not_run };

inline std::string name_of(Status status) {
  static const char* names[] = {"finished",  "energy_drift", "not_finite",  "unstable",
                                "tunnelled", "no_contact",   "out_of_time", "not_run"};
  return names[static_cast<int>(status)];
}

/// Of one body. [m0 c^2] Vibration: kinetic energy beside the rigid motion, and that of its interior.
struct BodyEnergy {
  double translation = 0, rotation = 0, vibration = 0;

  static constexpr BodyEnergy undefined() {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none};
  }
};

/// Where the energy is. [m0 c^2]
struct Ledger {
  std::vector<BodyEnergy> bodies;  ///< by index
  double contact = 0;
  double effects = 0;  ///< gained in the potentials of effects and lost to those that dissipate, since the start

  double total() const {
    double sum = 0;
    for (const BodyEnergy& body : bodies) {
      sum += body.translation;
      sum += body.rotation;
      sum += body.vibration;
    }
    return sum + contact + effects;
  }
  /// Undefined if nothing was taken of it.
  BodyEnergy of(std::size_t body) const { return body < bodies.size() ? bodies[body] : BodyEnergy::undefined(); }
};

/// What one impact gave; the quantities named in the paper and the ledger. What did not finish, and what has no
/// meaning, is NaN. `vn`, `vt` and what is made of them are of the projectile relative to the target; n = +y, t = +x;
/// v_c = v - R omega x n. `e_n`, `beta_n`, `mu_n` are the same along the contact's own normal.
struct Outcome {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  Status status = Status::not_run;
  std::string reason;  ///< a sentence if it did not finish

  double e = undefined, beta = undefined, mu = undefined, psi1 = undefined, psi2 = undefined;
  double vn = undefined, vt = undefined, omega = undefined;
  double target_vn = undefined, target_vt = undefined, target_omega = undefined;
  double normal_x = undefined, normal_y = undefined, e_n = undefined, beta_n = undefined, mu_n = undefined;
  double e_first = undefined, mu_first = undefined, time_first = undefined;
  double impulse_n = undefined, impulse_t = undefined;
  double contact_time = undefined, contact_time_energy = undefined, touches = undefined;
  double indentation = undefined, overlap = undefined, penetration = undefined;
  double contact_length = undefined, centre_offset = undefined, tan_alpha = undefined, e_alpha = undefined;
  Ledger before{{}, undefined, undefined}, after = before;
  double energy_closure = undefined, energy_drift = undefined;
  double inverted = undefined, inversion_time = undefined, folded = undefined;
  double inertia = undefined, inertia_target = undefined;
  double xi = undefined, V0 = undefined;
  double certified = 0, time = undefined, step = undefined, theta = undefined, theta_most = undefined, steps = 0;
  double momentum_residual = undefined, error_step = undefined, error_contact = undefined;
  double error_contact_time = undefined, over_yield = undefined;
  double plastic_strain_most = undefined, dent = undefined, dent_target = undefined;
  double last_vn = undefined, last_vt = undefined, last_omega = undefined, last_energy = undefined;

  /// By kind of effect, NaN for those that the scene does not name; empty if it names none. Energy lost to it, or
  /// gained in its potential [m0 c^2]; how many springs it changed.
  std::vector<double> effect_energy, effect_count;

  static const std::vector<std::pair<Field, std::function<double(const Outcome&)>>>& fields();
};

/// Whether the column changes its sign where the impact is seen in a mirror, x to -x.
bool turns_in_mirror(const std::string& column);

}  // namespace ricochet
