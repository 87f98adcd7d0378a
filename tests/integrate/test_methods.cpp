#include <catch2/catch.hpp>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "integrate/compose.hpp"
#include "integrate/step_limit.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// A particle in a potential of slope `slope(x)`.
template <class Slope>
struct Particle {
  long double x, v;  // so that order 6 shows far from rounding
  Slope slope;
  int evaluations = 0;
  long double displacement = 0;

  void kick_and_drift(double kick, double drift) { ++evaluations, v -= kick * slope(x), x += drift * v; }
  void drift(double by) { x += by * v; }
  void displace(double by) { ++evaluations, displacement = -by * slope(x), x += displacement; }
  void put_back() { x -= displacement; }

  // All of it is fast: a multirate method is then its own fast part.
  void fast(double kick, double drift, double) { kick_and_drift(kick, drift); }
  void slow(double, double, double) {}

  long double x0 = 0, v0 = 0;
  std::vector<long double> velocities = {}, accelerations = {};
  void remember() { x0 = x, v0 = v, velocities.clear(), accelerations.clear(); }
  void evaluate(std::size_t) { ++evaluations, velocities.push_back(v), accelerations.push_back(-slope(x)); }
  void combine(double h, const std::vector<double>& weights) {
    x = x0, v = v0;
    for (std::size_t i = 0; i < weights.size(); ++i) x += h * weights[i] * velocities[i], v += h * weights[i] * accelerations[i];
  }
};

/// `steps` steps of h, from the beginning of a step to the end of one.
template <class Slope>
std::pair<long double, long double> run(const Method& method, long double x, long double v, double h, int steps, Slope&& slope, int* evaluations = nullptr) {
  Particle<Slope&> particle{x, v, slope};
  get_ahead(method, h, particle);
  particle.evaluations = 0;
  for (int i = 0; i < steps; ++i) step(method, h, particle);
  if (evaluations) *evaluations = particle.evaluations;
  particle.x -= method.ahead_drift * h * particle.v;
  particle.v += method.ahead_kick * h * slope(particle.x);
  return {particle.x, particle.v};
}

long double pendulum(long double x) { return std::sin(x); }
long double anharmonic(long double x) { return x + x * x * x; }
long double oscillator(long double x) { return x; }

// Slope of the error over nine steps from one small enough for the order to show to half of it, all far from rounding.
template <class Slope>
double order_of(const Method& method, Slope&& slope, double x0, double v0) {
  // At several times: at one alone the leading term may happen to vanish.
  const auto error = [&](int steps) {
    long double sum = 0;
    for (int time : {2, 3, 4, 5, 6, 7}) {
      const auto [xr, vr] = run(method_named("blanes_moan_srkn14a"), x0, v0, 1.0 / 256, 256 * time, slope);
      const auto [x, v] = run(method, x0, v0, 1.0 / steps, steps * time, slope);
      sum += std::hypot(x - xr, v - vr);
    }
    return sum;
  };
  int fewest = 1;
  while (!(error(fewest) < (method.order == 2 ? 1e-4 : method.order == 4 ? 1e-9 : method.order == 6 ? 2e-11 : 3e-11))) fewest = fewest * 5 / 4 + 1;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (int i = 0; i < 9; ++i) {
    const int steps = static_cast<int>(fewest * std::exp2(i / 8.0));
    const double u = -std::log(steps), w = static_cast<double>(std::log(error(steps)));
    x += u / 9, y += w / 9, xx += u * u / 9, xy += u * w / 9;
  }
  return (xy - x * y) / (xx - x * x);
}

// The greatest factor by which one step h of an oscillator stretches (x, v), from the trace and determinant of the matrix of the step.
// A symplectic one has determinant 1, and is bounded while its trace lies between -2 and 2; by that the limit is found more sharply.
double growth(const Method& method, double h) {
  const auto [xx, vx] = run(method, 1, 0, h, 1, oscillator);
  const auto [xv, vv] = run(method, 0, 1, h, 1, oscillator);
  const double trace = static_cast<double>(xx + vv), determinant = static_cast<double>(xx * vv - xv * vx);
  if (method.symplectic()) return std::max(1.0, std::abs(trace) / 2);
  const double root = trace * trace / 4 - determinant;
  return root < 0 ? std::sqrt(determinant) : std::abs(trace) / 2 + std::sqrt(root);
}

}  // namespace

TEST_CASE("every method's coefficients sum to one and read the same from both ends") {
  for (const Method& m : methods()) {
    if (!m.symplectic()) continue;
    INFO(m.name);
    double kicks = 0, drifts = 0;
    for (const Stage& s : m.stages) kicks += s.kick, drifts += s.drift;
    CHECK(kicks == Catch::Detail::Approx(1).epsilon(1e-15));
    CHECK(drifts == Catch::Detail::Approx(1).epsilon(1e-15));
    // Kicks and drifts in turn, the part done ahead first and the joined last one without it.
    std::vector<double> whole{m.ahead_drift};
    for (const Stage& s : m.stages) whole.push_back(s.kick), whole.push_back(s.drift);
    if (m.ahead_kick != 0) whole.insert(whole.begin(), m.ahead_kick), whole.pop_back(), whole.back() -= m.ahead_kick;
    else whole.back() -= m.ahead_drift;
    for (std::size_t i = 0; i < whole.size(); ++i) CHECK(whole[i] == Catch::Detail::Approx(whole[whole.size() - 1 - i]).margin(1e-14));
  }
}

