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

/// A particle in a potential of slope `slope(x)`, run for `steps` steps; the last drift is taken back.
template <class Slope>
std::pair<double, double> run(const Method& method, double x, double v, double h, int steps, Slope&& slope, int* evaluations = nullptr) {
  x += first_drift(method, h) * v;
  for (int i = 0; i < steps; ++i)
    step(method, h, [&](double kick, double drift) {
      v -= kick * slope(x), x += drift * v;
      if (evaluations) ++*evaluations;
    });
  return {x - first_drift(method, h) * v, v};
}

double pendulum(double x) { return std::sin(x); }
double anharmonic(double x) { return x + x * x * x; }
double oscillator(double x) { return x; }

template <class Slope>
double order_of(const Method& method, Slope&& slope) {
  const auto [xr, vr] = run(method, 1.1, 0.3, 4.0 / 16384, 16384, slope);
  const auto error = [&](int steps) {
    const auto [x, v] = run(method, 1.1, 0.3, 4.0 / steps, steps, slope);
    return std::hypot(x - xr, v - vr);
  };
  return std::log2(error(64) / error(128));
}

}  // namespace

TEST_CASE("every method's coefficients sum to one and read the same from both ends") {
  for (const Method& m : methods()) {
    INFO(m.name);
    CHECK(m.drift.size() == m.kick.size() + 1);
    CHECK(std::accumulate(m.drift.begin(), m.drift.end(), 0.0) == Catch::Detail::Approx(1).epsilon(1e-15));
    CHECK(std::accumulate(m.kick.begin(), m.kick.end(), 0.0) == Catch::Detail::Approx(1).epsilon(1e-15));
    for (std::size_t i = 0; i < m.drift.size(); ++i) CHECK(std::abs(m.drift[i] - m.drift[m.drift.size() - 1 - i]) < 1e-15);
    for (std::size_t i = 0; i < m.kick.size(); ++i) CHECK(std::abs(m.kick[i] - m.kick[m.kick.size() - 1 - i]) < 1e-15);
  }
}

TEST_CASE("every method has its order on an oscillator, a pendulum and an anharmonic well") {
  for (const Method& m : methods()) {
    INFO(m.name);
    CHECK(order_of(m, oscillator) == Catch::Detail::Approx(m.order).margin(0.15));
    CHECK(order_of(m, pendulum) == Catch::Detail::Approx(m.order).margin(0.15));
    CHECK(order_of(m, anharmonic) == Catch::Detail::Approx(m.order).margin(0.15));
  }
}

TEST_CASE("every method is bounded below its stability limit and unbounded above") {
  for (const Method& m : methods()) {
    INFO(m.name);
    const auto [x, v] = run(m, 1, 0, 0.99 * m.stability_limit, 100000, oscillator);
    CHECK(std::hypot(x, v) < 100);
    const auto [X, V] = run(m, 1, 0, 1.02 * m.stability_limit, 100000, oscillator);
    CHECK_FALSE(std::hypot(X, V) < 1e6);
  }
}

TEST_CASE("every method evaluates the force as often as it says, and runs backwards") {
  for (const Method& m : methods()) {
    int evaluations = 0;
    const auto [x, v] = run(m, 1, 0.2, 0.05, 100, pendulum, &evaluations);
    CHECK(evaluations == 100 * m.evaluations());
    const auto [back, speed] = run(m, x, -v, 0.05, 100, pendulum);
    CHECK(std::hypot(back - 1, speed + 0.2) < 1e-13);
  }
}

TEST_CASE("the energy of a long run has no trend") {
  for (const Method& m : methods()) {
    const auto energy = [](std::pair<double, double> s) { return s.second * s.second / 2 + s.first * s.first / 2 + std::pow(s.first, 4) / 4; };
    const double start = energy({1.0, 0.0});
    double early = 0, late = 0;
    std::pair<double, double> state{1.0, 0.0};
    for (int block = 0; block < 400; ++block) {
      state = run(m, state.first, state.second, 0.1, 250, anharmonic);
      (block < 200 ? early : late) += (energy(state) - start) / start / 200;
    }
    CHECK(std::abs(late - early) < 1e-3 * std::pow(0.1, m.order - 2));
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
