#include "contact/plastic_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ricochet {

using std::numbers::pi;

PlasticImpact plastic_point_impact(const PointBody& pair, double energy, double pressure) {
  const double depth = std::sqrt(energy / (pi * pair.radius * pressure)), a = std::sqrt(2 * pair.radius * depth);
  const double force = pi * a * a * pressure;
  return {force, a, 0.3 * force * force / (a * pair.modulus)};
}

PlasticImpact plastic_line_impact(const LinePair& pair, double energy, double pressure) {
  const double a = std::cbrt(1.5 * energy * pair.radius / pressure), force = 2 * a * pressure;
  const double logarithm = std::max(1.0, 2 * std::log(pair.length / a) - 1);
  return {force, a, force * force / (2 * pi * pair.modulus) * logarithm};
}

}  // namespace ricochet
