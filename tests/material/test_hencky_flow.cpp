// A metal by itself: elastic below its yield stress, and on it where it flows.

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "material/hencky_flow.hpp"
#include "material/solid_law.hpp"

using namespace ricochet;

namespace {

using One = Lane<1>;
using F3 = AxialTensor<One>;

One one(double x) { return One::Constant(x); }

HenckyFlow<1> metal(double yield, double hardening, double E = 1, double nu = 0.3) {
  const Lame lame = lame_of(nu, "axisymmetric");
  return {one(lame.lambda * E), one(lame.mu * E), yield, hardening};
}

F3 gradient(double xx, double xy, double yx, double yy, double zz) {
  return {Tensor<One>(one(xx), one(xy), one(yx), one(yy)), one(zz)};
}

F3 moved(const F3& F, const F3& dF, double by) {
  return {Tensor<One>(F.plane.xx + by * dF.plane.xx, F.plane.xy + by * dF.plane.xy, F.plane.yx + by * dF.plane.yx,
                      F.plane.yy + by * dF.plane.yy),
          One(F.zz + by * dF.zz)};
}

double contract(const F3& a, const F3& b) {
  return (a.plane.xx * b.plane.xx + a.plane.xy * b.plane.xy + a.plane.yx * b.plane.yx + a.plane.yy * b.plane.yy +
          a.zz * b.zz)[0];
}

F3 stress(const HenckyFlow<1>& law, const F3& F, PlasticMemory<1> memory = {}) {
  One lost = One::Zero();
  return law.stress(F, memory, lost);
}

/// J, of which the elastic part changes alone.
double volume(const PlasticMemory<1>& m) { return ((m.xx * m.yy - m.xy * m.xy) * m.zz)[0]; }

}  // namespace

TEST_CASE("below its yield stress a metal's stress is the slope of its energy, and a rotation leaves none") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-0.3, 0.3);
  const HenckyFlow<1> law = metal(1e9, 0);
  for (int k = 0; k < 100; ++k) {
    const F3 F = gradient(1 + number(random), number(random), number(random), 1 + number(random), 1 + number(random));
    const F3 dF = gradient(number(random), number(random), number(random), number(random), number(random));
    const double h = 1e-3;
    const auto energy = [&](double by) { return law.energy(moved(F, dF, by * h), {})[0]; };
    const double slope = (energy(-2) - 8 * energy(-1) + 8 * energy(1) - energy(2)) / (12 * h);
    CHECK(contract(stress(law, F), dF) == Catch::Detail::Approx(slope).epsilon(1e-7).margin(1e-9));
  }
  for (const double angle : {1e-3, 0.4, 2.0, 3.1}) {
    const F3 P = stress(law, gradient(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle), 1));
    CHECK(std::sqrt(contract(P, P)) < 1e-14);
  }
}

TEST_CASE("a metal's tangent is that of its stress as long as nothing flows, to the order of its elastic strains") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  const HenckyFlow<1> law = metal(1e9, 0);
  // Stretched plastically by a half along y at constant volume, and then by small elastic strains.
  PlasticMemory<1> memory;
  const double along = 1.5, across = 1 / std::sqrt(along);
  memory.xx = memory.zz = one(1 / (across * across));
  memory.yy = one(1 / (along * along));
  for (const double strain : {1e-3, 1e-4})
    for (int k = 0; k < 20; ++k) {
      const F3 small = gradient(across * number(random), 0, 0, along * number(random), across * number(random));
      const F3 F = moved(gradient(across, 0, 0, along, across), small, strain);
      const F3 dF = gradient(number(random), number(random), number(random), number(random), number(random));
      const double h = 1e-6;
      const F3 ahead = stress(law, moved(F, dF, h), memory), behind = stress(law, moved(F, dF, -h), memory);
      const F3 change = moved(gradient(0, 0, 0, 0, 0), moved(ahead, behind, -1), 1 / (2 * h));
      const F3 miss = moved(change, law.tangent(F, dF, memory), -1);
      CHECK(std::sqrt(contract(miss, miss)) < 10 * strain);
    }
}

