#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "core/exponential.hpp"
#include "core/rng.hpp"

using namespace ricochet;

TEST_CASE("exponential agrees with the C library to 2 units in the last place") {
  Random random(1, 0);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double x = random.uniform(-700, 700), exact = std::exp(x);
    worst = std::max(worst, std::abs(exponential(x) - exact) / (std::nextafter(exact, INFINITY) - exact));
  }
  CHECK(worst <= 2);
  CHECK(exponential(0) == 1);
}
