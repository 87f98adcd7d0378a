#include "lattice/elasticity.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "lattice/tangent.hpp"

namespace ricochet {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

// Slope of the least-squares line of v against u.
double slope(const std::vector<double>& u, const std::vector<double>& v) {
  double mean_u = 0, mean_v = 0, uu = 0, uv = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    mean_u += u[i];
    mean_v += v[i];
  }
  mean_u /= static_cast<double>(u.size());
  mean_v /= static_cast<double>(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    uu += (u[i] - mean_u) * (u[i] - mean_u);
    uv += (u[i] - mean_u) * (v[i] - mean_v);
  }
  return uv / uu;
}

}  // namespace

Elasticity stretch_band(const Lattice& band, double stiffness) {
  const int nodes = band.nodes();
  Vec2 low = band.points[0], high = band.points[0];
  for (const Vec2& p : band.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double width = high.x() - low.x(), height = high.y() - low.y();
  const double grip = std::sqrt(width * height / nodes);  // one spacing
  const double strain = 1e-3;

  // Degrees of freedom: x of every node, y of those between the grips; one x is held so that the band cannot slide
  // away.
  std::vector<int> column(2 * static_cast<std::size_t>(nodes), -1);
  std::vector<double> held(2 * static_cast<std::size_t>(nodes), 0.0);
  std::vector<bool> upper(static_cast<std::size_t>(nodes), false);
  int unknowns = 0, gripped = 0;
  for (int i = 0; i < nodes; ++i) {
    const std::size_t s = static_cast<std::size_t>(i);
    const double y = band.points[s].y();
    const bool in_lower = y<low.y() + grip / 2, in_upper = y> high.y() - grip / 2;
    upper[s] = in_upper;
    if (in_lower || in_upper) {
      held[2 * s + 1] = strain * (y - low.y());
      if (gripped++ > 0) column[2 * s] = unknowns++;  // the first gripped node is the one held along x
    } else {
      column[2 * s] = unknowns++;
      column[2 * s + 1] = unknowns++;
    }
  }

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns);
  const auto each_spring = [&](auto&& visit) {
    for (int i = 0; i < nodes; ++i)
      for (int s = band.first[static_cast<std::size_t>(i)]; s < band.first[static_cast<std::size_t>(i) + 1]; ++s)
        visit(i, band.spring[static_cast<std::size_t>(s)]);
  };
  each_spring([&](int i, const Spring& spring) {
    const int j = spring.other;
    const Eigen::Matrix2d k = stiffness * tangent_block(band, i, spring);
    const std::size_t dof[4] = {2 * static_cast<std::size_t>(i), 2 * static_cast<std::size_t>(i) + 1,
                                2 * static_cast<std::size_t>(j), 2 * static_cast<std::size_t>(j) + 1};
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const double value = (a / 2 == b / 2 ? 1 : -1) * k(a % 2, b % 2);
        if (column[dof[a]] < 0) continue;
        if (column[dof[b]] >= 0)
          entries.emplace_back(column[dof[a]], column[dof[b]], value);
        else
          load[column[dof[a]]] -= value * held[dof[b]];
      }
  });
  Matrix system(unknowns, unknowns);
  system.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Matrix> factors(system);
  if (factors.info() != Eigen::Success || factors.vectorD().minCoeff() <= 0)
    throw Error("elasticity: the band is not rigid (a node hangs loose)");
  const Eigen::VectorXd solution = factors.solve(load);
  const auto displacement = [&](int i) {
    const std::size_t x = 2 * static_cast<std::size_t>(i);
    return Vec2(column[x] < 0 ? held[x] : solution[column[x]],
                column[x + 1] < 0 ? held[x + 1] : solution[column[x + 1]]);
  };

  double force = 0;
  each_spring([&](int i, const Spring& spring) {
    const int j = spring.other;
    const double pull = (stiffness * tangent_block(band, i, spring) * (displacement(j) - displacement(i))).y();
    if (upper[static_cast<std::size_t>(i)]) force -= pull;
    if (upper[static_cast<std::size_t>(j)]) force += pull;
  });
  std::vector<double> x, y, ux, uy;
  for (int i = 0; i < nodes; ++i) {
    const Vec2& p = band.points[static_cast<std::size_t>(i)];
    if (std::abs(p.y() - (low.y() + high.y()) / 2) > height / 4) continue;
    x.push_back(p.x());
    y.push_back(p.y());
    ux.push_back(displacement(i).x());
    uy.push_back(displacement(i).y());
  }
  if (x.size() < 10) throw Error("elasticity: the middle half of the band has fewer than 10 nodes");
  const double middle_strain = slope(y, uy);
  return {force / width / middle_strain, -slope(x, ux) / middle_strain};
}

}  // namespace ricochet
