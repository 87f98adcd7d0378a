#include "contact/line_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ricochet {
namespace {

using std::numbers::pi;

// F = pi E a^2/(4R).
double force_at(const LinePair& pair, double a) { return pi * pair.modulus * a * a / (4 * pair.radius); }

double approach_at(const LinePair& pair, double a) {
  return a * a / (4 * pair.radius) * (2 * std::log(pair.length / a) - 1);
}

// U = int F d delta with d delta = (a/R) (ln(L/a) - 1) da: (pi E/(16 R^2)) a^4 (ln(L/a) - 3/4).
double energy_at(const LinePair& pair, double a) {
  const double square = a * a / pair.radius;
  return pi * pair.modulus / 16 * square * square * (std::log(pair.length / a) - 0.75);
}

// Where the energy is that much, below `most`: it grows with a, so halving finds it to the last bits.
double half_width_of(const LinePair& pair, double energy, double most) {
  double low = 0, high = most;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (energy_at(pair, middle) < energy ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// From a = 0 to `a`: int d delta / sqrt(v^2 - 2U/m). a (1 - w^2) takes away the root's singularity at the turning.
double time_to(const LinePair& pair, double a, double mass, double speed) {
  constexpr int parts = 400;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double w = (i + 0.5) / parts, at = a * (1 - w * w);
    const double square = speed * speed - 2 * energy_at(pair, at) / mass;
    if (square > 0) sum += at / pair.radius * (std::log(pair.length / at) - 1) / std::sqrt(square) * 2 * a * w;
  }
  return sum / parts;
}

double pressure_of(double force, double a) { return 2 * force / (std::numbers::pi * a); }

// On from `a` as a spring of the stiffness there.
QuasiStaticImpact beyond(const LinePair& pair, double a, double mass, double speed) {
  const double stiffness = pi * pair.modulus / (2 * (std::log(pair.length / a) - 1));
  const double there = force_at(pair, a) / stiffness;
  const double left = speed * speed - 2 * energy_at(pair, a) / mass;
  const double most = std::sqrt(there * there + left * mass / stiffness);
  const double time = time_to(pair, a, mass, speed) + std::sqrt(mass / stiffness) * std::acos(there / most);
  const double force = stiffness * most;
  return {force, approach_at(pair, a) + most - there, a, 2 * time, pressure_of(force, a), false};
}

}  // namespace

LineBody LineBody::block(double modulus, double poisson_ratio, double depth) {
  return {modulus, std::numeric_limits<double>::infinity(), 2 * depth * std::exp(0.5 * (1 - poisson_ratio))};
}

LinePair pressed_together(const LineBody& one, const LineBody& other) {
  const double compliance = 1 / one.modulus + 1 / other.modulus;
  const double share = compliance > 0 ? 1 / one.modulus / compliance : 0.5;
  const double logarithm = share * std::log(one.length) + (1 - share) * std::log(other.length);
  return {1 / compliance, 1 / (1 / one.radius + 1 / other.radius), std::exp(logarithm)};
}

QuasiStaticImpact line_impact(const LinePair& pair, double mass, double speed) {
  const double energy = 0.5 * mass * speed * speed;
  const double most = std::min(pair.radius, 0.25 * pair.length);
  if (energy > energy_at(pair, most)) return beyond(pair, most, mass, speed);
  const double a = half_width_of(pair, energy, most);
  const double force = force_at(pair, a);
  return {force, approach_at(pair, a), a, 2 * time_to(pair, a, mass, speed), pressure_of(force, a), true};
}

}  // namespace ricochet
