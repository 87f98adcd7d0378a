#pragma once
// A few degrees of freedom that any method can move, in long double, so that order 6 shows far from rounding.

#include <Eigen/Core>
#include <cmath>
#include <utility>
#include <vector>

#include "integrate/compose.hpp"

namespace ricochet::test {

/// x'' = -slope(x). State: a number, or an array of them.
template <class State, class Slope>
struct Particle {
  State x, v;
  Slope slope;
  int evaluations = 0;
  State displacement = {};

  void kick_and_drift(long double kick, long double drift) {
    ++evaluations;
    v -= kick * slope(x);
    x += drift * v;
  }
  void drift(long double by) { x += by * v; }
  void displace(long double by) {
    ++evaluations;
    displacement = -by * slope(x);
    x += displacement;
  }
  void put_back() { x -= displacement; }

  // All of it is fast: a multirate method is then its own fast part.
  void displace_fast(long double by) { displace(by); }
  void put_back_fast() { put_back(); }
  void fast(long double kick, long double drift) { kick_and_drift(kick, drift); }
  void displace_slow(long double, long double, double) {}
  void slow(long double, long double, long double by) { drift(by); }

  State x0 = {}, v0 = {};
  std::vector<State> velocities = {}, accelerations = {};
  void remember() {
    x0 = x;
    v0 = v;
    velocities.clear();
    accelerations.clear();
  }
  void evaluate(std::size_t) {
    ++evaluations;
    velocities.push_back(v);
    accelerations.push_back(-slope(x));
  }
  void combine(long double h, const std::vector<double>& weights) {
    x = x0;
    v = v0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      x += h * weights[i] * velocities[i];
      v += h * weights[i] * accelerations[i];
    }
  }
};

/// `steps` steps of h, from the beginning of a step to the end of one.
template <class State, class Slope>
std::pair<State, State> run(const Method& method, State x, State v, double h, int steps, Slope&& slope,
                            int* evaluations = nullptr) {
  Particle<State, Slope&> particle{x, v, slope};
  get_ahead(method, h, particle);
  particle.evaluations = 0;
  for (int i = 0; i < steps; ++i) step(method, h, particle);
  if (evaluations) *evaluations = particle.evaluations;
  particle.x -= static_cast<long double>(method.ahead_drift) * h * particle.v;
  particle.v += static_cast<long double>(method.ahead_kick) * h * slope(particle.x);
  return {particle.x, particle.v};
}

inline long double pendulum(long double x) { return std::sin(x); }
inline long double anharmonic(long double x) { return x + x * x * x; }
inline long double oscillator(long double x) { return x; }

}  // namespace ricochet::test
