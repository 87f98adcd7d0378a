#include <catch2/catch.hpp>

#include "core/units.hpp"

using namespace ricochet;
using Catch::Matchers::WithinRel;

TEST_CASE("units: a name in R, m0 and c is worth and called what its powers say in SI, and itself on paper") {
  const Units si{.length = 2, .mass = 3, .time = 5, .si = true};
  CHECK_THAT(si.worth("R/c"), WithinRel(5.0, 1e-15));
  CHECK_THAT(si.worth("c^2/R"), WithinRel(2.0 / 25, 1e-15));
  CHECK_THAT(si.worth("m0 c^2/R^2"), WithinRel(3.0 / 25, 1e-15));
  CHECK_THAT(si.worth("1/R"), WithinRel(0.5, 1e-15));
  CHECK(si.worth("degrees") == 1);
  CHECK(si.worth("s") == 1);
  CHECK(si.worth("") == 1);
  CHECK(si.name("m0 c^2") == "J");
  CHECK(si.name("m0 c") == "N s");
  CHECK(si.name("c/R") == "1/s");
  CHECK(si.name("s") == "s");
  CHECK(si.name("").empty());
  CHECK(si.shown(0.5, "R/c") == "2.5 s");
  CHECK(si.explained("at t = 2 R/c 3 of 4 nodes at 1.5e-3 R moved by 0.5 c; give 0.5 R or 20 c/R, 2 Round") ==
        "at t = 10 s 3 of 4 nodes at 0.003 m moved by 0.2 m/s; give 1 m or 4 1/s, 2 Round");
  const Units paper;
  CHECK(paper.worth("m0 c^2") == 1);
  CHECK(paper.name("m0 c^2") == "m0 c^2");
  CHECK(paper.shown(0.5, "R/c") == "0.5 R/c");
  CHECK(paper.explained("at t = 2 R/c") == "at t = 2 R/c");
}
