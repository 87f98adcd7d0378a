#pragma once
#include <span>
#include <string>
#include <vector>

namespace ricochet {

/// One force evaluation of a step and what follows it: v += kick h F/m; x += drift h v. With a gradient, the force is
/// that at x + gradient h^2 F(x)/m, which takes a second evaluation and no derivative of F.
struct Stage {
  double kick, drift, gradient = 0;
};

/// An explicit Runge-Kutta method for (x, v): X_i = x + h sum_j a_ij V_j, V_i = v + h sum_j a_ij F(X_j)/m, and the same
/// with b.
struct Tableau {
  std::vector<std::vector<double>> a;  ///< [stage][earlier stage]
  std::vector<double> b;               ///< [stage]
};

/// A symplectic composition, or a Runge-Kutta method to hold it against (then `stages` is empty). A run stays ahead of
/// the ends of its steps by one kick (`ahead_kick`, 0 for methods that begin with a drift) and one drift, so that the
/// last part of a step and the first of the next are one. Coefficients only; the one loop is in compose.hpp.
struct Method {
  std::string name;
  std::string source;
  int order;
  double stability_limit;  ///< largest h omega of a harmonic oscillator; strict: bounded everywhere below
  double
      usual;  ///< h omega of the default step, at which e is accurate to about 1e-4 (scripts/what_accuracy_costs.lua)
  double ahead_kick, ahead_drift;
  std::vector<Stage> stages;

  /// At which e, v and spin converge; above `order` for a method that is conjugate to a better one.
  int outcome_order = order;

  /// Above 0 for a multirate method: the target's springs kick once a step, while `stages` move the projectile, the
  /// contact and the target's rim. Largest h omega of the target at which it is of use: errors grow by the fourth
  /// power, and leap beyond.
  double slow_limit = 0;
  bool multirate() const { return slow_limit > 0; }

  Tableau tableau = {};  ///< of a method that is not symplectic: its energy drifts
  bool symplectic() const { return tableau.b.empty(); }

  /// Evaluations of the force a step; for a multirate method those of the projectile and the contact...
  int evaluations() const;
  /// ... and those of the target's springs.
  int slow_evaluations() const { return multirate() ? 2 : evaluations(); }
  static constexpr double usual_accuracy = 1e-4;
};

/// Which body a multirate method moves in its inner steps, and which in its outer one.
struct MultirateRoles {
  std::size_t fast = 0, slow = 1;
};

/// The factor by which a body's frequencies count against the stability limit: 1, or more for the slow one of a
/// multirate method, which follows its interior in long steps.
inline double slower_by(const Method& method, std::size_t body) {
  return method.multirate() && body == MultirateRoles{}.slow ? method.stability_limit / method.slow_limit : 1;
}

std::span<const Method> methods();
std::vector<std::string> method_names();

/// Throws FieldError("method") for an unknown name.
const Method& method_named(const std::string& name);

}  // namespace ricochet
