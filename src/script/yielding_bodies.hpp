#pragma once
#include <string>

#include "impact/scene.hpp"

namespace ricochet {

/// Whose elements yield where nobody said: the projectile's, or, by materials, those of all that have a yield stress.
std::string usually_on(const Yielding& given, const Scene& scene);

/// Adds one effect for each body that it is on, which may be of different materials.
void add_yielding(const Yielding& given, Scene& scene);

}  // namespace ricochet