TEST_CASE("a bar that is drawn yields at Y, hardens by H, keeps its volume and books the work", "[P1]") {
  // Uniaxial stress: the strain across follows so that nothing pulls there. sigma = Y + H (log strain - sigma/E).
  const double yield = 2e-3, hardening = 0.05, E = 1;
  const HenckyFlow<1> law = metal(yield, hardening);
  PlasticMemory<1> memory;
  One lost = One::Zero();
  double across = 1, work = 0, tau_before = 0, log_before = 0;
  constexpr int steps = 2000;
  for (int k = 1; k <= steps; ++k) {
    const double along = 1 + 0.1 * k / steps;
    const auto pull_across = [&](double x) {
      PlasticMemory<1> trial = memory;
      One none = One::Zero();
      return law.stress(gradient(x, 0, 0, along, x), trial, none).plane.xx[0];
    };
    double low = 0.99 * across, high = 1.01 * across;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = (low + high) / 2;
      (pull_across(middle) < 0 ? low : high) = middle;
    }
    across = (low + high) / 2;
    const F3 F = gradient(across, 0, 0, along, across), P = law.stress(F, memory, lost);
    const double tau = P.plane.yy[0] * along, strain = std::log(along);
    work += 0.5 * (tau + tau_before) * (strain - log_before);
    tau_before = tau;
    log_before = strain;
    const double plastic = memory.strain[0];
    if (plastic > 0) {
      CHECK(tau == Catch::Detail::Approx(yield + hardening * plastic).epsilon(1e-8));
      CHECK(plastic == Catch::Detail::Approx(strain - tau / E).epsilon(1e-8));
    } else {
      CHECK(tau == Catch::Detail::Approx(E * strain).epsilon(1e-8));
    }
    CHECK(volume(memory) == Catch::Detail::Approx(1).epsilon(1e-11));
  }
  const double kept = law.energy(gradient(across, 0, 0, 1.1, across), memory)[0];
  CHECK(memory.strain[0] > 0.08);
  // Of the stress over the plastic strain, and over the elastic one.
  CHECK(lost[0] ==
        Catch::Detail::Approx(yield * memory.strain[0] + hardening / 2 * std::pow(memory.strain[0], 2)).epsilon(1e-8));
  CHECK(kept == Catch::Detail::Approx(tau_before * tau_before / 2 / E).epsilon(1e-8));
  // Trapezoids miss the kink at yield by a step's square.
  CHECK(kept + lost[0] == Catch::Detail::Approx(work).epsilon(1e-6));
}

TEST_CASE("a metal's strains are the logarithms of its principal stretches, small and large") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  const HenckyFlow<1> law = metal(1e9, 0);
  const double mu = law.mu[0], bulk = law.lambda[0] + 2 * mu / 3;
  for (const double size : {1e-6, 1e-3, 0.03, 0.1, 0.3, 0.45})
    for (int k = 0; k < 50; ++k) {
      const F3 F = gradient(1 + size * number(random), size * number(random), size * number(random),
                            1 + size * number(random), 1 + size * number(random));
      const double xx = F.plane.xx[0], xy = F.plane.xy[0], yx = F.plane.yx[0], yy = F.plane.yy[0];
      const double half = (xx * xx + xy * xy - yx * yx - yy * yy) / 2, shear = xx * yx + xy * yy;
      const double mean = (xx * xx + xy * xy + yx * yx + yy * yy) / 2, area = xx * yy - xy * yx;
      const double first = std::log(mean + std::hypot(half, shear)) / 2;
      const double second = std::log(std::abs(area)) - first, third = std::log(F.zz[0]), sum = first + second + third;
      const auto principal = [&](double e) { return 2 * mu * (e - sum / 3) + bulk * sum; };
      const F3 tau = law.kirchhoff(F, {});
      const double a = principal(first), b = principal(second), tolerance = 1e-14;
      CHECK(tau.zz[0] == Catch::Detail::Approx(principal(third)).margin(tolerance));
      CHECK((tau.plane.xx + tau.plane.yy)[0] == Catch::Detail::Approx(a + b).margin(tolerance));
      CHECK(std::hypot((tau.plane.xx - tau.plane.yy)[0], 2 * tau.plane.xy[0]) ==
            Catch::Detail::Approx(a - b).margin(tolerance));
    }
}

