#include <catch2/catch.hpp>
#include <cmath>

#include "core/rng.hpp"
#include "core/spelling.hpp"

using namespace ricochet;

TEST_CASE("the normal deviate has the moments and the tail of a normal distribution") {
  Random random(42, 0);
  const int n = 400000;
  double sum = 0, square = 0, fourth = 0;
  int beyond_two = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    sum += x;
    square += x * x;
    fourth += x * x * x * x;
    beyond_two += std::abs(x) > 2;
  }
  // Four standard errors of each estimate.
  CHECK(std::abs(sum / n) < 4 / std::sqrt(n));
  CHECK(std::abs(square / n - 1) < 4 * std::sqrt(2.0 / n));
  CHECK(std::abs(fourth / n - 3) < 4 * std::sqrt(96.0 / n));
  CHECK(std::abs(beyond_two / double(n) - 0.0455003) < 4 * std::sqrt(0.0455 / n));
}

TEST_CASE("a seed gives the same numbers for ever") {
  Random random(1, 2);
  CHECK(random.uniform() == 0x1.423f6c1991c4fp-1);
  CHECK(random.normal() == 0x1.5835d653aa088p-1);
}

TEST_CASE("streams of one seed for different purposes differ") {
  CHECK(Random(1, 1).uniform() != Random(1, 2).uniform());
  CHECK(Random(1, 1).uniform() != Random(2, 1).uniform());
}

TEST_CASE("the nearest name is the one a person meant") {
  const std::vector<std::string> names{"nodes", "placement", "radius", "roughness", "seed", "stiffness"};
  CHECK(nearest_names("radus", names) == std::vector<std::string>{"radius"});
  CHECK(nearest_names("Stifness", names) == std::vector<std::string>{"stiffness"});
  CHECK(nearest_names("sede", names) == std::vector<std::string>{"seed"});
  CHECK(nearest_names("rough", names) == std::vector<std::string>{"roughness"});
  CHECK(nearest_names("colour", names).empty());
}
