#pragma once
#include <string>

#include "impact/launch/start.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// A scene as LAMMPS reads it: a data file and an input script that runs it.
struct LammpsFiles {
  std::string data, input;
};

/// Nodes are atoms 1, 2, ... of the projectile, then of the target, in the lattices' order, as launched; types: 1
/// inside and 2 at the rim of the projectile, 3 and 4 of the target, 5 anchored; molecules 1 and 2. Every spring is a
/// bond of its own type, because its rest length is its own: bond_style class2 carries ka x^2/2 + kb x^4/4 exactly.
/// Units are R, m0 and c (units lj). Contact is V0 exp(-xi d) between rim *nodes* (pair_style born): LAMMPS knows no
/// node on a segment, so impacts agree in kind, free vibration in every digit. `name`: of the files, without .data and
/// in. Throws FieldError if the scene has effects or does not touch.
LammpsFiles lammps_files(const Scene& scene, const Solids& solids, const std::string& name);

}  // namespace ricochet
