#pragma once
#include "lattice/lattice.hpp"

namespace ricochet {

struct FrequencyBound {
  double omega;  ///< no vibration of the lattice at rest is faster [c/R]
  int node;      ///< the node that sets it
};

/// omega^2 <= 2 max_i lambda_max(K_ii) / m with K_ii = sum of k n n^T over the springs of node i: for a network whose every
/// spring joins two nodes, K <= 2 blockdiag(K_ii) as a quadratic form, because k (n.(u_i - u_j))^2 <= 2k (n.u_i)^2 + 2k (n.u_j)^2. [here]
FrequencyBound frequency_bound(const Lattice& lattice, double stiffness);

}  // namespace ricochet
