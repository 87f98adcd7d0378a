#include "shape/triangulate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "shape/sides.hpp"

namespace ricochet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Face =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

// Of all points, without constraints.
Triangulation unconstrained(const Points& points) {
  std::vector<std::pair<Kernel::Point_2, int>> vertices;
  for (std::size_t i = 0; i < points.size(); ++i)
    vertices.emplace_back(Kernel::Point_2(points[i].x(), points[i].y()), static_cast<int>(i));
  Triangulation triangulation;
  triangulation.insert(vertices.begin(), vertices.end());
  if (triangulation.number_of_vertices() != points.size()) {
    std::sort(vertices.begin(), vertices.end());
    const auto twin = std::adjacent_find(vertices.begin(), vertices.end(),
                                         [](const auto& a, const auto& b) { return a.first == b.first; });
    throw Error(fmt::format("two nodes coincide at ({}, {})", twin->first.x(), twin->first.y()));
  }
  return triangulation;
}

Triangle corners_of(const Triangulation::Face_handle& face) {
  return {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
}

bool is_thin(const Points& points, const Triangle& t) {
  const auto place = [&](std::size_t corner) { return points[static_cast<std::size_t>(t[corner])]; };
  const Vec2 a = place(1) - place(0), b = place(2) - place(0), c = place(2) - place(1);
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
  return std::abs(a.x() * b.y() - a.y() * b.x()) < 1e-9 * longest;
}

}  // namespace

std::vector<Triangle> triangulate(const Points& points, const Cells<2>& rim) {
  Triangulation triangulation = unconstrained(points);
  std::vector<Triangulation::Vertex_handle> handles(points.size());
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v)
    handles[static_cast<std::size_t>(v->info())] = v;
  for (const auto& [from, to] : rim)
    triangulation.insert_constraint(handles[static_cast<std::size_t>(from)], handles[static_cast<std::size_t>(to)]);
  for (auto face : triangulation.all_face_handles()) face->info() = side_unseen;
  mark_sides(triangulation, [](const auto& face) -> int& { return face->info(); });

  std::vector<Triangle> triangles;
  for (const auto face : triangulation.finite_face_handles())
    if (face->info() != side_outside) triangles.push_back(corners_of(face));
  return triangles;
}

std::vector<Triangle> triangulate(const Points& points) {
  const Triangulation triangulation = unconstrained(points);
  std::vector<Triangle> triangles;
  for (const auto face : triangulation.finite_face_handles())
    if (const Triangle t = corners_of(face); !is_thin(points, t)) triangles.push_back(t);
  return triangles;
}

}  // namespace ricochet
