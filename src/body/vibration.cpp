#include "body/vibration.hpp"

#include <algorithm>
#include <cmath>

#include "body/elements/sweep.hpp"
#include "body/springs/tangent.hpp"
#include "body/tangent.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/streams.hpp"

namespace ricochet {
namespace {

// By how much a node counts: 1 where all have the same mass.
double weight(const Masses& mass, std::size_t node) { return mass.uniform() ? 1.0 : mass[static_cast<int>(node)]; }

// Takes the translation and the rotation about the centre of mass of `places` off the vectors.
void take_off_rigid_motion(const Masses& mass, const Points& places, Points& vectors) {
  Vec2 centre = Vec2::Zero(), mean = Vec2::Zero();
  double whole = 0;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    centre += weight(mass, i) * places[i];
    mean += weight(mass, i) * vectors[i];
    whole += weight(mass, i);
  }
  centre /= whole;
  mean /= whole;
  double inertia = 0, turning = 0;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] -= mean;
    inertia += weight(mass, i) * (places[i] - centre).squaredNorm();
    turning += weight(mass, i) * cross(Vec2(places[i] - centre), vectors[i]);
  }
  const double turn = turning / inertia;
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] -= turn * perpendicular(Vec2(places[i] - centre));
}

}  // namespace

Vibrations::Vibrations(const Solid& solid) : solid_(solid) {
  const std::vector<int> held = held_coordinates(solid);
  std::vector<int> column(static_cast<std::size_t>(solid.free_coordinates()), -1);
  for (int c = 0; c < solid.free_coordinates(); ++c)
    if (std::find(held.begin(), held.end(), c) == held.end()) {
      column[static_cast<std::size_t>(c)] = static_cast<int>(kept_.size());
      kept_.push_back(c);
    }
  const Eigen::SparseMatrix<double> whole = tangent_stiffness(solid);
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < whole.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(whole, c); entry; ++entry)
      if (column[static_cast<std::size_t>(entry.row())] >= 0 && column[static_cast<std::size_t>(c)] >= 0)
        entries.emplace_back(column[static_cast<std::size_t>(entry.row())], column[static_cast<std::size_t>(c)],
                             entry.value());
  Eigen::SparseMatrix<double> matrix(static_cast<int>(kept_.size()), static_cast<int>(kept_.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_.compute(matrix);
  if (factors_.info() != Eigen::Success) throw Error("the body is not rigid (a node hangs loose)");
}

Vibrations::Sample Vibrations::draw(double temperature, double stiffness, std::int64_t seed, int body) const {
  Random random(static_cast<std::uint64_t>(seed), streams::vibration + static_cast<std::uint32_t>(body));
  Eigen::VectorXd z(static_cast<int>(kept_.size()));
  for (double& value : z) value = random.normal();
  // K = P^T L L^T P with the permutation P that keeps the factor sparse.
  const Eigen::VectorXd u =
      std::sqrt(temperature / stiffness) * (factors_.permutationPinv() * Eigen::VectorXd(factors_.matrixU().solve(z)));
  Sample sample{Points(static_cast<std::size_t>(solid_.free), Vec2::Zero()), {}};
  for (std::size_t k = 0; k < kept_.size(); ++k)
    sample.displacement[static_cast<std::size_t>(kept_[k] / 2)][kept_[k] % 2] = u[static_cast<int>(k)];
  for (int i = 0; i < solid_.free; ++i) {
    const double thermal_speed = std::sqrt(temperature / solid_.mass[i]);
    const double x = random.normal(), y = random.normal();
    sample.velocity.push_back(thermal_speed * Vec2(x, y));
  }
  if (solid_.anchored()) return sample;
  take_off_rigid_motion(solid_.mass, solid_.points, sample.displacement);
  Points places = solid_.points;
  for (std::size_t i = 0; i < places.size(); ++i) places[i] += sample.displacement[i];
  take_off_rigid_motion(solid_.mass, places, sample.velocity);
  return sample;
}

double largest_strain(const Solid& solid, const Points& displacement) {
  double most = 0;
  const auto moved = [&](int i) {
    return i < solid.free ? displacement[static_cast<std::size_t>(i)] : Vec2(Vec2::Zero());
  };
  if (const Springs* springs = solid.springs())
    each_spring(*springs, solid.free, [&](int i, int, const Spring& spring) {
      most = std::max(most, (moved(spring.other) - moved(i)).norm() / spring.length);
    });
  if (const Elements* elements = solid.elements())
    for (std::size_t e = 0; e < elements->nodes.size(); ++e) {
      const auto& [i, j, k] = elements->nodes[e];
      const auto& [a, b, c, d] = elements->shape[e].inverse;
      const Vec2 first = moved(j) - moved(i), second = moved(k) - moved(i);
      const Vec2 along_x = a * first + c * second, along_y = b * first + d * second;
      most = std::max(most, std::sqrt(along_x.squaredNorm() + along_y.squaredNorm()));
    }
  return most;
}

}  // namespace ricochet