TEST_CASE("what flows at once, little or far, ends on the yield stress, and its memory says the same stress again") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const HenckyFlow<1> law = metal(1e-3, 0.1);
  for (const double size : {3e-3, 0.03, 0.1, 0.3})
    for (int k = 0; k < 50; ++k) {
      const F3 F = gradient(1 + size * number(random), size * number(random), size * number(random),
                            1 + size * number(random), 1 + size * number(random));
      PlasticMemory<1> memory;
      One lost = One::Zero();
      law.stress(F, memory, lost);
      if (memory.strain[0] == 0) continue;
      const F3 tau = law.kirchhoff(F, memory);
      const double pressure = (tau.plane.xx + tau.plane.yy + tau.zz)[0] / 3;
      const F3 d = moved(tau, gradient(1, 0, 0, 1, 1), -pressure);
      CHECK(std::sqrt(1.5 * contract(d, d)) == Catch::Detail::Approx(1e-3 + 0.1 * memory.strain[0]).epsilon(1e-10));
      CHECK(volume(memory) == Catch::Detail::Approx(1).epsilon(1e-13));
      const double before = memory.strain[0];
      const F3 again = law.stress(F, memory, lost), first = stress(law, F);
      CHECK(memory.strain[0] == Catch::Detail::Approx(before).epsilon(1e-10));
      CHECK(contract(moved(again, first, -1), moved(again, first, -1)) < 1e-28);
    }
}

TEST_CASE("what has flowed does not flow back, and lanes flow by themselves") {
  const Lame lame = lame_of(0.3, "axisymmetric");
  const HenckyFlow<4> four{Lane<4>::Constant(lame.lambda), Lane<4>::Constant(lame.mu), 1e-3, 0.1};
  const HenckyFlow<1> alone = metal(1e-3, 0.1);
  PlasticMemory<4> together;
  std::array<PlasticMemory<1>, 4> apart;
  Lane<4> lost = Lane<4>::Zero();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-3e-3, 3e-3);
  for (int k = 0; k < 200; ++k) {
    AxialTensor<Lane<4>> F;
    std::array<F3, 4> own;
    for (int lane = 0; lane < 4; ++lane) {
      // The first stays elastic, the last strains farther than short series reach.
      const double size = lane == 0 ? 0.01 : lane == 3 ? 100 : 1;
      own[static_cast<std::size_t>(lane)] = gradient(1 + size * number(random), size * number(random),
                                                     size * number(random), 1 + size * number(random), 1);
      const F3& f = own[static_cast<std::size_t>(lane)];
      F.plane.xx[lane] = f.plane.xx[0];
      F.plane.xy[lane] = f.plane.xy[0];
      F.plane.yx[lane] = f.plane.yx[0];
      F.plane.yy[lane] = f.plane.yy[0];
      F.zz[lane] = f.zz[0];
    }
    const Lane<4> before = together.strain;
    const AxialTensor<Lane<4>> P = four.stress(F, together, lost);
    CHECK((together.strain >= before).all());
    for (int lane = 0; lane < 4; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      One own_lost = One::Zero();
      const F3 same = alone.stress(own[l], apart[l], own_lost);
      CHECK((same.plane.xx[0] == P.plane.xx[lane] && same.plane.xy[0] == P.plane.xy[lane] && same.zz[0] == P.zz[lane]));
      CHECK(apart[l].strain[0] == together.strain[lane]);
    }
  }
  CHECK(together.strain[0] == 0);
  CHECK(together.xx[0] == 1);
  CHECK(together.strain[1] > 0.02);
}
