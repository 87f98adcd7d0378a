// Properties of every law of springs, over decades of stretch.

#include <catch2/catch.hpp>
#include <cmath>

#include "material/spring_law.hpp"

using namespace ricochet;

namespace {

// The slope of f at x, by five points.
template <class Function>
double slope(Function&& f, double x) {
  const double h = 1e-4 * std::abs(x);
  return (f(x - 2 * h) - 8 * f(x - h) + 8 * f(x + h) - f(x + 2 * h)) / (12 * h);
}

template <SpringLaw Law>
void check_law(const Law& law) {
  for (const double x : {-2.0, -0.3, -1e-3, 1e-4, 0.05, 1.7}) {
    CAPTURE(x);
    CHECK(law.tension(x) == Catch::Detail::Approx(slope([&](double s) { return law.energy(s); }, x)).epsilon(1e-9));
    CHECK(law.tangent(x) == Catch::Detail::Approx(slope([&](double s) { return law.tension(s); }, x)).epsilon(1e-8));
    // Two sums of like terms in another order.
    CHECK(law.scale() * law.scaled_tension(x) == Catch::Detail::Approx(law.tension(x)).epsilon(1e-14));
    const auto [second, third, fourth] = law.series();
    CHECK(x * x * (second + x * (third + x * fourth)) == Catch::Detail::Approx(law.energy(x)).epsilon(1e-13));
  }
  CHECK(law.energy(0.0) == 0);
  CHECK(law.tension(0.0) == 0);
  CHECK(law.tangent(0.0) == 1);  // everything is given per unit of the stiffness at rest
}

}  // namespace

TEST_CASE("energy, tension, tangent and series of every law of springs belong together") {
  check_law(Linear{});
  for (const double q : {1e-100, 1e-3, 7.5, 1e6}) check_law(Quartic{q});
}

TEST_CASE("the quartic law is the paper's, and without its term it is the linear one") {
  CHECK(Quartic{2.0}.tension(0.5) == 0.5 + 2.0 * 0.125);
  CHECK(Quartic{2.0}.energy(0.5) == Catch::Detail::Approx(0.125 + 2.0 * 0.0625 / 4));
  for (const double x : {-2.0, 1e-4, 1.7}) CHECK(Quartic{0.0}.tension(x) == Linear{}.tension(x));
}

TEST_CASE("a law's numbers choose it, and read back as they were written") {
  const SpringLawNumbers quartic{0.25}, linear{0};
  CHECK(law_of(numbers_of(quartic)).quartic == 0.25);
  CHECK(with_spring_law(quartic, [](const auto& law) { return law.tension(2.0); }) == 4);
  CHECK(with_spring_law(linear, [](const auto& law) { return law.tension(2.0); }) == 2);
}
