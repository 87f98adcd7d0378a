#pragma once
// Random scenes of every kind, and whether what became of one is right.

#include <optional>
#include <string>

#include "impact/scene.hpp"

namespace ricochet::test {

struct RandomScene {
  Scene scene;
  bool flat_rigid = false;  ///< a smooth, flat wall of which no node moves, met without spin: e <= 1
  std::string text;         ///< what it is, on one line
};

/// Bodies: disk, square, ellipse, star; stiffness ratio 1e-6 ... 1e6, masses 1e-3 ... 1e3, speed 1e-8 ... 3 c, psi1 0
/// ... 50, roughness 0 ... 0.1 R, spin, quartic constants to 1e3, every method, steps from automatic to wrong. Two of
/// five have a body of elements: every law, plane stress and strain, nu 0 ... 0.45, even and graded meshes; half of
/// those have effects, a quarter let them yield. One scene of eight is of bodies of revolution on a plane, a block or
/// each other, two of five of these yield. The same for ever by its seed.
RandomScene random_scene(std::uint64_t seed);

struct Verdict {
  std::string ending;                ///< a status, or "refused"
  std::optional<std::string> wrong;  ///< what is wrong about it, if anything is
  std::string reason;                ///< what the program says
  std::optional<double> e_n{};       ///< of cold, smooth bodies whose impact finished; NaN where it is undefined
};

/// Runs the scene, for at most `steps` steps, and judges its ending. A result must close its ledger and keep momentum;
/// a status must be true, and its advice must help; a refusal must be of something that is wrong.
Verdict judged(const RandomScene& random, double steps = 1e5);

}  // namespace ricochet::test
