#include "body/modes.hpp"

#include <Spectra/SymEigsShiftSolver.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "body/tangent.hpp"
#include "core/error.hpp"
#include "core/turn.hpp"

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

/// What Spectra asks of (matrix - shift)^-1, by Cholesky's factors: the shift lies below all eigenvalues.
class ShiftedInverse {
 public:
  using Scalar = double;
  explicit ShiftedInverse(const Matrix& matrix) : matrix_(matrix) {}
  Eigen::Index rows() const { return matrix_.rows(); }
  Eigen::Index cols() const { return matrix_.cols(); }
  void set_shift(double shift) {
    Matrix shifted = matrix_;
    for (int c = 0; c < shifted.outerSize(); ++c) shifted.coeffRef(c, c) -= shift;
    factors_.compute(shifted);
    if (factors_.info() != Eigen::Success)
      throw Error("the body is not stable where it is: its springs are pressed together");
  }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, rows()) = factors_.solve(Eigen::Map<const Eigen::VectorXd>(x, rows()));
  }

 private:
  const Matrix& matrix_;
  Eigen::SimplicialLLT<Matrix> factors_;
};

// The `count` eigenvalues next to `shift`, which lies below them all.
Spectrum slowest_part(const Matrix& matrix, int count, double shift) {
  ShiftedInverse inverse(matrix);
  const int size = static_cast<int>(matrix.rows());
  Spectra::SymEigsShiftSolver<ShiftedInverse> solver(inverse, count, std::min(size, 2 * count + 20), shift);
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

/// Displacements and velocities of a body's free nodes beside its rigid motion, turned back to where it was built.
struct Vibration {
  Eigen::VectorXd displacement, velocity;  ///< [free coordinate]
};

Vibration held_vibration(const Solid& solid, const Points& place, const Points& velocity) {
  Vibration vibration{Eigen::VectorXd(solid.free_coordinates()), Eigen::VectorXd(solid.free_coordinates())};
  for (int i = 0; i < solid.free; ++i) {
    const auto k = static_cast<std::size_t>(i);
    vibration.displacement.segment<2>(2 * i) = place[k] - solid.points[k];
    vibration.velocity.segment<2>(2 * i) = velocity[k];
  }
  return vibration;
}

// The rigid motion has the nodes' centre and momentum, their angular momentum, and the turn from which they are
// displaced the least: sum m (X x u) = 0, as of the vibrations.
Vibration free_vibration(const Solid& solid, const Points& place, const Points& velocity) {
  Vec2 centre = Vec2::Zero(), mean = Vec2::Zero();
  const Vec2 at_rest = solid.centre();
  const double whole = solid.total_mass();
  for (int i = 0; i < solid.free; ++i) {
    centre += solid.mass[i] / whole * place[static_cast<std::size_t>(i)];
    mean += solid.mass[i] / whole * velocity[static_cast<std::size_t>(i)];
  }
  double along = 0, across = 0, momentum = 0, inertia = 0;
  for (int i = 0; i < solid.free; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec2 rest = solid.points[k] - at_rest, now = place[k] - centre;
    along += solid.mass[i] * rest.dot(now);
    across += solid.mass[i] * cross(rest, now);
    momentum += solid.mass[i] * cross(now, Vec2(velocity[k] - mean));
    inertia += solid.mass[i] * now.squaredNorm();
  }
  const Turn back(-std::atan2(across, along));
  const double spin = momentum / inertia;
  Vibration vibration{Eigen::VectorXd(solid.free_coordinates()), Eigen::VectorXd(solid.free_coordinates())};
  for (int i = 0; i < solid.free; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec2 now = place[k] - centre;
    vibration.displacement.segment<2>(2 * i) = back(now) - (solid.points[k] - at_rest);
    vibration.velocity.segment<2>(2 * i) = back(Vec2(velocity[k] - mean - spin * perpendicular(now)));
  }
  return vibration;
}

}  // namespace

std::vector<Mode> slowest_modes(const Solid& solid, double stiffness, int count) {
  if (!solid.joined().springs() && !solid.joined().elements())
    throw Error("nothing moves inside a rigid body, which has no modes");
  if (solid.axisymmetric) throw Error("modes are of bodies in the plane, and this one is axisymmetric");
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

std::vector<double> mode_energies(const Solid& solid, const std::vector<Mode>& modes, const Points& place,
                                  const Points& velocity) {
  const Vibration vibration =
      solid.anchored() ? held_vibration(solid, place, velocity) : free_vibration(solid, place, velocity);
  std::vector<double> energies;
  for (const Mode& mode : modes) {
    double q = 0, p = 0;
    for (int c = 0; c < solid.free_coordinates(); ++c) {
      const double weight = mass_of(solid, c) * mode.shape[c];
      q += weight * vibration.displacement[c];
      p += weight * vibration.velocity[c];
    }
    energies.push_back((p * p + mode.omega * mode.omega * q * q) / 2);
  }
  return energies;
}

}  // namespace ricochet
