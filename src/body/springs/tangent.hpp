#pragma once
#include <Eigen/SparseCore>

#include "body/solid.hpp"

namespace ricochet {

/// Forces of the springs on the free nodes at the solid's points, [2 node + (0: x, 1: y)]; per unit of the body's
/// stiffness. [R]
Eigen::VectorXd spring_forces(const Solid& solid, const Springs& springs);

/// T'(x) n n^T + T/r (1 - n n^T) of a spring, per unit of the body's stiffness: the force on its first end for a small
/// displacement of the other end.
Eigen::Matrix2d tangent_block(const Solid& solid, const Springs& springs, const Spring& spring);

/// The matrix K of small displacements from the solid's points, F = -K u, of the free nodes, per unit of the body's
/// stiffness.
Eigen::SparseMatrix<double> tangent_stiffness(const Solid& solid, const Springs& springs);

/// Moves the free nodes to where the springs balance, by Newton's method with a bounded step. Throws Error if it finds
/// no such place near.
void relax(Solid& solid, const Springs& springs);

/// Coordinates to hold so that a body without anchors cannot move as a whole: three, far apart; none if it is
/// anchored.
std::vector<int> held_coordinates(const Solid& solid);

}  // namespace ricochet
