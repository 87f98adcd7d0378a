#include "theory/oblique.hpp"

#include <algorithm>

namespace ricochet::theory {

Arguments<Oblique> Oblique::fields() {
  return {{{"psi1", "number", "", "tangent of the incident angle, v_ct/v_n", not_negative}, &Oblique::psi1},
          {{"mu", "number", "", "coefficient of friction", not_negative}, &Oblique::mu},
          {{"e", "number", "", "normal restitution coefficient", not_negative}, &Oblique::e},
          {{"beta0", "number", "", "greatest tangential restitution coefficient", {-1, 1}}, &Oblique::beta0},
          {{"beta_x", "number", "", "1 + m R^2/I: 3 for a disk, 3.5 for a sphere", {2, 100}, "3"}, &Oblique::beta_x}};
}

Arguments<ObliqueRebound> ObliqueRebound::fields() {
  return {{{"beta", "number", "", "tangential restitution of the contact point, -v_ct'/v_ct"}, &ObliqueRebound::beta},
          {{"psi2", "number", "", "v_ct' over the normal speed before, -beta psi1"}, &ObliqueRebound::psi2},
          {{"psi1_0", "number", "", "psi1 above which it slides all along; left out if it never sticks (beta0 = -1)",
            any_number, "", true},
           &ObliqueRebound::psi1_0},
          {{"B", "number", "", "tangential impulse over m v_ct, -(1 + beta)/beta_x"}, &ObliqueRebound::B}};
}

ObliqueRebound walton(const Oblique& impact) {
  checked(impact);
  // Sliding: v_ct' = v_ct - mu (1 + e) beta_x v_n, so beta psi1 = mu (1 + e) beta_x - psi1.
  const double slide = impact.mu * (1 + impact.e) * impact.beta_x;
  const bool sticks = (1 + impact.beta0) * impact.psi1 <= slide;
  const double beta = sticks ? impact.beta0 : slide / impact.psi1 - 1;
  const double critical = impact.beta0 > -1 ? slide / (1 + impact.beta0) : std::numeric_limits<double>::quiet_NaN();
  return {beta, -beta * impact.psi1, critical, -(1 + beta) / impact.beta_x};
}

}  // namespace ricochet::theory
