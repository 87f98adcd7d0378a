#pragma once
#include <Eigen/SparseCholesky>

#include "body/solid.hpp"

namespace ricochet {

/// Vibrations of a body in thermal equilibrium, to first order in the displacements, whatever its interior.
///
/// With K = L L^T (per unit of the stiffness ka) and z of independent normal deviates, u = sqrt(T/ka) L^-T z has the
/// density exp(-ka u.K.u / 2T), and velocities are normal with variance T/m. A body without anchors is held in three
/// coordinates while u is drawn, which singles out one of all displacements that differ by a rigid motion; the rigid
/// part of u and v is then taken off. [here]
class Vibrations {
 public:
  /// Factorises K once. Throws Error if the body is not rigid (a node hangs loose).
  explicit Vibrations(const Solid& solid);

  struct Sample {
    Points displacement;  ///< [free node] [R]
    Points velocity;      ///< [free node] [c]
  };
  /// `temperature`: mean energy of a mode [m0 c^2]; `stiffness`: ka [m0 c^2/R^2]; `body`: chooses the random stream
  /// beside `seed`.
  Sample draw(double temperature, double stiffness, std::int64_t seed, int body) const;

 private:
  const Solid& solid_;
  std::vector<int> kept_;  // coordinates that are not held
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factors_;
};

/// How far neighbours move apart, over their distance: the most of all springs, or the greatest change of place with
/// place (Frobenius norm of the gradient) of all elements. `displacement`: [free node] [R]
double largest_strain(const Solid& solid, const Points& displacement);

}  // namespace ricochet
