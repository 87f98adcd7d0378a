#include "body/modes.hpp"

#include <Spectra/MatOp/SparseSymShiftSolve.h>
#include <Spectra/SymEigsShiftSolver.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "body/tangent.hpp"
#include "core/error.hpp"

namespace ricochet {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr int small = 300;      // coordinates up to which all modes are found at once
constexpr double rigid = 1e-5;  // of the slowest vibration's omega^2: a motion below it strains nothing
constexpr double precision = 1e-11;

/// Eigenvalues by rising size, and their vectors.
struct Spectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

Spectrum whole_spectrum(const Matrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(matrix)};
  return {solver.eigenvalues(), solver.eigenvectors()};
}

// The `count` eigenvalues next to `shift`, which lies below them all.
Spectrum slowest_part(const Matrix& matrix, int count, double shift) {
  Spectra::SparseSymShiftSolve<double> inverse(matrix);
  const int size = static_cast<int>(matrix.rows());
  Spectra::SymEigsShiftSolver<Spectra::SparseSymShiftSolve<double>> solver(inverse, count,
                                                                           std::min(size, 2 * count + 20), shift);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, precision, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw Error("the modes of this body were not found; ask for fewer");
  return {solver.eigenvalues(), solver.eigenvectors()};
}

double mass_of(const Solid& solid, int coordinate) { return solid.mass[coordinate / solid.dim]; }

// M^-1/2 K M^-1/2, per unit of the stiffness.
Matrix scaled_tangent(const Solid& solid) {
  Matrix matrix = tangent_stiffness(solid);
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Matrix::InnerIterator entry(matrix, column); entry; ++entry)
      entry.valueRef() /= std::sqrt(mass_of(solid, static_cast<int>(entry.row())) * mass_of(solid, column));
  return matrix;
}

}  // namespace

std::vector<Mode> slowest_modes(const Solid& solid, double stiffness, int count) {
  if (!solid.springs() && !solid.elements()) throw Error("nothing moves inside a rigid body, which has no modes");
  const int still = solid.anchored() ? 0 : 3, size = solid.free_coordinates();
  if (count > size - still)
    throw Error(fmt::format("a body of {} free nodes has {} modes; ask for no more", solid.free, size - still));
  const Matrix matrix = scaled_tangent(solid);
  // Of a body of stiffness k and mass m omega^2 is of the order of k/m, whatever its size.
  const Spectrum spectrum = size <= small || 2 * (count + still) + 20 > size
                                ? whole_spectrum(matrix)
                                : slowest_part(matrix, count + still, -0.01 / solid.total_mass());
  const double slowest = spectrum.values[still];
  bool stable = slowest > 0;
  for (int k = 0; k < still; ++k) stable = stable && std::abs(spectrum.values[k]) < rigid * slowest;
  if (!stable)
    throw Error("the body is not stable where it is (a node hangs loose, or its springs are pressed together)");
  std::vector<Mode> modes;
  for (int k = still; k < still + count; ++k) {
    Mode mode{std::sqrt(stiffness * spectrum.values[k]), spectrum.vectors.col(k)};
    for (int c = 0; c < size; ++c) mode.shape[c] /= std::sqrt(mass_of(solid, c));
    // Of the two signs the one in which the component that moves most is positive.
    Eigen::Index most = 0;
    mode.shape.cwiseAbs().maxCoeff(&most);
    if (mode.shape[most] < 0) mode.shape = -mode.shape;
    modes.push_back(std::move(mode));
  }
  return modes;
}

Vec2 participation(const Solid& solid, const Mode& mode) {
  Vec2 moved = Vec2::Zero();
  double mass = 0;
  for (int i = 0; i < solid.free; ++i) {
    moved += solid.mass[i] * Vec2(mode.shape[2 * i], mode.shape[2 * i + 1]);
    mass += solid.mass[i];
  }
  return moved.cwiseProduct(moved) / mass;
}

}  // namespace ricochet
