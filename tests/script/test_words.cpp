// Words on the command line and in scripts that mean something else than they say.

#include <catch2/catch.hpp>

#include "script/program.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

constexpr const char* parameters = R"(local ricochet = require "ricochet"
local p = ricochet.parameters { v = { { 0.1, 0.2 }, doc = "speeds" }, n = { 3, int = true }, x = { 0.5 } }
print(table.concat(p.v, " "), p.n, p.x)
)";

std::string impact_with(const std::string& fields) {
  return "local ricochet = require 'ricochet'\nprint(ricochet.scene { projectile = ricochet.disk { nodes = 60 }, "
         "target = ricochet.wall { nodes = 150, width = 4 }, " +
         fields + " }:run().status)\n";
}

}  // namespace

TEST_CASE("a decimal comma is told, not taken for a list of two numbers") {
  const Workplace here;
  here.write("s.lua", parameters);
  CHECK(
      here.run("s.lua v=0,05").first_line() ==
      "error: parameter 'v' is a list, in which '0,05' has a number of its own after the comma; write decimals with a "
      "point");
  CHECK(here.run("s.lua x=0,5").first_line() ==
        "error: parameter 'x' must be a number, with a point before its decimals, is '0,5'");
  CHECK(here.run("s.lua v=0,5").out == "0.0 5.0\t3\t0.5\n");
}

TEST_CASE("options that count say which whole numbers they take") {
  const Workplace here;
  here.write("s.lua", parameters);
  CHECK(here.run("s.lua --threads 2.5").first_line() ==
        "error: --threads: 2.5 is no whole number of 1 to 1024; see ricochet --help");
  CHECK_THAT(here.run("s.lua --batch many").first_line(),
             Catch::Matchers::Contains("many is no whole number of 1 to "));
}

TEST_CASE("an angle that only radians can mean is named") {
  const Workplace here;
  CHECK_THAT(
      here.script(impact_with("launch = { angle = math.pi / 3 }")).err,
      Catch::Matchers::Contains("warning: 'angle' is in degrees, and 1.0472 are given; for math.pi/3 write 60\n"));
  CHECK(here.script(impact_with("launch = { angle = 1.05 }"), "--force").err.empty());
  CHECK_THAT(here.script(impact_with("method = 'Verlet'"), "--force").first_line(),
             Catch::Matchers::EndsWith("(did you mean 'verlet'?)"));
}

TEST_CASE("scripts in UTF-16 are named, one is read from standard input, and links that lead nowhere are told") {
  const Workplace here;
  const std::string text = "print(1)\n";
  std::string little, big;
  for (const char c : text) {
    (little += c) += '\0';
    (big += '\0') += c;
  }
  for (const std::string& bytes : {"\xff\xfe" + little, "\xfe\xff" + big, little, big}) {
    here.write("s.lua", bytes);
    CHECK(here.run("s.lua").first_line() == "error: s.lua: is written in UTF-16; save it as UTF-8");
  }
  here.write("s.lua", parameters);
  CHECK(here.shell("ricochet run - n=7 <s.lua").out == "0.1 0.2\t7\t0.5\n");
  CHECK_THAT(here.shell("echo 'print(nothing)' | ricochet run -").first_line(),
             Catch::Matchers::StartsWith("error: -:1: unknown name 'nothing'"));
  here.shell("ln -s loop.lua loop.lua; ln -s gone.lua link.lua");
  CHECK(here.run("loop.lua").first_line() == "error: cannot read loop.lua: Too many levels of symbolic links");
  CHECK(here.run("link.lua").first_line() == "error: link.lua is a link to gone.lua, which is not there");
}

TEST_CASE("the module's names cannot be set, and are listed by pairs()") {
  const Workplace here;
  CHECK(here.script("local ricochet = require 'ricochet'\nricochet.disk = 5\n").first_line() ==
        "error: s.lua:2: the module's 'disk' cannot be set; write: local disk = ...");
  CHECK(here.script("local n = 0 for name in pairs(require 'ricochet') do n = n + 1 end print(n > 30)").out ==
        "true\n");
}

TEST_CASE("usage lines are what one types") {
  const Workplace here;
  CHECK_THAT(here.shell("ricochet run --help").out, Catch::Matchers::Contains("Usage: ricochet run [OPTIONS] "));
  for (const char* command : {"run", "accuracy", "effects"}) {
    const std::string help = here.shell(std::string("ricochet ") + command + " --help").out;
    CHECK_THAT(help, Catch::Matchers::Contains("--threads") && Catch::Matchers::Contains("--quiet"));
  }
}

TEST_CASE("a function of places that returns neither true nor false holds no node") {
  const Workplace here;
  CHECK_THAT(
      here.script("local ricochet = require 'ricochet'\nricochet.body { outline = { { -1, -1 }, { 1, -1 }, { 1, 1 } }, "
                  "nodes = 60, anchored = function() return 'no' end }\n")
          .first_line(),
      Catch::Matchers::Contains("'anchored': the function must return true or false, gave a string ('no') at ("));
}

TEST_CASE("rows that a script has changed are blamed on the script's line") {
  const Workplace here;
  const Ended ended = here.script(std::string(small_sweep) +
                                      "for _, row in ipairs(rows) do row.e = 'x' end\n"
                                      "rows:summary { by = 'psi1', of = { 'e' } }\n",
                                  "samples=1 --quiet");
  CHECK(ended.first_line() == "error: s.lua:16: summary: column 'e' holds no numbers");
}

