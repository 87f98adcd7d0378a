#pragma once
#include "body/solid.hpp"

namespace ricochet {

struct Elasticity {
  double young_modulus;  ///< E [m0 c^2/R^2]: stress over strain; a force per length in two dimensions
  double poisson_ratio;  ///< nu
};

/// What a wide body of one stiffness has in its plane.
struct PlaneModuli {
  double per_stiffness;  ///< E2 over the body's stiffness
  double poisson_ratio;  ///< nu2
};

/// Of springs by placement: 2/sqrt(3) and 1/3, exactly, of a triangular lattice; 1.16 and 0.33 of Poisson disks, 1.08
/// and 0.26 of uniform points, as stretch_band() finds them within 2 % in wide bands. [here] Of elements exactly, by nu
/// and the state.
PlaneModuli usual_moduli(const BodyNumbers& numbers);

/// Moduli in the plane of a band stretched along y by a small strain: nodes within one spacing of its lower and upper
/// ends are held along y and slide along x, the others rest in equilibrium (by the tangent at rest, Eigen's sparse
/// Cholesky factors). E comes from the force on the upper end over the width, nu from the contraction of the middle
/// half. [Hayakawa & Kuninaka 2003, section V A, "the strains of the band of random lattice"]
Elasticity stretch_band(const Solid& band, double stiffness);

}  // namespace ricochet
