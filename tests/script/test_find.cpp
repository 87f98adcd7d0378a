// ricochet.find: against known answers, and what it refuses.

#include <catch2/catch.hpp>
#include <sstream>

#include "program.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

/// Looks for where the mean of what `psi1` says of at.x is `value`; psi1 is an outcome as it was asked for.
std::string search(const std::string& psi1, const std::string& range, const std::string& value,
                   const std::string& more = "samples = 4, tolerance = 1e-3") {
  return "local found = ricochet.find { name = \"f\", column = \"psi1\", value = " + value + ", over = { x = " + range +
         " }, " + more +
         ",\n  scene = function(at) return ricochet.scene { projectile = ricochet.disk { nodes = 30, seed "
         "= at.sample }, target = ricochet.plane {}, launch = { psi1 = " +
         psi1 + " } } end }\n";
}

constexpr const char* told =
    "print(\"told:\", found.at, found.se, found.slope, found.low, found.high, found.bracket[1], found.bracket[2], "
    "found.count, found.places, #found.rows)";

}  // namespace

TEST_CASE("find: where a square is 2, by bisection, and its error from the scatter of the lattices") {
  // Every lattice has another multiple of x^2, whose mean is that.
  const std::string multiple = "at.x ^ 2 * (at.sample % 2 == 0 and 1.1 or 0.9)";
  const Ended ended = script_with_module(search(multiple, "{ 1, 3 }", "2") + told);
  INFO(ended.out << ended.err);
  REQUIRE(ended.status == 0);
  CHECK_THAT(ended.out, Contains("f: x = 1.41421 +- 0.041 where the mean of psi1 is 2 (4 lattices at "));
  std::istringstream last(ended.out.substr(ended.out.find("told:") + 5));
  double at = 0, se = 0, slope = 0, low = 0, high = 0, from = 0, to = 0;
  int count = 0, places = 0, rows = 0;
  last >> at >> se >> slope >> low >> high >> from >> to >> count >> places >> rows;
  CHECK(at == Approx(std::sqrt(2)).margin(1e-6));  // by a straight line, far below the tolerance
  CHECK((from <= std::sqrt(2) && to >= std::sqrt(2)));
  CHECK(to - from == Approx(2.0 / 2048));  // the first halving of 2 that is not above 1e-3
  CHECK(slope == Approx(2 * std::sqrt(2)).margin(1e-3));
  const double expected = 0.2 * std::sqrt(4.0 / 3) / 2 / (2 * std::sqrt(2));
  CHECK(se == Approx(expected).epsilon(1e-3));
  CHECK(high - low == Approx(2 * 3.182 * expected).epsilon(1e-3));  // Student's t of 3
  CHECK(count == 4);
  CHECK(places == 13);
  CHECK(rows == 4 * 13);
}

TEST_CASE("find: values that do not lie in the range, or may lie at several places, are refused by name") {
  const auto refused = [](const std::string& text) {
    const Ended ended = script_with_module(text);
    INFO(text << ended.out);
    CHECK(ended.status == 1);
    return ended.err;
  };
  CHECK_THAT(refused(search("at.x", "{ 1, 2 }", "3")),
             Contains("s.lua:2") && Contains("the mean of psi1 is 1 at x = 1 and 2 at 2: 3 does not lie between"));
  CHECK_THAT(refused(search("(at.x - 2) ^ 2", "{ 0, 4.5 }", "5")), Contains("is not monotone") && Contains("one way"));
  CHECK_THAT(refused(search("at.x", "{ 2, 1 }", "1.5")), Contains("over.x must be { low, high }"));
  CHECK_THAT(refused(search("at.x", "{ 1, 2 }, y = { 1, 2 }", "1.5")), Contains("'over' takes one name"));
  CHECK_THAT(refused(search("at.x", "{ 1, 2 }", "1.5", "samples = 4, tolerance = 1e-18")), Contains("50 halvings"));
  CHECK_THAT(refused("local t = {}\n" + search("at.x", "{ 1, 2 }", "1.5", "samples = 4, tolerance = 0.1") +
                     "print(found.speed)"),
             Contains("'speed'"));
  std::string text = search("at.x", "{ 1, 2 }", "1.5");
  text.replace(text.find("\"psi1\""), 6, "\"psi\"");
  CHECK_THAT(refused(text), Contains("an outcome has no 'psi' (did you mean 'psi1' or 'psi2'?)"));
}

TEST_CASE("find: what has no error says why, and lattices without a value everywhere are left out") {
  const Ended alone = script_with_module(search("at.x", "{ 1, 2 }", "1.5", "samples = 1, tolerance = 0.1") +
                                         "print(\"told:\", found.at, found.se ~= found.se, found.reason)");
  INFO(alone.err);
  CHECK_THAT(alone.out, Contains("1.5\ttrue\tone lattice has no scatter"));
  const std::string scattered = "at.x * 0.01 + at.sample % 2";
  const Ended flat = script_with_module(search(scattered, "{ 0, 1 }", "0.505", "samples = 4, tolerance = 0.3") +
                                        "print((\"%.6f\"):format(found.at), found.reason)");
  INFO(flat.err);
  CHECK_THAT(flat.out, Contains("0.500000\t\n"));  // the lattices are common: their scatter does not hide a slope
  std::string cut = search("at.x", "{ 1, 2 }", "1.5", "samples = 3, tolerance = 0.5");
  cut.replace(cut.find("launch ="), 8, "time_limit = at.sample == 2 and at.x > 1.2 and 0.01 or nil, launch =");
  const Ended left_out = script_with_module(cut + told);
  INFO(left_out.err);
  CHECK_THAT(left_out.out, Contains("(2 lattices at 3 values") && Contains("1 lattices are left out"));
}

TEST_CASE("find: refused in a shard by name, goes on by --resume, and is only built with --check") {
  const Workplace here;
  const std::string text =
      "local ricochet = require \"ricochet\"\n" + search("at.x ^ 2", "{ 1, 3 }", "2") + "print(\"bits: \" .. found.at)";
  const Ended shard = here.script(text, "--shard 0/2");
  CHECK(shard.status == 1);
  CHECK_THAT(shard.err, Contains("ricochet.find") && Contains("run it by itself"));
  const Ended first = here.run("s.lua --no-report");
  INFO(first.err);
  REQUIRE(first.status == 0);
  const Ended again = here.run("s.lua --no-report --resume");
  CHECK(bits_of(again) == bits_of(first));
  CHECK_THAT(here.run("s.lua --check").out, Contains("8 scenes are sound"));
}