TEST_CASE("pairs() has the same order in every run: numbers, then names, each rising") {
  const Workplace here;
  const char* text = R"(local t = { zeta = 1, alpha = 2, [10] = 3, [2.5] = 4, gamma = 5, "one", "two" }
local keys = {}
for k, v in pairs(t) do keys[#keys + 1] = tostring(k); t[k] = nil end
print(table.concat(keys, " "), next(t))
local odd = setmetatable({}, { __pairs = function() return function(_, k) if not k then return 1, 2 end end end })
for k, v in pairs(odd) do print(k, v) end
print((pcall(pairs)))
)";
  const Ended ended = here.script(text);
  INFO(ended.err);
  CHECK_THAT(ended.out, Catch::Matchers::StartsWith("1 2 2.5 10 alpha gamma zeta\tnil\n1\t2\nfalse\n"));
  CHECK(here.run("s.lua").out == ended.out);
}

TEST_CASE("what says nothing of modes is refused by name") {
  const Workplace here;
  const auto first_line = [&](const std::string& fields) {
    return here
        .script("local ricochet = require 'ricochet'\nricochet.disk { interior = 'modes', nodes = 60, " + fields +
                " }\n")
        .first_line();
  };
  CHECK(first_line("E = 1, nu = 0.3, law = 'linear'") ==
        "error: s.lua:2: disk: 'law': says nothing of modes, which are small vibrations about rest; leave it out");
  CHECK(first_line("modes_of = 'springs', quartic = 1") ==
        "error: s.lua:2: disk: 'quartic': says nothing of modes, which are small vibrations about rest; leave it out");
  CHECK(first_line("modes_of = 'springs', E = 1") ==
        "error: s.lua:2: disk: 'E': is of elements; give modes_of = \"elements\" (or leave modes_of out)");
}

TEST_CASE("a start behind a tower on the line of flight is refused, unless its height is given") {
  const Workplace here;
  const auto with = [&](const std::string& launch) {
    return here.script(R"(local ricochet = require "ricochet"
local tower = { { -4, -1 }, { 4, -1 }, { 4, 0 }, { -1.6, 0 }, { -1.6, 6 }, { -2.4, 6 }, { -2.4, 0 }, { -4, 0 } }
local row = ricochet.scene { projectile = ricochet.disk { nodes = 60 },
  target = ricochet.body { outline = tower, nodes = 150 },
  launch = { speed = 0.1, at = 2, )" +
                           launch + " }, time_limit = 40 }:run()\nprint(row.status)\n",
                       "--quiet");
  };
  CHECK(with("psi1 = 1").first_line() ==
        "error: s.lua:5: scene: 'launch': the flight to the start passes through the target; give height, to start "
        "below what is in the way, or another at, angle or psi1");
  for (const char* free : {"psi1 = 1, height = 1", "psi1 = 0"}) CHECK_FALSE(with(free).out.empty());
}

TEST_CASE("what is undefined is shown as such, and accuracy tells steps in the scene's units") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local flat = { projectile = ricochet.disk { nodes = 60, interior = "modes", E = 1e4, nu = 0.3 },
  target = ricochet.plane {}, launch = { speed = 0.05 } }
ricochet.relevance { scene = ricochet.scene(flat), effects = { ricochet.friction { mu = 0.3 } }, of = { "beta" },
  samples = 2 }
local steel = ricochet.disk { radius = 0.01, nodes = 60, material = ricochet.materials.steel, interior = "elements",
  state = "plane_strain" }
ricochet.accuracy { scene = ricochet.scene { units = "SI", projectile = steel, target = ricochet.plane {},
  launch = { speed = 1 } }, methods = { "verlet" } }
)",
                                  "--quiet");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK(ended.out.find("nan") == std::string::npos);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("- +- -") && Catch::Matchers::Contains("step [s]"));
  CHECK_THAT(here.read("out/s/accuracy.csv"), Catch::Matchers::StartsWith("method,step [s],"));
}

TEST_CASE("a range holds its last value whatever rounding says, and counts as it did") {
  const Ended ended = script_with_module(
      "for _, r in ipairs { { 0.1, 0.3, 0.1 }, { 0.01, 0.2, 0.01 }, { 0, 1, 0.1 }, { 3, 1, -1 }, { 1, 2, 0.3 }, { 2, 1 "
      "} } do\n"
      "  local list = ricochet.range(table.unpack(r))\n  print(#list, list[#list])\nend\n");
  CHECK_THAT(ended.out, Catch::Matchers::StartsWith("3\t0.3\n20\t0.2\n11\t1\n3\t1\n4\t1.9\n0\tnil\n"));
}

TEST_CASE("what a result lacks is told: doubts under --quiet, means of a part of the rows, nothing held") {
  const Workplace here;
  const std::string begin = "local ricochet = require 'ricochet'\n";
  const Ended held = here.script(begin +
                                 "ricochet.rectangle { width = 2, height = 1, nodes = 100, anchored = function(x, y) "
                                 "return x > 5 end }\n");
  CHECK(held.status == 1);
  CHECK_THAT(held.first_line(), Catch::Matchers::Contains("'anchored': is true of no node"));
  const std::string folds =
      "local rows = ricochet.sweep { name = 's', over = { v = { 0.4 } }, scene = function(at) return ricochet.scene { "
      "projectile = ricochet.disk { nodes = 200, placement = 'uniform' }, target = ricochet.plane {}, launch = { speed "
      "= at.v } } end }:run()\nprint(rows[1].folded > 0, rows[1].wall_seconds > 0)\nlocal row = ricochet.scene { "
      "projectile = ricochet.disk { nodes = 60 }, target = ricochet.plane {} }:run()\nprint(row.wall_seconds > 0)\n";
  const Ended quiet = here.script(begin + folds, "--quiet --force");
  INFO(quiet.out << quiet.err);
  CHECK(quiet.out == "true\ttrue\ntrue\n");
  CHECK_THAT(quiet.err, Catch::Matchers::Contains("warning: folded: in 1 of 1 impacts springs folded"));
}
