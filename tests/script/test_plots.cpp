#include <catch2/catch.hpp>

#include "impact/outcome.hpp"
#include "program.hpp"
#include "record/series.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

// A sweep of two speeds, three gaps and two lattices, of which `limit` decides whether they finish.
std::string swept(const std::string& call, const std::string& limit = "nil") {
  return "local ricochet = require 'ricochet'\n"
         "local rows = ricochet.sweep { name = 's', over = { speed = { 0.05, 0.1 }, gap = { 1, 2, 40 }, sample = { 1, "
         "2 } },\n  units = { gap = 'R' }, scene = function(at) return ricochet.scene {\n"
         "  projectile = ricochet.disk { nodes = 40, roughness = 0.02, seed = at.sample + 10 * math.floor(at.gap) }, "
         "target = ricochet.wall { width = 4, depth = 1, nodes = 80, stiffness = 400 },\n"
         "  launch = { speed = at.speed }, time_limit = " +
         limit + " } end }:run()\n" + call + "\n";
}

std::string gnuplot_of(const std::string& call, const std::string& limit = "nil") {
  const Workplace here;
  const Ended ended = here.script(swept(call, limit), "--quiet");
  INFO(ended.err);
  CHECK(fs::file_size(here.path / "out/s/p.png") > 500);
  return here.read("out/s/p.gp");
}

}  // namespace

TEST_CASE("axes are called in words, with symbol and unit, also of the script's own parameters") {
  const std::string drawn = gnuplot_of("ricochet.plot { rows = rows, x = 'gap', y = { 'contact_time' }, name = 'p' }");
  CHECK_THAT(drawn, Contains("set ylabel 'contact time t_c [R/c]'") && Contains("set xlabel 'gap [R]'"));
}

TEST_CASE("every column of rows and of series has words for an axis") {
  std::string names;
  for (const auto& [field, value] : Outcome::fields()) names += "'" + field.name + "', ";
  for (const auto& [field, value] : Sample::fields()) names += "'" + field.name + "', ";
  std::ifstream file(std::string(RICOCHET_SOURCE) + "/lua/ricochet/words.lua");
  const std::string words(std::istreambuf_iterator<char>(file), {});
  const Workplace here;
  const Ended ended = here.script("local words = (function()\n" + words + "\nend)()\nfor _, name in ipairs { " + names +
                                  "} do if not words.known(name) then print(name) end end\nprint 'all'\n");
  INFO(ended.err);
  CHECK(ended.out == "all\n");
}

TEST_CASE("logarithmic axes have minor ticks, and round labels over a narrow range") {
  const std::string wide = gnuplot_of("ricochet.plot { rows = rows, x = 'gap', y = { 'e' }, log = 'x', name = 'p' }");
  CHECK_THAT(wide, Contains("1, 2, '' 3 1, '' 4 1, 5,") && Contains("'gap [R] (log)'"));
  const std::string narrow = gnuplot_of(
      "ricochet.plot { x = 'x', y = { 'y' }, theory = { y = { { 1, 0.9 }, { 2, 0.995 } } }, log = 'y', name = 'p' }");
  CHECK_THAT(narrow, Contains("set ytics (0.9, 0.92, 0.94, 0.96, 0.98, '' 0.904 1"));
}

TEST_CASE("points of several lines at one x that would cover each other stand side by side, as the caption says") {
  const std::string near =
      gnuplot_of("ricochet.plot { rows = rows, x = 'speed', y = { 'e' }, by = { 'gap', 'sample' }, name = 'p' }");
  CHECK_THAT(near, Contains("$data1 using ($1-") && Contains("$data6 using ($1+") &&
                       Contains("points of the same x stand side by side") && Contains("title 'gap = 1, sample = 2'"));
  const std::string far = gnuplot_of(
      "for i, row in ipairs(rows) do row.own = row.gap + row.sample * 1e-9 end\n"
      "ricochet.plot { rows = rows, x = 'speed', y = { 'own' }, by = 'gap', log = 'y', name = 'p' }");
  CHECK_THAT(far, !Contains("side by side") && Contains("$data1 using 1:2"));
}

TEST_CASE("more than six lines differ in marks and dashes, and their key stands beside the plot") {
  const std::string drawn = gnuplot_of(
      "for i, row in ipairs(rows) do row.own = i end\n"
      "ricochet.plot { rows = rows, x = 'speed', y = { 'e' }, by = 'own', name = 'p' }");
  CHECK_THAT(drawn, Contains("set key outside right top vertical") && Contains("pt 7 ps 0.8 lw 1.5 lc rgb '#0072B2'") &&
                        Contains("pt 4 ps 0.8 lw 1.5 lc rgb '#0072B2'") &&
                        Contains("lines dt 2 lw 1 lc rgb '#0072B2'"));
}

