#include "body/solid.hpp"

#include <algorithm>

namespace ricochet {

double Masses::lightest() const { return uniform() ? each_ : *std::min_element(of_.begin(), of_.end()); }

double Solid::total_mass() const {
  if (mass.uniform()) return mass.each() * nodes();
  double sum = 0;
  for (const double m : mass.of()) sum += m;
  return sum;
}

Vec2 Solid::centre() const {
  if (const Plane* plane = std::get_if<Plane>(&surface)) return plane->offset * in_plane(plane->normal);
  Vec2 sum = Vec2::Zero();
  if (mass.uniform()) {
    for (const Vec2& p : points) sum += p;
    return sum / static_cast<double>(points.size());
  }
  for (int i = 0; i < nodes(); ++i) sum += mass[i] * points[static_cast<std::size_t>(i)];
  return sum / total_mass();
}

double Solid::inertia() const {
  const Vec2 middle = centre();
  double sum = 0;
  if (mass.uniform()) {
    for (const Vec2& p : points) sum += (p - middle).squaredNorm();
    return mass.each() * sum;
  }
  for (int i = 0; i < nodes(); ++i) sum += mass[i] * (points[static_cast<std::size_t>(i)] - middle).squaredNorm();
  return sum;
}

Points surface_points(const Solid& solid) {
  Points points;
  for (const int node : surface_nodes(solid.surface)) points.push_back(solid.points[static_cast<std::size_t>(node)]);
  return points;
}

double mean_cell(const Solid& solid) {
  const auto* mesh = std::get_if<Mesh<2>>(&solid.surface);
  if (!mesh || mesh->cell.empty()) return 0;
  const Points points = surface_points(solid);
  double sum = 0;
  for (const auto& [a, b] : mesh->cell)
    sum += (points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(b)]).norm();
  return sum / static_cast<double>(mesh->cell.size());
}

}  // namespace ricochet
