#pragma once
#include <Eigen/SparseCore>

#include "body/solid.hpp"

namespace ricochet {

/// The matrix K of small displacements from the solid's points, F = -K u, of the free coordinates of any interior, per
/// unit of the body's stiffness; of a rigid body it is 0.
Eigen::SparseMatrix<double> tangent_stiffness(const Solid& solid);

}  // namespace ricochet