TEST_CASE("single impacts are drawn beside their means if asked for") {
  const std::string drawn =
      gnuplot_of("ricochet.plot { rows = rows, x = 'speed', y = { 'e' }, samples = true, name = 'p' }");
  const std::size_t at = drawn.find("$samples1 << END\n");
  REQUIRE(at != std::string::npos);
  const std::string block = drawn.substr(at, drawn.find("\nEND", at) - at);
  CHECK(std::count(block.begin(), block.end(), '\n') == 12);
  CHECK_THAT(drawn, Contains("title 'single impacts'") && Contains("averaged over gap (3 values), sample (2 values)"));
}

TEST_CASE("a plot without a finished row says so instead of drawing an empty frame") {
  const std::string drawn =
      gnuplot_of("ricochet.plot { rows = rows, x = 'speed', y = { 'e' }, log = 'y', name = 'p' }", "0.1");
  CHECK_THAT(drawn, Contains("'no finished row: of 12 impacts 12 failed'"));
}

TEST_CASE("a summary groups by several columns and says over what it averages") {
  const Workplace here;
  const Ended ended = here.script(swept("local s = rows:summary { by = { 'gap', 'speed' }, of = { 'e' } }\n"
                                        "print(#s, s[2].gap, s[2].speed, s[2].count) s:print()"),
                                  "--quiet");
  INFO(ended.err);
  CHECK_THAT(ended.out,
             Contains("6\t1\t0.1\t2\n") && Contains("gap  speed") && Contains("averaged over sample (2 values)\n"));
}

TEST_CASE("a histogram counts the values of a column in bins of Freedman & Diaconis, or in so many, and says so") {
  // 12 values 1 ... 12: the middle half spans 5.5, and 2 * 5.5 / 12^(1/3) = 4.805; bins begin at multiples of it.
  const std::string own = "for i, row in ipairs(rows) do row.own = i end\n";
  const std::string ruled = gnuplot_of(own + "ricochet.histogram { rows = rows, of = 'own', name = 'p' }");
  CHECK_THAT(ruled, Contains("set boxwidth 4.61") && Contains("bins of 4.8 (by the rule of Freedman & Diaconis)") &&
                        Contains("'n = 12, 0 failed; mean 6.5 ± 1.0'"));
  const auto counts = [](const std::string& drawn) {
    std::istringstream block(drawn.substr(drawn.find("$panel1 << END\n") + 15));
    std::vector<int> list;
    for (std::string middle, count; block >> middle && middle != "END" && block >> count;)
      list.push_back(std::stoi(count));
    return list;
  };
  CHECK(counts(ruled) == std::vector{4, 5, 3});
  const std::string three = gnuplot_of(own + "ricochet.histogram { rows = rows, of = 'own', bins = 3, name = 'p' }");
  CHECK(counts(three) == std::vector{4, 4, 4});
  CHECK_THAT(three, Contains("bins of 3.67 (3 bins)"));
}

TEST_CASE("a histogram has a panel for each value of another column, with its mean, and e = 1 where it can be") {
  const std::string drawn = gnuplot_of(
      "for i, row in ipairs(rows) do row.e = 0.9 + 0.02 * i end\n"
      "ricochet.histogram { rows = rows, by = 'gap', name = 'p' }");
  CHECK_THAT(drawn, Contains("'gap = 1:  n = 4, 0 failed; mean") && Contains("'gap = 40:  n = 4, 0 failed; mean") &&
                        Contains("title 'e = 1'") && Contains("$panel3 using 1:2 with boxes") &&
                        Contains("the median of the panels"));
  const std::string none = gnuplot_of("ricochet.histogram { rows = rows, name = 'p' }", "0.1");
  CHECK_THAT(none, Contains("'n = 0, 12 failed'") && Contains("'no finished row'"));
}

