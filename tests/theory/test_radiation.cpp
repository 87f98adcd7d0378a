// Waves that an impact radiates into a half-space.

#include <catch2/catch.hpp>
#include <cmath>

#include "theory/radiation.hpp"

using namespace ricochet;
using namespace ricochet::theory;
using Catch::WithinAbs;
using Catch::WithinRel;

TEST_CASE("Miller and Pursey's integrals and shares at nu = 1/4 are the reference's") {
  const Shares s = radiation_shares({0.25});
  CHECK_THAT(s.zeta, WithinRel(std::sqrt(3.0), 1e-15));
  CHECK_THAT(s.I1, WithinAbs(0.0369959, 0.51e-7));
  CHECK_THAT(s.I2, WithinAbs(0.00887785, 0.51e-8));
  CHECK_THAT(s.I1 + std::pow(s.zeta, 5) * s.I2, WithinAbs(0.1753879, 0.51e-7));
  CHECK_THAT(9 * (s.I1 + std::pow(s.zeta, 5) * s.I2),
             WithinAbs(1.579, 0.00051));  // the paper's 1.579 contains zeta^4 = 9
  CHECK_THAT(100 * s.P, WithinAbs(6.88, 0.0051));
  CHECK_THAT(100 * s.S, WithinAbs(25.75, 0.0051));
  CHECK_THAT(100 * s.rayleigh, WithinAbs(67.36, 0.0051));
  CHECK_THAT(s.T_body, WithinAbs(0.52616, 0.51e-5));
  CHECK_THAT(s.T_rayleigh, WithinAbs(1.08595, 0.51e-5));
}

TEST_CASE("T at nu = 0.3 is the reference's") {
  CHECK_THAT(radiation_shares({0.3}).T_body, WithinAbs(0.55872, 0.51e-5));
  CHECK_THAT(radiation_shares({0.3}).T_rayleigh, WithinAbs(1.05435, 0.51e-5));
}

TEST_CASE("P and S waves carry the work that the force does, for every Poisson ratio") {
  for (const double nu : {-0.9, -0.4, 0.0, 0.1, 0.25, 0.263, 0.3, 0.4, 0.48}) {
    const Shares s = radiation_shares({nu});
    CHECK_THAT(s.T_body, WithinRel(radiated_by_work({nu}), 1e-9));
    CHECK_THAT(s.P + s.S + s.rayleigh, WithinAbs(1, 1e-14));
    CHECK((s.P > 0 && s.S > 0 && s.rayleigh > 0));
  }
}

TEST_CASE("no wave runs along the surface but Rayleigh's, and no S wave straight down") {
  const double right = std::acos(0.0);
  CHECK_THAT(radiation_pattern({0.25, right}).Theta1, WithinAbs(0, 1e-12));
  CHECK_THAT(radiation_pattern({0.25, right}).Theta2, WithinAbs(0, 1e-7));
  CHECK(radiation_pattern({0.25, 0}).Theta2 == 0);
  CHECK_THAT(radiation_pattern({0.25, 0}).Theta1, WithinRel(1.0 / 3, 1e-14));  // zeta^2/zeta^4
}

TEST_CASE("Hunter's law has exponent 3/5 and the reference constants") {
  CHECK_THAT(hunter_coefficient({0.25}), WithinAbs(1.11, 0.0051));
  CHECK_THAT(hunter_coefficient({0.3}), WithinAbs(1.13, 0.0051));
  RadiatingImpact impact{1, 2, 3, 0.3, 5, 0.2, 0.7, 1e-4};
  const double slow = radiation_loss(impact).one_minus_e2, energy = radiation_loss(impact).energy;
  CHECK_THAT(energy, WithinRel(slow * impact.m * impact.v * impact.v / 2, 1e-12));
  impact.v *= 32;
  CHECK_THAT(radiation_loss(impact).one_minus_e2, WithinRel(8 * slow, 1e-12));
  impact.v = 1e3;
  CHECK_THROWS_AS(radiation_loss(impact), FieldError);
}

TEST_CASE("the printed law has v^(1/5), and its own loss of energy v^(3/5)") {
  PrintedImpact impact{1, 1, 1, 1, 0.25, 1, 1e-3};
  const PrintedLoss slow = radiation_printed(impact);
  impact.v *= 32;
  const PrintedLoss fast = radiation_printed(impact);
  CHECK_THAT(fast.one_minus_e / slow.one_minus_e, WithinRel(2.0, 1e-12));
  CHECK_THAT(fast.one_minus_e_of_energy / slow.one_minus_e_of_energy, WithinRel(8.0, 1e-12));
}
