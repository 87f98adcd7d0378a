#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "body/interior.hpp"
#include "core/error.hpp"
#include "integrate/particle.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

TEST_CASE("every method's coefficients sum to one and read the same from both ends") {
  for (const Method& m : methods()) {
    if (!m.symplectic()) continue;
    INFO(m.name);
    double kicks = 0, drifts = 0;
    for (const Stage& s : m.stages) {
      kicks += s.kick;
      drifts += s.drift;
    }
    CHECK(kicks == Catch::Detail::Approx(1).epsilon(1e-15));
    CHECK(drifts == Catch::Detail::Approx(1).epsilon(1e-15));
    // Kicks and drifts in turn, the part done ahead first and the joined last one without it.
    std::vector<double> whole{m.ahead_drift};
    for (const Stage& s : m.stages) {
      whole.push_back(s.kick);
      whole.push_back(s.drift);
    }
    if (m.ahead_kick != 0) {
      whole.insert(whole.begin(), m.ahead_kick);
      whole.pop_back();
      whole.back() -= m.ahead_kick;
    } else
      whole.back() -= m.ahead_drift;
    for (std::size_t i = 0; i < whole.size(); ++i)
      CHECK(whole[i] == Catch::Detail::Approx(whole[whole.size() - 1 - i]).margin(1e-14));
  }
}

TEST_CASE(
    "the weights of a Runge-Kutta method sum to one, and its abscissae are those of the rule it integrates time by") {
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

TEST_CASE("every method evaluates the force as often as it says, and a symplectic one runs backwards") {
  for (const Method& m : methods()) {
    int evaluations = 0;
    const auto [x, v] = run<long double>(m, 1, 0.2, 0.05, 100, pendulum, &evaluations);
    CHECK(evaluations == 100 * m.evaluations());
    if (!m.symplectic()) continue;
    const auto [back, speed] = run<long double>(m, x, -v, 0.05, 100, pendulum);
    CHECK(std::hypot(back - 1, speed + 0.2) < 1e-13);
  }
}

TEST_CASE("the energy of a long run has no trend, unless the method is not symplectic") {
  for (const Method& m : methods()) {
    if (!m.symplectic()) continue;
    const auto energy = [](std::pair<long double, long double> s) {
      return s.second * s.second / 2 + s.first * s.first / 2 + std::pow(s.first, 4) / 4;
    };
    const long double start = energy({1.0, 0.0});
    long double early = 0, late = 0;
    std::pair<long double, long double> state{1.0, 0.0};
    for (int block = 0; block < 400; ++block) {
      state = run<long double>(m, state.first, state.second, 0.1, 250, anharmonic);
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
      const auto [x, v] = run<long double>(m, 1, 0, 0.3 * m.stability_limit, steps, oscillator);
      return static_cast<double>(std::log(x * x + v * v));
    };
    const double once = -after(1000), twice = -after(2000);
    CHECK(once > 1e-6);
    CHECK(twice == Catch::Detail::Approx(2 * once).epsilon(1e-3));
  }
}

namespace {

using Four = Eigen::Array<long double, 4, 1>;

/// Two masses on a stiff spring that hit the first of two on soft ones, in a line, for a multirate method to move.
/// x: the projectile's far and near mass, the target's rim and inside.
struct Hammer : Particle<Four, Four (*)(const Four&)> {
  explicit Hammer(bool mixes_ = true)
      : Particle{{6, 5, 0, -1},
                 {-1, -1, 0, 0},
                 [](const Four& at) -> Four { return -fast_force(at) - slow_force(at); }},
        mixes(mixes_) {}
  bool mixes;

  static Four contact(const Four& at) {
    const long double push = 5 * std::exp(-5 * (at[1] - at[2]));
    return {0, push, -push, 0};
  }
  static Four fast_force(const Four& at) {
    const long double pull = 150 * (at[0] - at[1] - 1);
    return contact(at) + Four{-pull, pull, 0, 0};
  }
  static Four slow_force(const Four& at) {
    const long double upper = 2 * (at[2] - at[3] - 1), lower = 2 * (at[3] + 1);
    return {0, 0, -upper, upper - lower};
  }

  void displace_fast(long double by) {
    displacement = by * fast_force(x);
    x += displacement;
  }
  void fast(long double kick, long double drift) {
    v += kick * fast_force(x);
    x += Four{drift, drift, drift, 0} * v;
  }
  void displace_slow(long double kick, long double gradient, double mixed) {
    const long double mix = mixes ? mixed * gradient : 0;
    const Four rim{0, 0, 1, 0};
    v += kick * (contact(x + mix * rim * slow_force(x)) - contact(x));
    displacement = gradient * slow_force(x) + mix * rim * contact(x);
    x += displacement;
  }
  void slow(long double kick, long double drift, long double outer_drift) {
    v += kick * slow_force(x);
    put_back();
    x += Four{outer_drift, outer_drift, outer_drift, drift} * v;
  }
};

/// Momentum of the projectile after it.
double rebound(const Method& method, double h, bool mixes = true) {
  Hammer hammer(mixes);
  get_ahead(method, h, hammer);
  for (int i = 0, steps = static_cast<int>(std::lround(18 / h)); i < steps; ++i) step(method, h, hammer);
  return static_cast<double>(hammer.v[0] + hammer.v[1]);
}

}  // namespace

TEST_CASE(
    "the rebound of a stiff projectile from a soft target converges at order 4 by multirate methods, and at 2 without "
    "their mixed term") {
  const double exact = rebound(method_named("blanes_moan_srkn14a"), 0.01);
  CHECK(exact > 0.5);
  for (const Method& m : methods()) {
    if (!m.multirate()) continue;
    const auto order = [&](double share, bool mixes) {
      const double h = share * static_cast<double>(m.stages.size());
      return std::log2(std::abs((rebound(m, h, mixes) - exact) / (rebound(m, h / 2, mixes) - exact)));
    };
    INFO(m.name);
    CHECK(order(0.01, true) == Catch::Detail::Approx(4).margin(0.2));
    CHECK(order(0.005, false) == Catch::Detail::Approx(2).margin(0.2));
  }
}

TEST_CASE("an unknown method is refused with the nearest name") {
  CHECK_THROWS_WITH(method_named("forrest_ruth"), Catch::Matchers::Contains("did you mean 'forest_ruth'"));
}

TEST_CASE("the frequency bound is above the highest frequency, and at most 30 percent above") {
  for (int seed = 1; seed <= 4; ++seed) {
    const auto body = seed % 2 ? disk(120, 1e4, 0.03, seed) : wall(150, 300, 0.03, seed);
    const auto lattice = build_solid(*body);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * lattice->free, 2 * lattice->free);
    for (int i = 0; i < lattice->free; ++i)
      for (int s = lattice->springs()->first[i]; s < lattice->springs()->first[i + 1]; ++s) {
        const int j = lattice->springs()->list[s].other;
        const Vec2 n = (lattice->points[j] - lattice->points[i]).normalized();
        const Eigen::Matrix2d k = body->numbers.stiffness * n * n.transpose();
        K.block<2, 2>(2 * i, 2 * i) += k;
        if (j >= lattice->free) continue;
        K.block<2, 2>(2 * j, 2 * j) += k;
        K.block<2, 2>(2 * i, 2 * j) -= k;
        K.block<2, 2>(2 * j, 2 * i) -= k;
      }
    const double omega =
        std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
    const double bound = frequency_bound(*lattice, body->numbers.stiffness).omega;
    CHECK(bound >= omega);
    CHECK(bound < 1.3 * omega);  // 1.10 to 1.15 for lattices of the paper's size; these are small
  }
}
