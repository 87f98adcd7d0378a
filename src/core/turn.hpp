#pragma once
#include "core/vec2.hpp"

namespace ricochet {

/// v turned counter-clockwise by the angle whose cosine and sine are given. Written with a sum in both lines: of c x -
/// s y beside s x + c y GCC 12 makes one fused vfmaddsub even under -ffp-contract=off, and the bits of a spinning scene
/// would depend on processor and optimisation.
inline Vec2 turned(const Vec2& v, double cosine, double sine) {
  return {cosine * v.x() + (-sine) * v.y(), sine * v.x() + cosine * v.y()};
}

}  // namespace ricochet
