#pragma once
#include "impact/launch/start.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// A body of revolution moves along its axis alone, and meets a plane or another one. Throws a FieldError that names
/// what breaks the symmetry.
void check_symmetry(const Scene& scene, const Solids& solids);

}  // namespace ricochet
