#include "lattice/vibration.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "lattice/tangent.hpp"

namespace ricochet {
namespace {

constexpr std::uint32_t vibration_stream = 4;  // and one more for the second body

double cross_sum(const Points& places, const Vec2& centre, const Points& vectors) {
  double sum = 0;
  for (std::size_t i = 0; i < vectors.size(); ++i) sum += cross(Vec2(places[i] - centre), vectors[i]);
  return sum;
}

// Takes the translation and the rotation about the centre of `places` off the vectors.
void take_off_rigid_motion(const Points& places, Points& vectors) {
  Vec2 centre = Vec2::Zero(), mean = Vec2::Zero();
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    centre += places[i];
    mean += vectors[i];
  }
  centre /= static_cast<double>(vectors.size());
  mean /= static_cast<double>(vectors.size());
  double inertia = 0;
  for (const Vec2& p : places) inertia += (p - centre).squaredNorm();
  for (Vec2& v : vectors) v -= mean;
  const double turn = cross_sum(places, centre, vectors) / inertia;
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] -= turn * perpendicular(Vec2(places[i] - centre));
}

}  // namespace

Vibrations::Vibrations(const Lattice& lattice) : lattice_(lattice) {
  const std::vector<int> held = held_coordinates(lattice);
  std::vector<int> column(static_cast<std::size_t>(2 * lattice.free), -1);
  for (int c = 0; c < 2 * lattice.free; ++c)
    if (std::find(held.begin(), held.end(), c) == held.end()) {
      column[static_cast<std::size_t>(c)] = static_cast<int>(kept_.size());
      kept_.push_back(c);
    }
  const Eigen::SparseMatrix<double> whole = tangent_stiffness(lattice);
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < whole.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(whole, c); entry; ++entry)
      if (column[static_cast<std::size_t>(entry.row())] >= 0 && column[static_cast<std::size_t>(c)] >= 0)
        entries.emplace_back(column[static_cast<std::size_t>(entry.row())], column[static_cast<std::size_t>(c)],
                             entry.value());
  Eigen::SparseMatrix<double> matrix(static_cast<int>(kept_.size()), static_cast<int>(kept_.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_.compute(matrix);
  if (factors_.info() != Eigen::Success) throw Error("the lattice is not rigid (a node hangs loose)");
}

Vibrations::Sample Vibrations::draw(double temperature, double stiffness, std::int64_t seed, int body) const {
  Random random(static_cast<std::uint64_t>(seed), vibration_stream + static_cast<std::uint32_t>(body));
  Eigen::VectorXd z(static_cast<int>(kept_.size()));
  for (double& value : z) value = random.normal();
  // K = P^T L L^T P with the permutation P that keeps the factor sparse.
  const Eigen::VectorXd u =
      std::sqrt(temperature / stiffness) * (factors_.permutationPinv() * Eigen::VectorXd(factors_.matrixU().solve(z)));
  Sample sample{Points(static_cast<std::size_t>(lattice_.free), Vec2::Zero()), {}};
  for (std::size_t k = 0; k < kept_.size(); ++k)
    sample.displacement[static_cast<std::size_t>(kept_[k] / 2)][kept_[k] % 2] = u[static_cast<int>(k)];
  const double thermal_speed = std::sqrt(temperature / lattice_.mass);
  for (int i = 0; i < lattice_.free; ++i) {
    const double x = random.normal(), y = random.normal();
    sample.velocity.push_back(thermal_speed * Vec2(x, y));
  }
  if (lattice_.anchored()) return sample;
  take_off_rigid_motion(lattice_.points, sample.displacement);
  Points places = lattice_.points;
  for (std::size_t i = 0; i < places.size(); ++i) places[i] += sample.displacement[i];
  take_off_rigid_motion(places, sample.velocity);
  return sample;
}

}  // namespace ricochet
