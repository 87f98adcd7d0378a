#pragma once
#include "body/solid.hpp"

namespace ricochet {

struct Elasticity {
  double young_modulus;  ///< E [m0 c^2/R^2]: stress over strain; a force per length in two dimensions
  double poisson_ratio;  ///< nu
};

/// Moduli of a lattice from a band stretched along y by a small strain: nodes within one spacing of its lower and upper
/// ends are held along y and slide along x, the others rest in equilibrium (linear springs, Eigen's sparse Cholesky
/// factors). E comes from the force on the upper end over the width, nu from the contraction of the middle half.
/// [Hayakawa & Kuninaka 2003, section V A, "the strains of the band of random lattice"]
Elasticity stretch_band(const Solid& band, const Springs& springs, double stiffness);

}  // namespace ricochet
