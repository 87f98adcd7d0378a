#pragma once
// Impact of a sphere on a large thin plate, from which flexural waves carry energy away. [Zener, Phys. Rev. 59, 669
// (1941)]

#include "theory/radiation.hpp"

namespace ricochet::theory {

struct PlateImpact : RadiatingImpact {
  double thickness = 1;
  static Arguments<PlateImpact> fields();
};

struct PlateRebound {
  double lambda, e, t_c;
  static Arguments<PlateRebound> fields();
};

/// A force F(t) on a point of an infinite thin plate moves it at F/(8 sqrt(D rho2 h)), D = E2 h^3/(12 (1 - nu2^2)): it
/// yields as a dashpot does. With Hertz's force, lengths in S = (m v^2/k)^{2/5}, k = (4/3) E* sqrt(R), times in S/v:
///   s'' + (1 + lambda d/dt) s^{3/2} = 0, s(0) = 0, s'(0) = 1, lambda = m v/(8 S sqrt(D rho2 h))
/// which is Kuwabara & Kono's equation with eta = (3/2) (5/4)^{3/5} lambda. [here]
/// Valid: the plate's waves are long against h, which is large against the contact, and none is back from its rim.
PlateRebound zener(const PlateImpact& impact);

}  // namespace ricochet::theory
