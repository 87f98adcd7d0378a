// How fast elastic waves run in a body.

#include <catch2/catch.hpp>
#include <cmath>

#include "body/wave_speeds.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("Rayleigh waves at Poisson's ratio 1/4 have c_R^2 = (2 - 2/sqrt(3)) c_S^2") {
  CHECK_THAT(surface_over_shear(1 / std::sqrt(3.0)), WithinAbs(std::sqrt(2 - 2 / std::sqrt(3.0)), 1e-12));
}

TEST_CASE("elements have the wave speeds of their moduli in the plane, and of space in a body of revolution") {
  Body body{Points{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, element_numbers(200, 1e4, 0.3), {}, {}};
  body.numbers.density = 250;
  const double E = 1e4, nu = 0.3, density = 250;
  const WaveSpeeds stress = wave_speeds(body, *build_solid(body));
  CHECK_THAT(stress.pressure, WithinRel(std::sqrt(E / density / (1 - nu * nu)), 1e-3));
  CHECK_THAT(stress.shear, WithinRel(std::sqrt(E / density / 2 / (1 + nu)), 1e-3));
  body.numbers.state = "axisymmetric";
  const WaveSpeeds space = wave_speeds(body, *build_solid(body));
  CHECK_THAT(space.pressure, WithinRel(std::sqrt(E / density * (1 - nu) / (1 + nu) / (1 - 2 * nu)), 1e-3));
  CHECK_THAT(space.shear, WithinRel(std::sqrt(E / density / 2 / (1 + nu)), 1e-3));
}

TEST_CASE("a body whose stiffness differs from place to place has no one speed of waves") {
  Body body{Points{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, numbers(200, 1e4, 0, 1), {}, {}};
  CHECK(wave_speeds(body, *build_solid(body)).pressure > 0);
  body.numbers.prestress = 0.01;
  CHECK(std::isnan(wave_speeds(body, *build_solid(body)).pressure));
}
