#pragma once
#include <Eigen/SparseCore>

#include "lattice/lattice.hpp"

namespace ricochet {

/// Forces of the springs on the free nodes at the lattice's points, [2 node + (0: x, 1: y)]; per unit of the body's
/// stiffness. [R]
Eigen::VectorXd spring_forces(const Lattice& lattice);

/// T'(x) n n^T + T/r (1 - n n^T) of a spring of node i, per unit of the body's stiffness: the force on i for a small
/// displacement of the other end.
Eigen::Matrix2d tangent_block(const Lattice& lattice, int i, const Spring& spring);

/// The matrix K of small displacements from the lattice's points, F = -K u, of the free nodes, per unit of the body's
/// stiffness.
Eigen::SparseMatrix<double> tangent_stiffness(const Lattice& lattice);

/// Moves the free nodes to where the springs balance, by Newton's method with a bounded step. Throws Error if it finds
/// no such place near.
void relax(Lattice& lattice);

/// Coordinates to hold so that a lattice without anchors cannot move as a whole: three, far apart; none if it is
/// anchored.
std::vector<int> held_coordinates(const Lattice& lattice);

}  // namespace ricochet
