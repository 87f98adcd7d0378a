#pragma once
// Quantities of a frame that pictures show.

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "material/hencky_flow.hpp"
#include "material/mean_stress.hpp"
#include "material/solid_law.hpp"
#include "material/spring_law.hpp"

namespace ricochet::render {

/// Flat vectors of a mesh as pictures see them: a node's part in the plane.
template <class Number>
Vec2 seen(const FrameMesh& mesh, const std::vector<Number>& vectors, int node) {
  const std::size_t first = static_cast<std::size_t>(mesh.dim) * static_cast<std::size_t>(node);
  return {static_cast<double>(vectors[first]), static_cast<double>(vectors[first + 1])};
}

/// The rigid motion of a body that lies nearest to a frame, and its velocity.
struct Motion {
  Vec2 centre = Vec2::Zero(), rest_centre = Vec2::Zero(), velocity = Vec2::Zero();
  double angle = 0;  ///< turned by since rest, -pi ... pi
  double spin = 0;   ///< [c/R]

  Vec2 moved(const Vec2& rest) const { return centre + Eigen::Rotation2Dd(angle) * (rest - rest_centre); }
};

/// A held body does not move.
Motion motion_of(const FrameMesh& mesh, const Frame& frame, int body);

/// Where the energy is: translation along the normal and along the tangent, spin and vibration of the projectile,
/// target, contact, effects. [m0 c^2]
std::array<double, 7> ledger_parts(const FrameMesh& mesh, const Frame& frame);

/// Where the rims are nearest to each other: the middle between the projectile's rim nodes and their nearest ones on
/// the target, the nearer the heavier. [R]
Vec2 contact_place(const FrameMesh& mesh, const Frame& frame);

/// A plot's quantity, by its name in plot_quantities().
double plotted_value(const std::string& name, const FrameMesh& mesh, const Frame& frame);

/// Quantities of material and springs; what only depends on the mesh is found once.
class Fields {
 public:
  explicit Fields(const FrameMesh& mesh);

  /// A quantity of material_quantities() at every node: the mean over the triangles around it. [node]
  /// Stress of a triangle of area A: (1/A) sum over its springs of T r n n / (how many triangles share the spring), r
  /// the spring's length and n its direction.   [here: the virial theorem] That of an element is P F^T/J,
  /// of one that has flowed by what it remembers.
  std::vector<double> of_material(const std::string& name, const Frame& frame) const;
  /// A quantity of spring_quantities(); NaN for broken springs. [spring]
  std::vector<double> of_springs(const std::string& name, const Frame& frame) const;

  /// The spring opposite to each corner of a triangle, -1 if there is none. [triangle]
  const std::vector<std::array<int, 3>>& sides() const { return sides_; }
  double mean_side_length() const { return mean_length_; }  ///< of triangles, or springs

 private:
  double elongation(const Frame& frame, std::size_t spring, double distance) const;
  std::vector<double> stress(const Frame& frame, bool pressure) const;
  std::vector<double> plastic_strains(const Frame& frame) const;
  SolidLawNumbers solid_law_of_triangle(std::size_t triangle) const;
  template <class Use>
  void each_element(const Frame& frame, Use&& use) const;

  const FrameMesh& mesh_;
  std::vector<SpringLawNumbers> laws_;       // [body]
  std::vector<SolidLawNumbers> solid_laws_;  // [body]
  std::vector<std::array<int, 3>> sides_;
  std::vector<double> shared_by_;  // [spring] how many triangles have it
  std::vector<double> rest_area_;  // [node] of the triangles around
  double mean_length_ = 0;
};

}  // namespace ricochet::render
