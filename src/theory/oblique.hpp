#pragma once
// Walton's three parameters: normal restitution e, friction mu, greatest tangential restitution beta0. [Walton 1992;
// Hayakawa & Kuninaka 2003, section III A]

#include "theory/argument.hpp"

namespace ricochet::theory {

struct Oblique {
  double psi1 = 1, mu = 0.3, e = 1, beta0 = 0.5, beta_x = 3;
  static Arguments<Oblique> fields();
};

struct ObliqueRebound {
  double beta, psi2, psi1_0, B;
  static Arguments<ObliqueRebound> fields();
};

/// beta = min(beta0, -1 + mu (1 + e) beta_x cot(gamma)), psi1 = tan(gamma) >= 0, beta_x = 1 + m R^2/I: 3 for a
/// disk, 3.5 for a sphere. The paper's first branch is -1 - mu (1 + e) cot(gamma) (...): with v_n = v.n < 0 its gamma
/// is negative, while its second branch and its figures take gamma > 0. Psi2 = -beta Psi1. Impulse J = -m (1 + e)
/// (n.v_c) n + B [v_c - (n.v_c) n] with B = -m (1 + beta)/beta_x; the paper prints B = (1 + mR^2/I) m (1 + beta),
/// upside down: its own eq. j8 projected on the tangent gives m (v_ct' - v_ct) = -m (1 + beta) v_ct = beta_x B v_ct.
ObliqueRebound walton(const Oblique& impact);

}  // namespace ricochet::theory
