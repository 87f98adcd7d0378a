#include "body/springs/tangent.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace ricochet {
namespace {

Vec2 between(const Solid& solid, const Spring& spring) {
  return solid.points[static_cast<std::size_t>(spring.other)] - solid.points[static_cast<std::size_t>(spring.node)];
}

double tension(const Springs& springs, const Spring& spring, double x) {
  return spring.stiffness * with_spring_law(springs.law, [&](const auto& law) { return law.tension(x); });
}

}  // namespace

Eigen::VectorXd spring_forces(const Solid& solid, const Springs& springs) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(solid.free_coordinates());
  each_spring(springs, solid.free, [&](int i, int, const Spring& spring) {
    const Vec2 d = between(solid, spring), pull = tension(springs, spring, d.norm() - spring.length) / d.norm() * d;
    force.segment<2>(2 * i) += pull;
    if (spring.other < solid.free) force.segment<2>(2 * spring.other) -= pull;
  });
  return force;
}

Eigen::Matrix2d tangent_block(const Solid& solid, const Springs& springs, const Spring& spring) {
  const Vec2 d = between(solid, spring), n = d.normalized();
  const double x = d.norm() - spring.length;
  const double along = spring.stiffness * with_spring_law(springs.law, [&](const auto& law) { return law.tangent(x); });
  const double across = tension(springs, spring, x) / d.norm();
  return along * n * n.transpose() + across * (Eigen::Matrix2d::Identity() - n * n.transpose());
}

Eigen::SparseMatrix<double> tangent_stiffness(const Solid& solid, const Springs& springs) {
  std::vector<Eigen::Triplet<double>> entries;
  each_spring(springs, solid.free, [&](int i, int, const Spring& spring) {
    const Eigen::Matrix2d block = tangent_block(solid, springs, spring);
    const int ends[2] = {i, spring.other};
    for (const int a : ends)
      for (const int b : ends) {
        if (a >= solid.free || b >= solid.free) continue;
        for (int row = 0; row < 2; ++row)
          for (int column = 0; column < 2; ++column)
            entries.emplace_back(2 * a + row, 2 * b + column, (a == b ? 1 : -1) * block(row, column));
      }
  });
  Eigen::SparseMatrix<double> matrix(2 * solid.free, 2 * solid.free);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<int> held_coordinates(const Solid& solid) {
  if (solid.anchored()) return {};
  const auto farther = [&](const Vec2& from) {
    return static_cast<int>(std::max_element(solid.points.begin(), solid.points.end(),
                                             [&](const Vec2& a, const Vec2& b) {
                                               return (a - from).squaredNorm() < (b - from).squaredNorm();
                                             }) -
                            solid.points.begin());
  };
  const int a = farther(solid.centre()), b = farther(solid.points[a]);
  const Vec2 d = solid.points[b] - solid.points[a];
  return {2 * a, 2 * a + 1, 2 * b + (std::abs(d.x()) > std::abs(d.y()) ? 1 : 0)};
}

namespace {

constexpr int most_iterations = 100;

struct Extremes {
  double shortest = std::numeric_limits<double>::infinity(), strongest = 0;  // length, tension
};

Extremes extremes_of(const Solid& solid, const Springs& springs) {
  Extremes found;
  each_spring(springs, solid.free, [&](int, int, const Spring& spring) {
    const double r = between(solid, spring).norm();
    found.shortest = std::min(found.shortest, r);
    found.strongest = std::max(found.strongest, std::abs(tension(springs, spring, r - spring.length)));
  });
  return found;
}

}  // namespace

void relax(Solid& solid, const Springs& springs) {
  const auto [shortest, strongest] = extremes_of(solid, springs);
  const std::vector<int> held = held_coordinates(solid);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Eigen::VectorXd force = spring_forces(solid, springs);
    if (force.lpNorm<Eigen::Infinity>() <= 1e-13 * strongest) return;
    Eigen::SparseMatrix<double> matrix = tangent_stiffness(solid, springs);
    // Held coordinates are tied to their place; the forces sum to nothing, so the ties carry none.
    for (const int coordinate : held) matrix.coeffRef(coordinate, coordinate) += 1;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    // No minimum near: springs would buckle.
    if (factors.info() != Eigen::Success || factors.vectorD().minCoeff() <= 0) break;
    const Eigen::VectorXd step = factors.solve(force);
    const double largest = step.lpNorm<Eigen::Infinity>(), share = std::min(1.0, 0.2 * shortest / largest);
    for (int i = 0; i < solid.free; ++i) solid.points[static_cast<std::size_t>(i)] += share * step.segment<2>(2 * i);
    if (largest < 1e-15) return;
  }
  throw Error("the springs find no balance near their places");
}

}  // namespace ricochet
