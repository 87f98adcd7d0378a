#pragma once
// Free vibrations of any body, to first order in the displacements.

#include <Eigen/Core>
#include <vector>

#include "body/solid.hpp"

namespace ricochet {

/// One vibration u(t) = shape cos(omega t).
struct Mode {
  double omega = 0;       ///< [c/R]
  Eigen::VectorXd shape;  ///< [free coordinate] shape.M.shape = 1, M: the nodes' masses [m0^-1/2]
};

/// The `count` slowest vibrations of a body by rising omega, without the three rigid motions of one that is free:
/// K u = omega^2 M u with its tangent stiffness and the masses of its nodes. `stiffness`: ka of springs, E of elements
/// [m0 c^2/R^2]. Throws Error if the body has fewer, does not vibrate, or is not stable where it is. [Spectra's
/// shift-and-invert Lanczos iteration; all of a small body at once, by Eigen]
std::vector<Mode> slowest_modes(const Solid& solid, double stiffness, int count);

/// What share of the mass moves with a mode along x and along y, (shape.M.1)^2 over the free nodes' mass: nothing in a
/// free body, whose centre stays where it is. [the participation of earthquake engineering: Clough & Penzien 1993,
/// section 12-6]
Vec2 participation(const Solid& solid, const Mode& mode);

/// What each mode holds of a body that vibrates, (p^2 + omega^2 q^2)/2 with q = shape.M.u and p = shape.M.u': u is how
/// far the nodes are from where a rigid motion has brought them. [node] `place` [R], `velocity` [c]; returns [m0 c^2]
std::vector<double> mode_energies(const Solid& solid, const std::vector<Mode>& modes, const Points& place,
                                  const Points& velocity);

}  // namespace ricochet
