#include "body/solid.hpp"

#include <algorithm>
#include <numbers>

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
  const Vec2 mean = sum / total_mass();
  return axisymmetric ? Vec2(0, mean.y()) : mean;
}

double Solid::inertia() const {
  const Vec2 middle = centre();
  double sum = 0;
  if (mass.uniform()) {
    for (const Vec2& p : points) sum += (p - middle).squaredNorm();
    return mass.each() * sum;
  }
  for (int i = 0; i < nodes(); ++i) {
    const Vec2 arm = points[static_cast<std::size_t>(i)] - middle;
    // Half of a ring's mass stands off a diameter of it.
    sum += mass[i] * (axisymmetric ? arm.x() * arm.x() / 2 + arm.y() * arm.y() : arm.squaredNorm());
  }
  return sum;
}

double measure_at_rest(const Solid& solid, const Triangle& triangle) {
  const auto place = [&](std::size_t k) { return solid.points[static_cast<std::size_t>(triangle[k])]; };
  const double area = std::abs(cross(Vec2(place(1) - place(0)), Vec2(place(2) - place(0)))) / 2;
  if (!solid.axisymmetric) return area;
  return 2 * std::numbers::pi * ((place(0).x() + place(1).x() + place(2).x()) / 3) * area;
}

double corner_share(const std::array<Vec2, 3>& corner, std::size_t k, bool axisymmetric) {
  const double area = cross(Vec2(corner[1] - corner[0]), Vec2(corner[2] - corner[0])) / 2;
  if (!axisymmetric) return area / 3;
  return 2 * std::numbers::pi * area * (corner[0].x() + corner[1].x() + corner[2].x() + corner[k].x()) / 12;
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
