#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/exponential.hpp"
#include "core/logarithm.hpp"
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

TEST_CASE("the short series of exponential and logarithm agree with the C library as far as they reach") {
  Random random(3, 0);
  const double unit = std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 20000; ++i) {
    const double x = std::pow(10, random.uniform(-9, -1)), z = x * x;
    CHECK(std::abs(even_exponential(z) - std::cosh(x)) <= 2 * unit);
    CHECK(std::abs(odd_exponential(z) * x / std::sinh(x) - 1) <= 2 * unit);
    CHECK(std::abs(artanh_ratio(z) * x / std::atanh(x) - 1) <= 2 * unit);
  }
}

TEST_CASE("logarithm agrees with the C library to 2 units in the last place, also near 1") {
  Random random(2, 0);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double far = std::exp(random.uniform(-300, 300)),
                 near = 1 + std::pow(10, random.uniform(-15, -0.5)) * (i % 2 - 0.5);
    for (const double x : {far, near}) {
      const double exact = std::log(x), unit = std::nextafter(std::abs(exact), INFINITY) - std::abs(exact);
      worst = std::max(worst, std::abs(logarithm(x) - exact) / unit);
    }
  }
  CHECK(worst <= 2.5);
  CHECK(logarithm(1) == 0);
  for (const double none : {0.0, -1.0, double(INFINITY), double(NAN)}) CHECK(std::isnan(logarithm(none)));
}
