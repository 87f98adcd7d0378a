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
  /// 0 if nothing was taken of it.
  BodyEnergy of(std::size_t body) const { return body < bodies.size() ? bodies[body] : BodyEnergy{}; }
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
  double inertia = undefined, inertia_target = undefined;
  double certified = 0, time = undefined, step = undefined, theta = undefined, theta_most = undefined, steps = 0;
  double momentum_residual = undefined, error_estimate = undefined;
  double over_yield = undefined;

  /// By kind of effect, NaN for those that the scene does not name; empty if it names none. Energy lost to it, or
  /// gained in its potential [m0 c^2]; how many springs it changed.
  std::vector<double> effect_energy, effect_count;

  static const std::vector<std::pair<Field, std::function<double(const Outcome&)>>>& fields();
};

}  // namespace ricochet