TEST_CASE("the weights of a Runge-Kutta method sum to one, and its abscissae are those of the rule it integrates time by") {
  for (const Method& m : methods()) {
    if (m.symplectic()) continue;
    INFO(m.name);
    std::vector<double> c;
    for (const auto& row : m.tableau.a) c.push_back(std::accumulate(row.begin(), row.end(), 0.0));
    for (int power = 0; power < m.order; ++power) {
      double sum = 0;
      for (std::size_t i = 0; i < c.size(); ++i) sum += m.tableau.b[i] * std::pow(c[i], power);
      CHECK(sum == Catch::Detail::Approx(1.0 / (power + 1)).epsilon(1e-13));
    }
  }
}

TEST_CASE("every method has its order on an oscillator, a pendulum and an anharmonic well") {
  for (const Method& m : methods()) {
    INFO(m.name);
    // The terms of order 8 of dop853 are so small that those of order 9 hide them until rounding does.
    const double above = m.name == "dop853" ? 0.9 : 0.15;
    for (const double order : {order_of(m, oscillator, 1.1, 0.3), order_of(m, pendulum, 2.4, 0.9), order_of(m, anharmonic, 1.1, 0.3)}) {
      CHECK(order > m.order - 0.15);
      CHECK(order < m.order + above);
    }
  }
}

TEST_CASE("every method is bounded up to its stability limit, which is where the first unstable window opens") {
  for (const Method& m : methods()) {
    INFO(m.name);
    double largest = 0, beyond = 0;
    for (int i = 1; i <= 100000; ++i) largest = std::max(largest, growth(m, m.stability_limit * i / 100000));
    CHECK(largest <= 1 + 5e-12);
    for (int i = 1; i <= 2000; ++i) beyond = std::max(beyond, growth(m, m.stability_limit + 5e-6 * i));
    CHECK(beyond > 1 + 5e-12);
    const auto [x, v] = run(m, 1, 0, 0.97 * m.stability_limit, 100000, oscillator);
    CHECK(std::hypot(x, v) < 100);
  }
}

TEST_CASE("every method evaluates the force as often as it says, and a symplectic one runs backwards") {
  for (const Method& m : methods()) {
    int evaluations = 0;
    const auto [x, v] = run(m, 1, 0.2, 0.05, 100, pendulum, &evaluations);
    CHECK(evaluations == 100 * m.evaluations());
    if (!m.symplectic()) continue;
    const auto [back, speed] = run(m, x, -v, 0.05, 100, pendulum);
    CHECK(std::hypot(back - 1, speed + 0.2) < 1e-13);
  }
}

TEST_CASE("the energy of a long run has no trend, unless the method is not symplectic") {
  for (const Method& m : methods()) {
    if (!m.symplectic()) continue;
    const auto energy = [](std::pair<long double, long double> s) { return s.second * s.second / 2 + s.first * s.first / 2 + std::pow(s.first, 4) / 4; };
    const long double start = energy({1.0, 0.0});
    long double early = 0, late = 0;
    std::pair<long double, long double> state{1.0, 0.0};
    for (int block = 0; block < 400; ++block) {
      state = run(m, state.first, state.second, 0.1, 250, anharmonic);
      (block < 200 ? early : late) += (energy(state) - start) / start / 200;
    }
    CHECK(std::abs(late - early) < 1e-3 * std::pow(0.1, m.order - 2));
  }
}

TEST_CASE("a method that is not symplectic loses energy for good") {
  for (const Method& m : methods()) {
    if (m.symplectic()) continue;
    INFO(m.name);
    const auto after = [&](int steps) {
      const auto [x, v] = run(m, 1, 0, 0.3 * m.stability_limit, steps, oscillator);
      return static_cast<double>(std::log(x * x + v * v));
    };
    const double once = -after(1000), twice = -after(2000);
    CHECK(once > 1e-6);
    CHECK(twice == Catch::Detail::Approx(2 * once).epsilon(1e-3));
  }
}

TEST_CASE("an unknown method is refused with the nearest name") {
  CHECK_THROWS_WITH(method_named("forrest_ruth"), Catch::Matchers::Contains("did you mean 'forest_ruth'"));
}

TEST_CASE("the frequency bound is above the highest frequency, and at most 30 percent above") {
  for (int seed = 1; seed <= 4; ++seed) {
    const auto body = seed % 2 ? disk(120, 1e4, 0.03, seed) : wall(150, 300, 0.03, seed);
    const auto lattice = build_lattice(*body);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * lattice->free, 2 * lattice->free);
    for (int i = 0; i < lattice->free; ++i)
      for (int s = lattice->first[i]; s < lattice->first[i + 1]; ++s) {
        const int j = lattice->spring[s].other;
        const Vec2 n = (lattice->points[j] - lattice->points[i]).normalized();
        const Eigen::Matrix2d k = body->numbers.stiffness * n * n.transpose();
        K.block<2, 2>(2 * i, 2 * i) += k;
        if (j >= lattice->free) continue;
        K.block<2, 2>(2 * j, 2 * j) += k, K.block<2, 2>(2 * i, 2 * j) -= k, K.block<2, 2>(2 * j, 2 * i) -= k;
      }
    const double omega = std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
    const double bound = frequency_bound(*lattice, body->numbers.stiffness).omega;
    CHECK(bound >= omega);
    CHECK(bound < 1.3 * omega);  // 1.10 to 1.15 for lattices of the paper's size; these are small
  }
}
