// The law of Hertz for two bodies of revolution.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "contact/point_contact.hpp"

using namespace ricochet;

TEST_CASE("a magnesium sphere of 0.1 m that meets a rigid plane at 0.2 m/s is pressed by 7233 N") {
  // 40 GPa, 0.35, 1800 kg/m^3. [Chung & Ooi, Powder Technol. 208, 34 (2011), test 2: force 7.233 kN]
  const double mass = 4.0 / 3 * std::numbers::pi * 1e-3 * 1800;
  const QuasiStaticImpact hertz = point_impact({40e9 / (1 - 0.35 * 0.35), 0.1}, mass, 0.2);
  CHECK(hertz.force == Catch::Detail::Approx(7232.7).epsilon(1e-5));
  CHECK(hertz.in_range);
  CHECK(hertz.approach == Catch::Detail::Approx(hertz.half_width * hertz.half_width / 0.1));
  // All of the kinetic energy is in the contact, (2/5) F delta.
  CHECK(0.4 * hertz.force * hertz.approach == Catch::Detail::Approx(mass * 0.02).epsilon(1e-12));
  CHECK(std::numbers::pi * hertz.half_width * hertz.half_width * hertz.pressure ==
        Catch::Detail::Approx(1.5 * hertz.force));
}

TEST_CASE("by Hertz two equal spheres meet as one does a rigid plane at half of their speed") {
  const PointBody ball{3.0, 1.0}, plane;
  const QuasiStaticImpact one = point_impact(pressed_together(ball, plane), 2.0, 0.01);
  const QuasiStaticImpact two = point_impact(pressed_together(ball, ball), 1.0, 0.02);
  CHECK(two.force == Catch::Detail::Approx(one.force).epsilon(1e-12));
  CHECK(two.approach == Catch::Detail::Approx(2 * one.approach).epsilon(1e-12));
  CHECK(two.time == Catch::Detail::Approx(one.time).epsilon(1e-12));
}
