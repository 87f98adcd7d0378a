#pragma once
// A body as a script describes it: plain data, from which a Solid is built.

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "core/vec2.hpp"
#include "material/material.hpp"
#include "material/spring_law.hpp"
#include "shape/size_field.hpp"
#include "shape/surface.hpp"

namespace ricochet {

/// The paper's: 800 nodes of m0 in a disk of radius R. [m0/R^2]
inline constexpr double usual_density = 800 / std::numbers::pi;

/// Of a body whose number of modes is left to the program.
inline constexpr int most_modes = 2000;

/// What describes a body of elements beside its outline. Units: R, m0, c.
struct ElementNumbers {
  double E = not_given;   ///< Young's modulus, times a plane's thickness; as `stiffness` of the body, once it is read
  double nu = not_given;  ///< Poisson's ratio
  std::string state = "plane_stress";
  std::string law = "polynomial";
  double h_min = not_given;  ///< of a mesh that is fine where it matters; without it nodes are placed as in a lattice
  double h_max = not_given;
  double grade = 0.15;
  double fine_within = not_given;  ///< ten times h_min unless given
  std::string mesh = "delaunay";

  static const std::vector<Member<ElementNumbers>>& fields();
};

/// The numbers that describe a body in a closed outline. Units: R, m0, c.
struct BodyNumbers : SpringLawNumbers, ElementNumbers {
  int nodes = 800;
  std::string placement = "poisson_disk";
  std::int64_t seed = 1;
  double stiffness = 1e4;      ///< what scales the interior: ka of springs, E of elements
  double density = not_given;  ///< of the area; `usual_density` where neither it nor `mass` is given
  double mass = not_given;     ///< of every node
  double roughness = 0;
  double rim_spacing = not_given;  ///< that of the lattice unless given
  double margin = 0;
  double angle = 0;
  double prestress = 0;
  std::string interior = "springs";
  std::string triangulation = "clipped";
  std::string crossing = "refuse";
  int modes = 0;  ///< of interior "modes": how many, the slowest first; 0: all, up to most_modes
  std::string modes_of = "elements";

  static const std::vector<Member<BodyNumbers>>& fields();
  bool rigid() const { return interior == "rigid"; }
  bool of_modes() const { return interior == "modes"; }
  /// Or of modes of a body of elements.
  bool of_elements() const { return interior == "elements" || (of_modes() && modes_of == "elements"); }
  /// Its outline is the half at x >= 0 of a section through the axis x = 0; E and density are then of space, in m0
  /// c^2/R^3 and m0/R^3.
  bool axisymmetric() const { return state == "axisymmetric"; }
  bool meshed() const { return h_min == h_min; }  ///< by h_min, h_max and grade
  bool by_hull() const { return placement == "hull"; }
  bool plain() const { return triangulation == "plain"; }
  bool crossed() const { return meshed() && mesh == "crossed"; }  ///< see shape/crossed.hpp
  /// Of the area; NaN if every node has a mass of its own accord.
  double area_density() const;
};

/// All places are those before the body is turned by its angle. `anchored`, `node_stiffness`, `node_density` and
/// `node_nu` hold what the script's functions said of each planned node, evaluated once; empty where no function was
/// given.
struct Body {
  Points outline;  ///< simple, counter-clockwise
  BodyNumbers numbers;
  std::vector<bool> anchored;          ///< [plan node]
  std::vector<double> node_stiffness;  ///< [plan node] of springs, or E of elements, in m0 c^2 / R^2
  std::vector<double> node_density{};  ///< [plan node], in m0 / R^2
  std::optional<Plane> plane{};        ///< a rigid half-space instead of all this
  std::vector<Points> holes{};         ///< simple, clockwise, inside the outline and outside of each other
  Points points{};                     ///< nodes that were given, instead of placed ones
  std::vector<std::string> files{};    ///< hashes of the files that points were read from
  /// Which lattice of its seed it is, if it passes over those whose rough rims cross themselves: how many these are.
  int passed_over = 0;
  Vec2 velocity = Vec2::Zero();   ///< a target's own, before the impact [c]
  double spin = 0;                ///< the same [c/R]
  std::optional<Vec2> fine_at{};  ///< where a mesh is finest; at the lowest point of the outline unless given
  /// What its stiffness and mass were made from; nothing if they were given. [m0 c^2/R^2, m0/R^2]
  std::optional<PlaneMaterial> material{};
  std::vector<double> node_nu{};  ///< [plan node] of elements; their mean is the numbers' nu

  /// How large the triangles of a meshed body are.
  SizeField size_field() const;
  bool rigid() const { return plane || numbers.rigid(); }
  int moving_nodes() const { return rigid() ? 0 : numbers.nodes; }  ///< about as many as are computed

  /// Everything that fixes the body except its stiffness number, which only scales it: bodies of equal geometry share
  /// one solid.
  std::string geometry_text() const;
};

/// What a scene calls a body of its list: projectile, target, body 3, ...
std::string body_name(std::size_t body);

}  // namespace ricochet
