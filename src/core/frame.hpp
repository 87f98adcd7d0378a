#pragma once
// What can be seen of an impact, as plain data: the engine makes frames, a trajectory file keeps them, the renderer
// draws them.

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "core/vec2.hpp"

namespace ricochet {

/// A line of surface nodes.
struct MeshChain {
  std::vector<int> node;  ///< numbers in the mesh, in order, the inside to the left
  bool closed = true;
};

/// A body's part of a mesh.
struct BodyMesh {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  int first = 0, nodes = 0;         ///< its nodes: first ... first + nodes - 1
  std::vector<double> law;          ///< numbers of its springs' law, as material/spring_law.hpp lists them
  std::vector<MeshChain> surface;   ///< a plane is an open chain of two held nodes, far apart
  std::vector<double> solid_law{};  ///< numbers of its elements' law, as material/solid_law.hpp lists them
  bool axisymmetric = false;        ///< a body of revolution about x = 0, by the half of its section at x >= 0
  /// Of P, S and Rayleigh waves; NaN if the body has none of its own. [c]
  std::array<double, 3> wave_speeds{unknown, unknown, unknown};
};

/// What stays the same over a sequence. Nodes are those of the bodies, one after another; vectors by node lie flat:
/// [dim node + k].
struct FrameMesh {
  int dim = 2;                              ///< of the bodies' space
  Units units;                              ///< of the user, in which pictures write numbers
  std::vector<BodyMesh> bodies;             ///< by index: the projectile first
  double psi1 = 0;                          ///< tangent of the incident angle, NaN if there is none
  double first_touch = BodyMesh::unknown;   ///< when projectile and target first touched [R/c]
  std::vector<std::string> effects{};       ///< what acts beside the bodies, by name
  std::vector<double> rest;                 ///< [dim node + k] [R]
  std::vector<double> mass;                 ///< [node] [m0]
  std::vector<bool> anchored;               ///< [node]
  std::vector<std::array<int, 2>> springs;  ///< [spring] its ends
  std::vector<double> length, stiffness;    ///< [spring] rest length [R], ka [m0 c^2/R^2]
  std::vector<std::array<int, 3>> triangles;
  std::vector<double> modulus;  ///< [triangle] E of an element, 0 of any other; empty without elements [m0 c^2/R^2]
  /// [2 triangle + k] Lame's lambda and mu over E of an element whose body has no one law; 0 of any other, whose
  /// `solid_law` tells them; empty if there is none such.
  std::vector<double> lame{};

  int nodes() const { return static_cast<int>(mass.size()); }
  int body_of(int node) const {
    int body = 0;
    while (node >= bodies[static_cast<std::size_t>(body)].first + bodies[static_cast<std::size_t>(body)].nodes) ++body;
    return body;
  }
};

/// Adds a vector of the plane to flat ones.
template <class Number>
void append(std::vector<Number>& vectors, const Vec2& v) {
  for (int k = 0; k < 2; ++k) vectors.push_back(static_cast<Number>(v[k]));
}

/// Where the energy is, in the order of Frame::energy.
inline constexpr std::array<const char*, 8> frame_energies{"projectile_translation",
                                                           "projectile_rotation",
                                                           "projectile_vibration",
                                                           "target_translation",
                                                           "target_rotation",
                                                           "target_vibration",
                                                           "contact",
                                                           "total"};

/// One moment. Single precision, as trajectory files store it, so that a stored impact gives the same picture as one
/// that runs.
struct Frame {
  double time = 0;  ///< since the rims came within reach of each other; negative in free flight before [R/c]
  std::int64_t step = 0;
  std::vector<float> position, velocity, contact_force;  ///< [dim node + k] [R, c, m0 c^2/R]
  std::vector<float> elongation;  ///< [spring] elastic, NaN if broken; empty if the places tell it [R]
  /// [5 triangle + k] C_p^-1 (xx, xy, yy, zz) and plastic strain of an element; empty unless elements yield.
  std::vector<float> plastic;
  std::array<double, 8> energy{};  ///< [m0 c^2]
};

}  // namespace ricochet
