#include "body/elasticity.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "body/tangent.hpp"
#include "core/error.hpp"
#include "shape/placement.hpp"

namespace ricochet {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr double strain = 1e-3;

std::size_t entry(int i) { return static_cast<std::size_t>(i); }

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

struct Extent {
  Vec2 low, high;
  double width() const { return high.x() - low.x(); }
  double height() const { return high.y() - low.y(); }
};

Extent extent_of(const Points& points) {
  Extent extent{points[0], points[0]};
  for (const Vec2& p : points) {
    extent.low = extent.low.cwiseMin(p);
    extent.high = extent.high.cwiseMax(p);
  }
  return extent;
}

/// Degrees of freedom: x of every node, y of those between the grips; one x is held so that the band cannot slide away.
struct Grips {
  std::vector<int> column;   ///< [coordinate] of the unknown, -1 where it is held
  std::vector<double> held;  ///< [coordinate] displacement where it is
  std::vector<bool> upper;   ///< [node] in the upper grip
  int unknowns = 0;
};

Grips grip(const Solid& band, const Extent& extent) {
  const double grip = std::sqrt(extent.width() * extent.height() / band.nodes());  // one spacing
  Grips g{std::vector<int>(entry(band.coordinates()), -1), std::vector<double>(entry(band.coordinates()), 0.0),
          std::vector<bool>(entry(band.nodes()), false)};
  int gripped = 0;
  for (int i = 0; i < band.nodes(); ++i) {
    const double y = band.points[entry(i)].y();
    const bool in_lower = y < extent.low.y() + grip / 2;
    const bool in_upper = y > extent.high.y() - grip / 2;
    g.upper[entry(i)] = in_upper;
    if (in_lower || in_upper) {
      g.held[entry(2 * i + 1)] = strain * (y - extent.low.y());
      if (gripped++ > 0) g.column[entry(2 * i)] = g.unknowns++;  // the first gripped node is the one held along x
    } else {
      g.column[entry(2 * i)] = g.unknowns++;
      g.column[entry(2 * i + 1)] = g.unknowns++;
    }
  }
  return g;
}

// Calls `use(row, column, value)` for every entry of a sparse matrix.
template <class Use>
void each_entry(const Matrix& matrix, Use&& use) {
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Matrix::InnerIterator entry(matrix, column); entry; ++entry)
      use(static_cast<int>(entry.row()), column, entry.value());
}

/// [coordinate] displacements in equilibrium.
std::vector<double> equilibrium(const Matrix& stiffness, const Grips& g) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(g.unknowns);
  each_entry(stiffness, [&](int of, int by, double value) {
    const int row = g.column[entry(of)], column = g.column[entry(by)];
    if (row < 0) return;
    if (column >= 0)
      entries.emplace_back(row, column, value);
    else
      load[row] -= value * g.held[entry(by)];
  });
  Matrix system(g.unknowns, g.unknowns);
  system.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Matrix> factors(system);
  if (factors.info() != Eigen::Success || factors.vectorD().minCoeff() <= 0)
    throw Error("elasticity: the band is not rigid (a node hangs loose)");
  const Eigen::VectorXd solution = factors.solve(load);
  std::vector<double> displacement = g.held;
  for (std::size_t c = 0; c < displacement.size(); ++c)
    if (g.column[c] >= 0) displacement[c] = solution[g.column[c]];
  return displacement;
}

}  // namespace

PlaneModuli usual_moduli(const BodyNumbers& numbers) {
  if (numbers.of_elements()) {
    const PlaneMaterial plane = in_plane(Material{1, numbers.nu, 1}, numbers.state, 1);
    return {plane.E, plane.nu};
  }
  // Hulls are of uniform points.
  switch (numbers.by_hull() ? Placement::uniform : placement_from_name(numbers.placement)) {
    case Placement::triangular:
      return {2 / std::sqrt(3.0), 1.0 / 3};
    case Placement::poisson_disk:
      return {1.16, 0.33};
    case Placement::uniform:
      break;
  }
  return {1.08, 0.26};
}

Elasticity stretch_band(const Solid& band, double stiffness) {
  const Extent extent = extent_of(band.points);
  const Grips g = grip(band, extent);
  const Matrix K = stiffness * tangent_stiffness(band);
  const std::vector<double> u = equilibrium(K, g);
  const auto displacement = [&](int i) { return Vec2(u[entry(2 * i)], u[entry(2 * i + 1)]); };
  double force = 0;
  each_entry(K, [&](int of, int by, double value) {
    if (of % 2 == 1 && g.upper[entry(of / 2)]) force += value * u[entry(by)];
  });
  std::vector<double> x, y, ux, uy;
  for (int i = 0; i < band.nodes(); ++i) {
    const Vec2& p = band.points[entry(i)];
    if (std::abs(p.y() - (extent.low.y() + extent.high.y()) / 2) > extent.height() / 4) continue;
    x.push_back(p.x());
    y.push_back(p.y());
    ux.push_back(displacement(i).x());
    uy.push_back(displacement(i).y());
  }
  if (x.size() < 10) throw Error("elasticity: the middle half of the band has fewer than 10 nodes");
  const double middle_strain = slope(y, uy);
  return {force / extent.width() / middle_strain, -slope(x, ux) / middle_strain};
}

}  // namespace ricochet
