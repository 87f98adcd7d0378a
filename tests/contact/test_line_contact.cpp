// The law that a launch may ask, against the theories, which know nothing of it.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "contact/line_contact.hpp"
#include "theory/disk.hpp"

using namespace ricochet;
using Catch::Matchers::WithinRel;
using std::numbers::pi;

TEST_CASE("line contact: a disk on a rigid plane has Johnson's force, depth, width and time", "[contact]") {
  const double v = GENERATE(1e-4, 1e-3, 0.01, 0.1, 0.25);
  const double R = 2, E = 3, nu = 0.3, rho = 0.7;
  const auto theirs = theory::disk_impact({R, E, nu, rho, v * std::sqrt(E / (1 - nu * nu) / rho)});
  const LinePair pair = pressed_together(LineBody::disk(E / (1 - nu * nu), R), LineBody::rigid_plane());
  const QuasiStaticImpact ours = line_impact(pair, pi * R * R * rho, v * theirs.c);
  CHECK(ours.in_range);
  CHECK_THAT(ours.force, WithinRel(theirs.F, 1e-9));
  CHECK_THAT(ours.approach, WithinRel(theirs.delta, 1e-9));
  CHECK_THAT(ours.half_width, WithinRel(theirs.a, 1e-9));
  CHECK_THAT(ours.time, WithinRel(theirs.t_c, 1e-3));
}

TEST_CASE("line contact: two disks share the approach by their compliances", "[contact]") {
  const LineBody soft = LineBody::disk(1, 1), hard = LineBody::disk(4, 0.5);
  const LinePair pair = pressed_together(soft, hard);
  CHECK_THAT(pair.modulus, WithinRel(0.8, 1e-12));
  CHECK_THAT(pair.radius, WithinRel(1.0 / 3, 1e-12));
  // Each of the two by Johnson's law: F/(pi E) (2 ln(4R/a) - 1).
  const double F = 0.01, a = std::sqrt(4 * F * pair.radius / (pi * pair.modulus));
  const double theirs = F / pi * ((2 * std::log(4 / a) - 1) + (2 * std::log(2 / a) - 1) / 4);
  CHECK_THAT(F / (pi * pair.modulus) * (2 * std::log(pair.length / a) - 1), WithinRel(theirs, 1e-12));
}

TEST_CASE("line contact: beyond its range force, depth and time go on without a jump", "[contact]") {
  const LinePair pair = pressed_together(LineBody::disk(1, 1), LineBody::rigid_plane());
  const double v = std::sqrt((std::log(4) - 0.75) / 8);  // the contact becomes as wide as the disk
  const QuasiStaticImpact below = line_impact(pair, pi, v * (1 - 1e-9)), above = line_impact(pair, pi, v * (1 + 1e-9));
  CHECK(below.in_range);
  CHECK_FALSE(above.in_range);
  CHECK_THAT(above.force, WithinRel(below.force, 1e-6));
  CHECK_THAT(above.approach, WithinRel(below.approach, 1e-6));
  CHECK_THAT(above.time, WithinRel(below.time, 1e-3));
  CHECK(line_impact(pair, pi, 2 * v).force > below.force);
}
