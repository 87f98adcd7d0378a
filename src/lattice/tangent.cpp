#include "lattice/tangent.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ricochet {
namespace {

template <class Use>
void each_spring(const Lattice& lattice, Use&& use) {
  for (int i = 0; i < lattice.free; ++i)
    for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) use(i, lattice.spring[s]);
}

Vec2 between(const Lattice& lattice, int i, const Spring& spring) {
  return lattice.points[spring.other] - lattice.points[i];
}

double tension(const Lattice& lattice, const Spring& spring, double x) {
  return spring.stiffness * x * (1 + lattice.quartic * x * x);
}

}  // namespace

Eigen::VectorXd spring_forces(const Lattice& lattice) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * lattice.free);
  each_spring(lattice, [&](int i, const Spring& spring) {
    const Vec2 d = between(lattice, i, spring),
               pull = tension(lattice, spring, d.norm() - spring.length) / d.norm() * d;
    force.segment<2>(2 * i) += pull;
    if (spring.other < lattice.free) force.segment<2>(2 * spring.other) -= pull;
  });
  return force;
}

Eigen::Matrix2d tangent_block(const Lattice& lattice, int i, const Spring& spring) {
  const Vec2 d = between(lattice, i, spring), n = d.normalized();
  const double x = d.norm() - spring.length, along = spring.stiffness * (1 + 3 * lattice.quartic * x * x),
               across = tension(lattice, spring, x) / d.norm();
  return along * n * n.transpose() + across * (Eigen::Matrix2d::Identity() - n * n.transpose());
}

Eigen::SparseMatrix<double> tangent_stiffness(const Lattice& lattice) {
  std::vector<Eigen::Triplet<double>> entries;
  each_spring(lattice, [&](int i, const Spring& spring) {
    const Eigen::Matrix2d block = tangent_block(lattice, i, spring);
    const int ends[2] = {i, spring.other};
    for (const int a : ends)
      for (const int b : ends) {
        if (a >= lattice.free || b >= lattice.free) continue;
        for (int row = 0; row < 2; ++row)
          for (int column = 0; column < 2; ++column)
            entries.emplace_back(2 * a + row, 2 * b + column, (a == b ? 1 : -1) * block(row, column));
      }
  });
  Eigen::SparseMatrix<double> matrix(2 * lattice.free, 2 * lattice.free);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<int> held_coordinates(const Lattice& lattice) {
  if (lattice.anchored()) return {};
  const auto farther = [&](const Vec2& from) {
    return static_cast<int>(std::max_element(lattice.points.begin(), lattice.points.end(),
                                             [&](const Vec2& a, const Vec2& b) {
                                               return (a - from).squaredNorm() < (b - from).squaredNorm();
                                             }) -
                            lattice.points.begin());
  };
  const int a = farther(lattice.centre()), b = farther(lattice.points[a]);
  const Vec2 d = lattice.points[b] - lattice.points[a];
  return {2 * a, 2 * a + 1, 2 * b + (std::abs(d.x()) > std::abs(d.y()) ? 1 : 0)};
}

void relax(Lattice& lattice) {
  double shortest = std::numeric_limits<double>::infinity(), strongest = 0;
  each_spring(lattice, [&](int i, const Spring& spring) {
    const double r = between(lattice, i, spring).norm();
    shortest = std::min(shortest, r);
    strongest = std::max(strongest, std::abs(tension(lattice, spring, r - spring.length)));
  });
  const std::vector<int> held = held_coordinates(lattice);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Eigen::VectorXd force = spring_forces(lattice);
    if (force.lpNorm<Eigen::Infinity>() <= 1e-13 * strongest) return;
    Eigen::SparseMatrix<double> matrix = tangent_stiffness(lattice);
    // Held coordinates are tied to their place; the forces sum to nothing, so the ties carry none.
    for (const int coordinate : held) matrix.coeffRef(coordinate, coordinate) += 1;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    if (factors.info() != Eigen::Success || factors.vectorD().minCoeff() <= 0)
      break;  // no minimum near: springs would buckle
    const Eigen::VectorXd step = factors.solve(force);
    const double largest = step.lpNorm<Eigen::Infinity>(), share = std::min(1.0, 0.2 * shortest / largest);
    for (int i = 0; i < lattice.free; ++i) lattice.points[i] += share * step.segment<2>(2 * i);
    if (largest < 1e-15) return;
  }
  throw Error("the springs find no balance near their places");
}

}  // namespace ricochet
