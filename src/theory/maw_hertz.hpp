#pragma once
// Oblique impact of elastic spheres with Hertz's contact, parts of which stick and parts slip. [Maw, Barber & Fawcett,
// Wear 38, 101 (1976); Jaeger, Arch. Appl. Mech. 65, 478 (1995)]

#include "theory/argument.hpp"

namespace ricochet::theory {

struct HertzianOblique {
  double psi1 = 1, mu = 0.3, e = 1, nu = 0.3, beta_x = 3.5, springs = 1000;
  static Arguments<HertzianOblique> fields();
};

struct HertzianRebound {
  double beta, psi2;
  static Arguments<HertzianRebound> fields();
};

/// The contact of two spheres of like materials, or of a sphere and a plane, is a row of springs that know nothing of
/// each other under the profile x^2/R: F_z = E* int (z - x^2/R)+ dx is Hertz's force, and with springs of E*/sigma^2
/// along the surface, sigma^2 = (2 - nu)/(2 (1 - nu)), each of which slips where it would pass mu times its own normal
/// force, F_x is that of Cattaneo and Mindlin, and of Jaeger for any history of both displacements. [Popov & Hess,
/// Method of Dimensionality Reduction in Contact Mechanics and Friction, 2015; as an impact: Lyashenko & Popov, Sci.
/// Rep. 5, 8479 (2015)] The springs' normal force is e^2 times as great in restitution, so that the sphere leaves at e.
/// In units of mass, speed, radius and E*, of which the result does not depend; steps as many as 4 springs. Error of
/// psi2 of the order of 1/springs.
HertzianRebound maw_hertz(const HertzianOblique& impact);

}  // namespace ricochet::theory
