#pragma once
#include <cmath>

#include "core/vec2.hpp"

namespace ricochet {

/// v turned counter-clockwise by the angle whose cosine and sine are given. Written with a sum in both lines: of c x -
/// s y beside s x + c y GCC 12 makes one fused vfmaddsub even under -ffp-contract=off, and the bits of a spinning scene
/// would depend on processor and optimisation.
inline Vec2 turned(const Vec2& v, double cosine, double sine) {
  return {cosine * v.x() + (-sine) * v.y(), sine * v.x() + cosine * v.y()};
}

/// A rotation in the plane. It alone knows that none leaves a vector as it is.
class Turn {
 public:
  Turn() = default;
  explicit Turn(double angle) : angle_(angle), cosine_(std::cos(angle)), sine_(std::sin(angle)) {}
  Vec2 operator()(const Vec2& v) const { return turned(v, cosine_, sine_); }
  bool none() const { return angle_ == 0; }
  double angle() const { return angle_; }
  /// This turn and one about z by `more`.
  Turn then(double more) const { return Turn(angle_ + more); }

 private:
  double angle_ = 0, cosine_ = 1, sine_ = 0;
};

}  // namespace ricochet
