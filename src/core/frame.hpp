#pragma once
// What can be seen of an impact, as plain data: the engine makes frames, a trajectory file keeps them, the renderer
// draws them.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec2.hpp"

namespace ricochet {

/// What stays the same over a sequence. Nodes are those of the projectile, then those of the target.
struct FrameMesh {
  int projectile_nodes = 0;
  std::array<double, 2> mass{1, 1};         ///< [body] of a node [m0]
  double psi1 = 0;                          ///< tangent of the incident angle, NaN if the launch has none
  Points rest;                              ///< [node] [R]
  std::vector<bool> anchored;               ///< [node]
  std::vector<std::array<int, 2>> springs;  ///< [spring] its ends
  std::vector<double> length, stiffness;    ///< [spring] rest length [R], ka [m0 c^2/R^2]
  std::array<double, 2> quartic{0, 0};      ///< [body] kb / ka [1/R^2]
  std::vector<std::array<int, 3>> triangles;
  std::array<std::vector<int>, 2> rims;  ///< [body] closed chain of nodes, counter-clockwise

  int nodes() const { return static_cast<int>(rest.size()); }
  int body_of(int node) const { return node < projectile_nodes ? 0 : 1; }
};

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
  std::vector<Eigen::Vector2f> position, velocity, contact_force;  ///< [node] [R, c, m0 c^2/R]
  std::vector<float> elongation;   ///< [spring] elastic, NaN if broken; empty if the places tell it [R]
  std::array<double, 8> energy{};  ///< [m0 c^2]
};

}  // namespace ricochet
