#include "shape/mesh.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_criteria_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "shape/sides.hpp"

namespace ricochet {
namespace {

using MeshKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using MeshStructure = CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<MeshKernel>,
                                                           CGAL::Delaunay_mesh_face_base_2<MeshKernel>>;
using MeshTriangulation = CGAL::Constrained_Delaunay_triangulation_2<MeshKernel, MeshStructure>;
using MeshPoint = MeshKernel::Point_2;

constexpr double least_squared_sine = 0.125;  // of the smallest angle, 20.7 degrees
constexpr double longer = 1.15;               // a triangle's longest side over what the field asks for
constexpr int smoothings = 20, smoothings_between = 5;

Vec2 place_of(const MeshPoint& p) { return {p.x(), p.y()}; }

/// The squared sine of the smallest angle, and the longest side over the longest that is allowed, squared.
struct FaceQuality {
  double squared_sine = 1, excess = 0;
  // The too large first, the largest of them before all.
  bool operator<(const FaceQuality& other) const {
    if (excess > 1 || other.excess > 1) return excess > other.excess;
    return squared_sine < other.squared_sine;
  }
};

/// What CGAL's mesher asks of its criteria.
class SizeCriteria : public CGAL::Delaunay_mesh_criteria_2<MeshTriangulation> {
 public:
  using Quality = FaceQuality;
  using Face = MeshTriangulation::Face_handle;

  explicit SizeCriteria(const SizeField& size) : size_(&size) {}

  class Is_bad {
   public:
    explicit Is_bad(const SizeField& size) : size_(&size) {}
    CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const {
      if (quality.excess > 1) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return quality.squared_sine < least_squared_sine ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }
    CGAL::Mesh_2::Face_badness operator()(const Face& face, Quality& quality) const {
      const Vec2 a = place_of(face->vertex(0)->point()), b = place_of(face->vertex(1)->point()),
                 c = place_of(face->vertex(2)->point());
      std::array<double, 3> sides{(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
      std::sort(sides.begin(), sides.end());
      const double twice_area = cross(Vec2(b - a), Vec2(c - a)), allowed = longer * (*size_)((a + b + c) / 3);
      quality = {twice_area * twice_area / (sides[1] * sides[2]), sides[2] / (allowed * allowed)};
      return (*this)(quality);
    }

   private:
    const SizeField* size_;
  };
  Is_bad is_bad_object() const { return Is_bad(*size_); }

 private:
  const SizeField* size_;
};

// A place in every triangle that lies in a hole, or beside a concave outline.
std::vector<MeshPoint> places_in_holes(MeshTriangulation& triangulation) {
  std::map<MeshTriangulation::Face_handle, int> side;
  mark_sides(triangulation, [&](const auto& face) -> int& { return side[face]; });
  std::vector<MeshPoint> places;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    if (side[face] != side_outside) continue;
    places.push_back(CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point()));
  }
  return places;
}

// Nodes inside move half way to the mean middle of their triangles, each of which counts by how many of the wanted size
// it holds.
void smooth(const Rim& rim, Points& inner, const SizeField& size) {
  Points points = rim.points;
  points.insert(points.end(), inner.begin(), inner.end());
  std::vector<Triangle> triangles;
  for (int round = 0; round < smoothings; ++round) {
    if (round % smoothings_between == 0) triangles = triangulate(points, rim.cells);
    Points sum(points.size(), Vec2::Zero());
    std::vector<double> weight(points.size(), 0.0);
    for (const Triangle& t : triangles) {
      const auto corner = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k])]; };
      const Vec2 middle = (corner(0) + corner(1) + corner(2)) / 3;
      const double wanted = size(middle),
                   share =
                       std::abs(cross(Vec2(corner(1) - corner(0)), Vec2(corner(2) - corner(0)))) / (wanted * wanted);
      for (const int node : t) {
        sum[static_cast<std::size_t>(node)] += share * middle;
        weight[static_cast<std::size_t>(node)] += share;
      }
    }
    for (std::size_t i = rim.points.size(); i < points.size(); ++i)
      if (weight[i] > 0) points[i] += 0.5 * (sum[i] / weight[i] - points[i]);
  }
  std::copy(points.begin() + static_cast<std::ptrdiff_t>(rim.points.size()), points.end(), inner.begin());
}

// Whether a triangle is bad hangs on its last digits. Rounded to this share of the smallest side, those of a body in
// other units are the same, and so is its mesh.
double rounded(double value) {
  constexpr double digits = 1 << 30;
  return std::round(value * digits) / digits;
}

// Of a rim in units of size.least, from size.fine_at; so is what is returned.
Points mesh_of(const Rim& rim, const SizeField& size) {
  MeshTriangulation triangulation;
  std::vector<MeshTriangulation::Vertex_handle> of_rim;
  for (const Vec2& p : rim.points) of_rim.push_back(triangulation.insert(MeshPoint(p.x(), p.y())));
  for (const auto& [from, to] : rim.cells)
    triangulation.insert_constraint(of_rim[static_cast<std::size_t>(from)], of_rim[static_cast<std::size_t>(to)]);
  const std::vector<MeshPoint> holes = places_in_holes(triangulation);
  CGAL::Delaunay_mesher_2<MeshTriangulation, SizeCriteria> mesher(triangulation, SizeCriteria(size));
  mesher.set_seeds(holes.begin(), holes.end());
  mesher.refine_mesh();
  Points inner;
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v)
    if (!triangulation.are_there_incident_constraints(v)) inner.push_back(place_of(v->point()));
  std::sort(inner.begin(), inner.end(),
            [](const Vec2& a, const Vec2& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
  smooth(rim, inner, size);
  return inner;
}

}  // namespace

Points mesh_interior(const Rim& rim, const SizeField& size) {
  const double unit = size.least;
  Rim scaled = rim;
  for (Vec2& p : scaled.points) {
    p = (p - size.fine_at) / unit;
    p = {rounded(p.x()), rounded(p.y())};
  }
  Points inner = mesh_of(scaled, {1, rounded(size.most / unit), size.grade, Vec2(0, 0), rounded(size.within / unit)});
  for (Vec2& p : inner) p = size.fine_at + unit * p;
  return inner;
}

MeshQuality quality_of(const Points& points, const std::vector<Triangle>& triangles) {
  MeshQuality quality;
  quality.shortest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    const auto corner = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k % 3])]; };
    double perimeter = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double side = (corner(k + 1) - corner(k)).norm();
      perimeter += side;
      quality.shortest = std::min(quality.shortest, side);
      quality.longest = std::max(quality.longest, side);
    }
    const double area = std::abs(cross(Vec2(corner(1) - corner(0)), Vec2(corner(2) - corner(0)))) / 2;
    quality.area += area;
    quality.worst = std::min(quality.worst, 12 * std::sqrt(3.0) * area / (perimeter * perimeter));
  }
  return quality;
}

}  // namespace ricochet