TEST_CASE("a heat map has a mean in each cell, hatches those without a finished row, and says what it averages over") {
  const std::string drawn = gnuplot_of(
      "for i, row in ipairs(rows) do row.own = row.gap + (row.sample == 1 and 1 or -1) end\n"
      "ricochet.heat_map { rows = rows, x = 'speed', y = 'gap', of = 'own', log = 'xy', name = 'p' }",
      "at.gap == 2 and at.speed == 0.1 and 0.1 or nil");
  const std::size_t at = drawn.find("$cells << END\n"), missing = drawn.find("$missing << END\n");
  REQUIRE((at != std::string::npos && missing != std::string::npos));
  const auto lines = [&](std::size_t from) {
    const std::string block = drawn.substr(from, drawn.find("\nEND", from) - from);
    return std::count(block.begin(), block.end(), '\n');
  };
  CHECK(lines(at) == 5);
  CHECK(lines(missing) == 1);
  CHECK_THAT(drawn, Contains("title 'no finished row'") && Contains("set cbrange [1:40]") &&
                        Contains("10 impacts, 2 failed; mean of 2 a cell, averaged over sample (2 values); greatest") &&
                        Contains("standard\u00A0error\u00A01'") && Contains("set xlabel 'speed (log)' enhanced") &&
                        Contains("set ylabel 'gap [R] (log)' enhanced"));
}

TEST_CASE("histograms and heat maps say what is wrong with a column") {
  const Workplace here;
  const auto told = [&](const std::string& call) { return here.script(swept(call), "--quiet --force").err; };
  CHECK_THAT(told("ricochet.histogram { rows = rows, of = 'ee', name = 'p' }"),
             Contains("histogram: the rows have no column 'ee'"));
  CHECK_THAT(told("ricochet.histogram { rows = rows, of = 'status', name = 'p' }"),
             Contains("histogram: column 'status' holds no numbers"));
  CHECK_THAT(told("ricochet.heat_map { rows = rows, x = 'gap', y = 'gap', name = 'p' }"),
             Contains("heat_map: 'x' and 'y' are both 'gap'"));
  CHECK_THAT(told("ricochet.heat_map { rows = rows, x = 'status', y = 'gap', name = 'p' }"),
             Contains("heat_map: 'x'") && Contains("must be a column of numbers"));
}

TEST_CASE("a character that no font has is a box in a plot, and is told") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
ricochet.plot { x = "x", y = { "y" }, name = "odd", title = "e \u{10FF00} \u{E4}",
  theory = { y = { { name = "a line", points = { { 0, 1 }, { 1, 2 } } } } } }
)");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.err, Catch::Matchers::Contains("the font of plots lacks U+10FF00 and draws boxes"));
  CHECK_THAT(here.read("out/s/odd.gp"), Catch::Matchers::Contains("e □ ä"));
}

TEST_CASE("marks of axes in SI are told with prefixes or powers of ten, in every kind of plot") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local rows = ricochet.sweep { name = "s", over = { sample = { 1, 2 }, radius = { 0.004, 0.005 } }, units = { radius = "m" },
  scene = function(at) return ricochet.scene { units = "SI", launch = { speed = 1 }, target = ricochet.plane {},
    projectile = ricochet.disk { radius = at.radius, nodes = 60, seed = at.sample, material = ricochet.materials.steel } } end }:run()
local y = { "contact_time", "after_projectile_vibration", "e" }
ricochet.plot { rows = rows, x = "radius", y = y, name = "p" }
ricochet.plot { rows = rows, x = "radius", y = { "contact_time" }, ylabel = { contact_time = "how long" }, log = "y", name = "own" }
ricochet.histogram { rows = rows, of = "contact_time", name = "h" }
ricochet.heat_map { rows = rows, x = "radius", y = "sample", of = "contact_time", name = "m" }
ricochet.plot { x = "x", y = { "y" }, theory = { y = { { 0, -3e-9 }, { 1, 2e-9 } } }, name = "t" }
)",
                                  "--quiet");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  const std::string plot = here.read("out/s/p.gp");
  CHECK_THAT(plot, Contains("set xlabel 'radius [mm]'") && Contains("set ylabel 'contact time t_c [µs]'"));
  CHECK_THAT(plot, Contains("set xtics ('4.0' 0.004") && Contains("set ytics autofreq"));  // e is told as it is
  CHECK_THAT(here.read("out/s/own.gp"), Contains("'how long, marks in 10⁻⁶' noenhanced") && Contains("set ytics ('"));
  CHECK_THAT(here.read("out/s/h.gp"), Contains("contact time t_c [µs]") && Contains(" µs' at graph"));
  CHECK_THAT(here.read("out/s/m.gp"),
             Contains("set cblabel 'contact time t_c [µs]'") && Contains("set xtics ('4' 0.00"));
  CHECK_THAT(here.read("out/s/t.gp"), Contains("'-3' -3e-09") && Contains("'0' 0") && Contains("[10^{-9}]"));
}
