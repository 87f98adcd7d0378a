#pragma once
// The interior of a body that moves as its modes: a frame that flies and turns, and in it free vibrations of small
// displacements.

#include <memory>
#include <vector>

#include "core/vec2.hpp"

namespace ricochet {

struct Solid;

/// How nodes move with each mode: sqrt(mass) displacements, normalised so that shape.M.shape = 1.
struct MovedNodes {
  std::vector<int> node;
  std::vector<double> shape;  ///< [mode][2 place in `node` + component] [m0^-1/2]

  int coordinates() const { return 2 * static_cast<int>(node.size()); }
  const double* of_mode(std::size_t mode) const { return shape.data() + mode * 2 * node.size(); }
};

/// Node i lies at X + R(theta) (arm_i + sum_k q_k shape_ki), X: the centre of mass, theta: by how much the frame has
/// turned. Momentum P, angular momentum L and the modes' momenta p_k have the energy
///   H = P^2/2M + L^2/2I + sum (p_k^2 + omega_k^2 q_k^2)/2,
/// I: the moment of inertia at rest. What acts on the nodes changes P, L and p_k by its work on X, theta and q_k, so
/// that momentum, angular momentum and energy are kept; of the exact motion, terms of the order of spin times vibration
/// are left out. A body that is held somewhere has modes alone. [the floating frame of reference: Shabana 2005,
/// Dynamics of Multibody Systems, chapter 5, without the terms that couple frame and modes]
struct Modes {
  std::shared_ptr<const Solid> of;  ///< the body that they are modes of, of springs or of elements
  std::vector<double> omega;        ///< [mode] by rising size, of a body of stiffness 1 [sqrt(stiffness/m0)]
  MovedNodes all, rim;              ///< the nodes that move; those of the surface among them
  Points arm;                       ///< [node] from the centre of mass, at rest [R]
  double per_mass = 0;              ///< 1/M, 0 of a held body [1/m0]
  double per_inertia = 0;           ///< 1/I, 0 of a held body [1/(m0 R^2)]
  std::vector<double> give;         ///< [node] of the surface: the greatest acceleration that a unit of force gives it,
                                    ///< 1/m where all modes move it, less where few do [1/m0]
  int fastest_node = 0;             ///< the one that moves most with the fastest mode
};

}  // namespace ricochet
