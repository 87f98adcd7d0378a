#include "contact/point_contact.hpp"

#include <cmath>
#include <numbers>

namespace ricochet {
namespace {

// 2 int_0^1 dx / sqrt(1 - x^(5/2)).
constexpr double times_of_depth = 2.9432752;

}  // namespace

PointBody pressed_together(const PointBody& one, const PointBody& other) {
  return {1 / (1 / one.modulus + 1 / other.modulus), 1 / (1 / one.radius + 1 / other.radius)};
}

QuasiStaticImpact point_impact(const PointBody& pair, double mass, double speed) {
  const double stiffness = pair.modulus * std::sqrt(pair.radius);
  const double depth = std::pow(15 * mass * speed * speed / (16 * stiffness), 0.4);
  const double force = 4.0 / 3 * stiffness * std::pow(depth, 1.5), a = std::sqrt(pair.radius * depth);
  return {
      force, depth, a, times_of_depth * depth / speed, 3 * force / (2 * std::numbers::pi * a * a), a < pair.radius / 2};
}

}  // namespace ricochet
