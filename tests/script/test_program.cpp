#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <sstream>

#include "effect/catalogue.hpp"
#include "impact/scene.hpp"
#include "script/fields.hpp"
#include "script/functions.hpp"
#include "script/program.hpp"
#include "script/reference.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;

TEST_CASE("a sweep leaves rows, CSV, log and provenance") {
  const Workplace here;
  const Ended ended = here.script(small_sweep);
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("s: 12 of 12 impacts finished; out/s/results.h5"));
  const Table table = read_table(here.path / "out/s/results.h5");
  REQUIRE(table.rows() == 12);
  // Combinations in order, the last name fastest; the sweep's psi1 beside what the impact had.
  CHECK(table.number("sample")->values == std::vector<double>{1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4});
  CHECK(table.number("over_psi1")->values == std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1, 4, 4, 4, 4});
  CHECK(
      std::set<std::string>(table.text("scene_hash")->values.begin(), table.text("scene_hash")->values.end()).size() ==
      12);
  const Provenance provenance = read_provenance(here.path / "out/s/results.h5");
  CHECK(provenance.at("script") == small_sweep);
  CHECK_THAT(provenance.at("required_files"), Catch::Matchers::Contains("ricochet/init.lua"));
  for (const char* name : {"version", "commit", "compiler", "host", "start", "end", "script_hash"})
    CHECK_FALSE(provenance.at(name).empty());
  CHECK_THAT(here.read("out/s/run.log"),
             Catch::Matchers::Contains("12 of 12") && Catch::Matchers::Contains("finished  failed"));
  const std::string csv_text = here.read("out/s/results.csv");
  CHECK(std::count(csv_text.begin(), csv_text.end(), '\n') == 13);
  CHECK_FALSE(fs::exists(here.path / "out/s/parts"));
  const Ended info = here.shell("ricochet info out/s/results.h5");
  CHECK_THAT(info.out, Catch::Matchers::Contains("12 rows") && Catch::Matchers::Contains("finished       12"));
}

TEST_CASE("ricochet accuracy tells what accuracy costs in a script's first scene") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  const Ended ended = here.shell("ricochet accuracy s.lua samples=1");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("what accuracy costs: 210 nodes on") &&
                            Catch::Matchers::Contains("verlet               error of e falls with order") &&
                            Catch::Matchers::Contains("floor "));
  CHECK(fs::file_size(here.path / "out/s/accuracy.png") > 10000);
  CHECK_THAT(
      here.read("out/s/accuracy.csv"),
      Catch::Matchers::StartsWith(
          "method,step [R/c],theta,status,evaluations,seconds [s],energy_drift,momentum_residual,error_of_e\npefrl,"));
  CHECK_FALSE(fs::exists(here.path / "out/s/results.h5"));
  here.write("t.lua", "print(1)");
  CHECK(here.shell("ricochet accuracy t.lua").first_line() == "error: t.lua makes no scene");
}

TEST_CASE("a scene that asks for an accuracy says what was chosen, and its rows keep the estimate") {
  const Workplace here;
  std::string text = small_sweep;
  text.replace(text.find("launch ="), 0, "accuracy = 1e-5, ");
  const Ended ended = here.script(text, "samples=2");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Matches(
                            "accuracy 1e-05 of e: tries steps in 6 of 6 scenes, at the cost of 12 impacts at most\n"
                            "accuracy 1e-05 of e: (verlet|takahashi_imada|multirate_[2358]) with theta [^]*"));
  const Table table = read_table(here.path / "out/s/results.h5");
  for (const double estimate : table.number("error_step")->values) CHECK((estimate > 0 && estimate <= 1e-5));
  CHECK(here.script(text, "samples=2 --quiet --resume").status == 0);  // the same steps again, so the same scenes
}

TEST_CASE("the page of the examples shows what they print") {
  const Workplace here;
  const fs::path examples = fs::path(RICOCHET_SOURCE) / "examples";
  std::ifstream file(examples / "README.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const char* run : {"01_drop.lua", "02_soft_and_hard.lua frames=2"}) {
    const Ended ended = here.run("'" + examples.string() + "'/" + run + " --no-report");
    INFO(ended.out);
    CHECK(ended.status == 0);
    std::istringstream lines(ended.out);
    int told = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.find("e = ") == std::string::npos && !line.starts_with("accuracy 0.001 of e: multirate")) continue;
      ++told;
      CHECK_THAT(page, Catch::Matchers::Contains(line + "\n"));
    }
    CHECK(told > 0);
  }
}

TEST_CASE("an impact that came near to its method's limit is told, with a step that does not") {
  const Workplace here;
  std::string text = small_sweep;
  text.replace(text.find("launch ="), 0,
               "method = 'pefrl', theta = p.theta, contact = { V0 = 150, xi = 300, sides = 'one' }, ");
  text.replace(text.find("samples ="), 0, "theta = { 1.6 }, ");
  const Ended near = here.script(text, "samples=1 theta=2.85 --quiet");
  INFO(near.err);
  CHECK(near.status == 0);
  CHECK_THAT(near.err, Catch::Matchers::Contains("warning: psi1 = ") &&
                           Catch::Matchers::Contains("sample = 1: the frequency bound rose until") &&
                           Catch::Matchers::Contains("% of the longest stable one") &&
                           Catch::Matchers::Contains("(3 impacts came that near); give theta = 1."));
  CHECK(here.script(text, "samples=1 --quiet --force").err.find("longest stable one") == std::string::npos);
}

TEST_CASE("the summary is the mean, deviation and error of finished rows") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local list = {}
for i, v in ipairs { 1, 2, 3, 10 } do list[i] = v end
local rows = ricochet.sweep { name = "s", over = { v = list }, scene = function(at)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = 60, seed = 1 }, target = ricochet.wall { nodes = 150, stiffness = 400, width = 4 },
    launch = { psi1 = at.v == 10 and 3 or 0 }, time_limit = at.v == 10 and 0.5 or nil } end }:run()
for i, row in ipairs(rows) do row.x = row.v end
rows[1].x, rows[2].x, rows[3].x = 1, 2, 6
for _, row in ipairs(rows) do row.g = "all" end
local line = rows:summary { by = "g", of = { "x" } }[1]
print(line.x.mean, ("%.6f"):format(line.x.sd), ("%.6f"):format(line.x.se), line.x.count, line.count, line.failed, rows[4].status)
)",
                                  "--quiet");
  INFO(ended.err);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("3.0\t2.645751\t1.527525\t3\t3\t1\tout_of_time"));
}

TEST_CASE("declared parameters have help, types and values") {
  const Workplace here;
  const char* script = R"(local ricochet = require "ricochet"
local p = ricochet.parameters {
  speed = { 0.1, unit = "c", min = 0, doc = "impact speed" }, angles = { { 0, 1 }, doc = "angles" }, n = { 3, int = true },
  rough = true, kind = { "soft", choices = { "soft", "hard" } } }
print(p.speed, #p.angles, p.angles[1], p.n, p.rough, p.kind)
)";
  CHECK(here.script(script).out == "0.1\t2\t0\t3\ttrue\tsoft\n");
  CHECK(here.script(script, "speed=1/4 angles=7 n=5 rough=false kind=hard").out == "0.25\t1\t7.0\t5\tfalse\thard\n");
  CHECK_THAT(here.script(script, "--help").out,
             Catch::Matchers::Contains("speed=0.1              [c] impact speed; at least 0") &&
                 Catch::Matchers::Contains("angles=0,1"));
  CHECK(here.script(script, "--help").status == 0);
}

TEST_CASE("with --check every scene is built, none runs, and nothing is written") {
  const Workplace here;
  const Ended ended = here.script(small_sweep, "--check");
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("s: 12 scenes are sound"));
  CHECK_FALSE(fs::exists(here.path / "out"));
}

TEST_CASE("stiffness and anchors may depend on the place") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local block = ricochet.body { outline = { {-2, -1}, {2, -1}, {2, 0}, {-2, 0} }, nodes = 150,
  stiffness = function(x, y) return 100 * (2 + y) end, anchored = function(x, y) return y < -0.99 end }
local ball = ricochet.disk { nodes = 60 }
local row = ricochet.scene { projectile = ball, target = block }:run()
print(row.status, row.e > 0.2 and row.e < 1)
)");
  INFO(ended.err);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("finished\ttrue\nreport: "));
  // Every run says what it was computed with.
  CHECK_THAT(ended.out, Catch::Matchers::StartsWith("scene: pefrl, time step 0.0") &&
                            Catch::Matchers::Contains(" and at most ") && Catch::Matchers::Contains("frequency bound"));
}

TEST_CASE("a scene's text and hash follow its content only") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local function scene(psi1, seed) return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = seed }, target = ricochet.wall { nodes = 150 }, launch = { psi1 = psi1 } } end
print(scene(1, 1):hash() == scene(1, 1):hash(), scene(1, 1):hash() == scene(2, 1):hash(), scene(1, 1):hash() == scene(1, 2):hash(), #scene(1, 1):hash())
)");
  CHECK(ended.out == "true\tfalse\tfalse\t32\n");
}

TEST_CASE("frames and a recorded trajectory appear without a display and without environment") {
  const Workplace here;
  here.write("s.lua", R"(local ricochet = require "ricochet"
local scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, stiffness = 400, width = 4 } }
ricochet.animate { scene = scene, frames = 5, size = { 160, 90 } }
ricochet.record { scene = scene, frames = 4 }
)");
  const Ended ended = here.shell(std::string("env -i '") + RICOCHET_PROGRAM + "' run s.lua");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(here.path / "out/s/frames"))
    names.insert(entry.path().filename().string());
  CHECK(names == std::set<std::string>{"000000.png", "000001.png", "000002.png", "000003.png", "000004.png"});
  const std::string first = here.read("out/s/frames/000002.png");
  CHECK(first.find("ricochet.scene") != std::string::npos);
  CHECK(here.shell("ricochet run s.lua --force").status == 0);
  CHECK(here.read("out/s/frames/000002.png") == first);
  CHECK(fs::file_size(here.path / "out/s/trajectory.h5") > 1000);
  CHECK_THAT(here.read("out/s/trajectory.xdmf"),
             Catch::Matchers::Contains("trajectory.h5:/particles/trajectory/position/value|3 0 0:1 1 1:1"));
}

TEST_CASE("a plot leaves its gnuplot script, an SVG and a PNG") {
  const Workplace here;
  const Ended ended = here.script(std::string(small_sweep) +
                                      "ricochet.plot { rows = rows, x = \"psi1\", y = { \"e\", \"mu\" }, name = \"p\", "
                                      "title = \"a \\\"quoted\\\" title\" }\n",
                                  "samples=2 --quiet");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK(ended.err.empty());
  for (const char* name : {"p.gp", "p.svg", "p.png"}) CHECK(fs::file_size(here.path / "out/s" / name) > 500);
}

TEST_CASE("a plot draws simulation, several theories, published points and a caption, or theory alone") {
  const Workplace here;
  const Ended ended = here.script(std::string(small_sweep) + R"(
ricochet.plot { rows = rows, x = "psi1", y = { "e", "mu" }, name = "p", caption = ("many words "):rep(30),
  theory = { e = { { name = "constant", f = function(x) return 1 end }, { name = "chain", points = { { 0, 0.9 }, { 4, 1.1 } } } }, mu = { { 0, 0 }, { 4, 0.3 } } },
  published = { e = { { name = "somebody 1999", points = { { 1, 0.8 }, { 5, 1.2 } } } } }, yrange = { mu = { -1, 1 } } }
ricochet.plot { x = "v", y = { "loss" }, name = "alone", log = "xy", xrange = { 0.1, 10 }, theory = { loss = function(v) return v ^ 0.6 end } }
)",
                                  "samples=2 --quiet");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  const std::string drawn = here.read("out/s/p.gp"), alone = here.read("out/s/alone.gp");
  using Catch::Matchers::Contains;
  CHECK_THAT(drawn, Contains("$data1 << END") && Contains("$theory1_1 << END\n0 1\n") &&
                        Contains("$theory1_2 << END\n0 0.9") && Contains("$theory2_1 << END\n0 0\n4 0.2999") &&
                        Contains("$published1_1 << END\n1 0.8"));
  CHECK_THAT(drawn, Contains("title 'constant'") && Contains("title 'chain'") && Contains("title 'somebody 1999'") &&
                        Contains("set yrange [-1:1]"));
  CHECK_THAT(drawn, Contains("'mean and standard error of 6 impacts, 0 failed; averaged over sample (2 values)'") &&
                        Contains("set xrange [-0.2"));  // up to the published point at 5, 4 % of 5 beside it
  CHECK_THAT(alone, Contains("0.10000000000000001 0.25118864") && !Contains("impacts") && Contains("set logscale xy"));
  for (const char* name : {"p.png", "alone.png", "alone.svg"}) CHECK(fs::file_size(here.path / "out/s" / name) > 500);
  const auto mistake = [&](const std::string& fields) {
    return here
        .script("local ricochet = require 'ricochet'\nricochet.plot { x = 'x', y = { 'y' }, name = 'p',\n  " + fields +
                    " }",
                "--force")
        .first_line();
  };
  CHECK(mistake("theory = { y = function(x) return x end }") ==
        "error: s.lua:2: plot: has neither rows nor points; give xrange = { from, to } for the functions");
  CHECK(mistake("theory = { z = function(x) return x end }") ==
        "error: s.lua:3: plot: 'theory' has a curve for 'z', which is not among 'y'");
  CHECK(mistake("theory = { y = { { f = function(x) return x end } } }") ==
        "error: s.lua:3: plot: 'theory' of 'y' must be a list of { name =, f = or points = }; entry 1 has no name");
  CHECK(mistake("theory = { y = { { name = 'a' } } }") ==
        "error: s.lua:3: plot: 'theory' of 'y' needs f = function (x) or points = { {x, y}, ... } for 'a'");
  CHECK(mistake("published = { y = function(x) return x end }") ==
        "error: s.lua:3: plot: 'published' of 'y' takes points, and 'published' is a function");
  CHECK(mistake("published = { y = { { 1, 'a' } } }") ==
        "error: s.lua:3: plot: 'published' of 'y' holds a point of 'published' that is not {x, y}");
  CHECK(mistake("xrange = { 2, 1 }") == "error: s.lua:3: plot: 'xrange' takes { from, to }");
  CHECK(mistake("yrange = { z = { 1, 2 } }") == "error: s.lua:3: plot: 'yrange' names 'z', which is not among 'y'");
  CHECK(mistake("by = 'x'") == "error: s.lua:3: plot: 'by' groups rows, and there are none");
}

TEST_CASE("scripts and examples of the project run short") {
  const Workplace here;
  const std::string root = RICOCHET_SOURCE;
  for (const std::string command : {"examples/01_drop.lua nodes=60 frames=3",
                                    "examples/02_soft_and_hard.lua nodes=60 frames=3",
                                    "examples/03_super_rebound.lua nodes=60 samples=3 frames=3",
                                    "examples/04_waves.lua nodes=600 frames=3",
                                    "examples/05_shapes.lua nodes=80",
                                    "examples/06_elements.lua nodes=80 h_min=0.1",
                                    "examples/07_bounces.lua frames=3 until_=20 film=none",
                                    "examples/08_maps.lua nodes=60 samples=2",
                                    "scripts/elasticity.lua samples=1 height=3",
                                    "scripts/benchmark.lua nodes=60 samples=1 psi1=0,1 growth=300,600",
                                    "scripts/soft_wall.lua --check samples=1",
                                    "scripts/soft_wall.lua samples=2 nodes=60 psi1=0,1,3,6",
                                    "scripts/hard_wall.lua samples=2 nodes=60 psi1=0,2,4,6",
                                    "scripts/fixed_normal_speed.lua samples=2 nodes=60 psi1=0,1,3",
                                    "scripts/half_size.lua samples=2 nodes=120 psi1=0,1,3,6",
                                    "scripts/readings.lua samples=2 nodes=80",
                                    "scripts/readings.lua --check samples=2 nodes=80",
                                    "scripts/four_claims.lua samples=2 nodes=80 soft=1,3,6 hard=0,3,6",
                                    "scripts/four_claims.lua --check samples=2 nodes=80",
                                    "scripts/slopes.lua samples=2 nodes=80 psi1=2,6",
                                    "scripts/slopes.lua --check samples=2 nodes=80",
                                    "scripts/walton.lua samples=2 nodes=60",
                                    "scripts/maw.lua samples=2 nodes=60",
                                    "scripts/normal_speed.lua samples=1 nodes=60 speed=0.1 --out one",
                                    "scripts/normal_speed.lua samples=2 nodes=60 speed=0.05,0.1",
                                    "scripts/materials.lua samples=1 nodes=400",
                                    "scripts/poisson_ratio.lua samples=2 nu=0,0.45 speed=0.02,0.1 h_min=0.1",
                                    "scripts/three_approaches.lua samples=2 speed=0.02,0.1 h_min=0.1 nodes=150 xi=400",
                                    "scripts/rough_elements.lua samples=2 nodes=60 psi1=0,2,6",
                                    "scripts/rods.lua samples=2 rows=2 hardness=50",
                                    "scripts/taylor_bar.lua samples=1 across=2",
                                    "scripts/plastic_sphere.lua samples=2 across=2 ratio=220",
                                    "scripts/radiation.lua",
                                    "scripts/modal_disk.lua samples=2 omega_most=20 hardness=100",
                                    "scripts/hertz_benchmarks.lua",
                                    "scripts/elastic_sphere.lua samples=2 cells=2 extent=3 nu=0.25",
                                    "scripts/kharaz.lua samples=2 cells=2",
                                    "scripts/walton.lua --check samples=1",
                                    "scripts/normal_speed.lua --check samples=1",
                                    "scripts/which_effects_matter.lua nodes=60 samples=2 speed=0.1,0.2",
                                    "scripts/bounces.lua --check samples=2",
                                    "scripts/bounces.lua samples=2 bounces=2",
                                    "examples/effects/gravity.lua nodes=60 samples=2 speed=0.05,0.1,0.2",
                                    "examples/effects/drag.lua samples=1 speed=0.1,0.2",
                                    "examples/effects/absorbing.lua samples=2 density=20 depth=1.5,2",
                                    "examples/effects/absorbing_edges.lua extent=1,2 h_min=0.15",
                                    "examples/effects/moving_anchor.lua samples=1 phase=0,90",
                                    "examples/effects/damping.lua nodes=100 samples=1 speed=0.04,0.08,0.16",
                                    "examples/effects/plastic.lua nodes=100 samples=1 speed=0.05,0.1,0.2",
                                    "examples/effects/yielding.lua speed=3000,10000 h_min=0.5",
                                    "examples/effects/breaking.lua nodes=60 samples=1 speed=0.1,0.3 frames=2",
                                    "examples/effects/adhesion.lua samples=1 speed=0.05,0.1",
                                    "examples/effects/friction.lua nodes=60 samples=1 psi1=1,2",
                                    "examples/effects/thermal.lua samples=4 ratio=2,4"}) {
    const Ended ended = here.run("--quiet " + root + "/" + command);
    INFO(command << "\n" << ended.err);
    CHECK(ended.status == 0);
  }
}

TEST_CASE("a scene is exported for LAMMPS, and one with effects is not") {
  const Workplace here;
  const std::string scene =
      "local ricochet = require 'ricochet'\nlocal d, w = ricochet.disk { nodes = 60 }, ricochet.wall { nodes = 150, "
      "width = 4 }\n"
      "local given = { projectile = d, target = w, launch = { speed = 0.1 } }\n";
  const Ended ended = here.script(scene + "ricochet.lammps { scene = ricochet.scene(given), out = 'drop' }\n");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("LAMMPS files: out/s/drop.data, beside it .in"));
  CHECK_THAT(here.read("out/s/drop.in"),
             Catch::Matchers::Contains("read_data drop.data") && Catch::Matchers::Contains("bond_style class2"));
  CHECK_THAT(here.read("out/s/drop.data"), Catch::Matchers::Contains("210 atoms\n"));
  const Ended refused = here.script(scene +
                                        "given.effects = { ricochet.gravity { g = 1e-5 } }\nricochet.lammps { scene = "
                                        "ricochet.scene(given), out = 'drop' }\n",
                                    "--force");
  CHECK(refused.status == 1);
  CHECK_THAT(refused.first_line(),
             Catch::Matchers::Contains("LAMMPS files hold springs and repulsion only; leave the effects out"));
}

TEST_CASE("LAMMPS reads what is exported for it, with the nodes' own masses") {
  const Workplace here;
  if (here.shell("lmp -h | grep -q class2").status != 0) {
    WARN("skipped: LAMMPS with its package CLASS2 is not installed (apt-get install lammps)");
    return;
  }
  const Ended ended = here.script(R"lua(local ricochet = require "ricochet"
    ricochet.lammps { out = "drop", scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 },
      target = ricochet.wall { nodes = 150, width = 4 }, launch = { speed = 0.1 } } })lua");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  const Ended of_file = here.shell(R"(cd out/s; awk '/^[A-Z]/ { part = $1 }
    part == "Atoms" && NF == 6 && $2 == 1 { of_disk[$1] = 1 }
    part == "RMass" && NF == 2 && $1 in of_disk { mass += $2 }
    END { print mass * 0.1 ^ 2 / 2 }' drop.data)");
  const Ended lammps = here.shell("cd out/s; lmp -in drop.in -var steps 10 -log none");
  INFO(lammps.out << lammps.err);
  REQUIRE(lammps.status == 0);
  std::istringstream lines(lammps.out);
  std::string line;
  while (std::getline(lines, line) && line.find("Step") == std::string::npos) {
  }
  double step = -1, time = 0, total = 0, kinetic = 0;
  lines >> step >> time >> total >> kinetic;
  CHECK(step == 0);
  CHECK(kinetic == Catch::Detail::Approx(std::stod(of_file.out)).epsilon(1e-5));
  CHECK(kinetic > 2 * 60 * 0.1 * 0.1 / 2);  // of nodes that weigh 1 each
}

TEST_CASE("every effect has an example of its name") {
  each_effect_kind([]<class E>(const E&) {
    CHECK(fs::exists(fmt::format("{}/examples/effects/{}.lua", RICOCHET_SOURCE, E::name)));
  });
}

TEST_CASE("rows can be picked by a column, and a power law is found in them") {
  const Workplace here;
  here.write("s.lua",
             "local ricochet = require 'ricochet'\n"
             "local rows = ricochet.sweep { name = 's', over = { psi1 = { 0, 1 }, speed = { 0.1, 0.2, 0.3 } }, scene = "
             "function(at) return ricochet.scene {\n"
             "  projectile = ricochet.disk { nodes = 40 }, target = ricochet.wall { width = 4, depth = 1, nodes = 80, "
             "stiffness = 400 }, launch = { speed = at.speed, psi1 = at.psi1 } } end }:run()\n"
             "local some = rows:where { psi1 = 1 }\n"
             "assert(#some > 0 and #rows:where { psi1 = 1 + 1e-15 } == #some and #rows:where { psi1 = 1.001 } == 0)\n"
             "for _, row in ipairs(some) do assert(row.psi1 == 1); row.cube = 7 * row.speed ^ 3 end\n"
             "local law = some:power_law { x = 'speed', y = 'cube' }\n"
             "print(#some, ('%.6f %.6f %.1g %d'):format(law.exponent, law.factor, law.se, law.count))\n"
             "ricochet.plot { rows = rows, x = 'speed', y = { 'e', 'mu' }, by = 'psi1', log = 'x', name = 'p', theory "
             "= { e = function(v) return 1 end } }\n");
  const Ended ended = here.run("--quiet s.lua");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("3\t3.000000 7.000000"));
  CHECK(fs::file_size(here.path / "out/s/p.png") > 500);
  const auto mistake = [&](const std::string& line) {
    here.write("s.lua",
               "local ricochet = require 'ricochet'\n"
               "local rows = ricochet.sweep { name = 's', over = { psi1 = { 0, 1 } }, scene = function(at) return "
               "ricochet.scene {\n"
               "  projectile = ricochet.disk { nodes = 40 }, target = ricochet.wall { width = 4, depth = 1, nodes = "
               "80, stiffness = 400 }, launch = { psi1 = at.psi1 } } end }:run()\n" +
                   line);
    const Ended failed = here.run("--quiet --force s.lua");
    CHECK(failed.status == 1);
    return failed.err;
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(mistake("rows:where { psi = 1 }"),
             Contains("error: s.lua:4: where: the rows have no column 'psi' (did you mean 'psi1' or 'psi2'?)"));
  CHECK_THAT(mistake("rows:power_law { x = 'speed', y = 'e' }"),
             Contains("error: s.lua:4: power_law: the rows have no column 'speed'"));
  CHECK_THAT(mistake("rows:power_law { x = 'psi1', y = 'e' }"),
             Contains("error: s.lua:4: power_law: a power law needs values above 0, 'psi1' is 0"));
  CHECK_THAT(
      mistake("rows:where { psi1 = 1 }:power_law { x = 'psi1', y = 'e' }"),
      Contains("error: s.lua:4: power_law: a power law needs three rows or more of different 'psi1', there are 1"));
  CHECK_THAT(mistake("ricochet.plot { rows = rows, x = 'psi1', y = { 'e' }, name = 'p', log = 'x' }"),
             Contains("error: s.lua:4: plot: 'log' along x needs values above 0, psi1 goes down to 0"));
  CHECK_THAT(mistake("ricochet.plot { rows = rows, x = 'psi1', y = { 'e' }, name = 'p', theory = { mu = 1 } }"),
             Contains("error: s.lua:4: plot: 'theory' takes column = function (x), 'mu' is a number"));
}

TEST_CASE("the reference page and the editor stubs in the tree are current") {
  const Workplace tree;
  const auto text = [](const std::string& name) {
    std::ifstream file(std::string(RICOCHET_SOURCE) + "/lua/" + name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  CHECK((text("REFERENCE.md") == reference_page()));  // else: ricochet reference > lua/REFERENCE.md
  CHECK((text("ricochet.d.lua") == editor_stubs()));  // else: ricochet reference --stubs > lua/ricochet.d.lua
}

TEST_CASE("a default that a field names is the one that its struct has") {
  const auto check = []<class Struct>(const Struct& made) {
    for (const Member<Struct>& member : Struct::fields()) {
      const std::string& text = member.field.initial;
      INFO(member.field.name);
      if (text.empty() || text == by_struct) continue;
      CHECK(text == std::visit([&](auto place) { return lua_text(made.*place); }, member.place));
    }
  };
  check(BodyNumbers{});
  check(Launch{});
  check(Integration{});
  check(ExponentialRepulsion{});
  each_effect_kind(check);
}

TEST_CASE("every function of the reference has an example, and every field a meaning") {
  for (const Function& f : functions()) {
    INFO(f.name);
    CHECK(f.example.empty() == f.is_table);
    CHECK_FALSE(f.doc.empty());
    for (const Field& field : f.fields) {
      INFO(field.name);
      CHECK(field.initial != by_struct);
      CHECK_FALSE((field.optional && !field.initial.empty()));
      CHECK_FALSE(field.doc.empty());
    }
  }
}

TEST_CASE("the repl answers and survives mistakes") {
  const Workplace here;
  const Ended ended =
      here.shell("printf '1 + 1\\nricochet.disk { nods = 3 }\\nlocal x = 2; print(x)\\n' | ricochet repl");
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("> 2\n"));
  CHECK_THAT(ended.err, Catch::Matchers::Contains("did you mean 'nodes'"));
}

TEST_CASE("./workbench without root or sudo says which packages to install and how") {
  const Workplace here;
  // A machine that has nothing installed, no sudo, and a user that is not root.
  const Ended ended =
      here.shell(std::string("mkdir bin; ln -s $(command -v dirname) $(command -v sh) bin/; printf '#!/bin/sh\nexit "
                             "1\n' > bin/dpkg-query; printf '#!/bin/sh\necho 1000\n' > bin/id; chmod +x bin/*; "
                             "PATH=$PWD/bin sh ") +
                 RICOCHET_SOURCE + "/workbench test");
  CHECK(ended.status == 4);
  CHECK_THAT(ended.first_line(),
             Catch::Matchers::StartsWith(
                 "error: workbench: these Debian packages are missing and need root to install: g++ cmake"));
  CHECK_THAT(ended.err, Catch::Matchers::Contains("as root: apt-get install --no-install-recommends g++ cmake"));
}

TEST_CASE("effects lists the catalogue, and --cost prices it in a script's scene beside the scene's own") {
  const Workplace here;
  const Ended list = here.shell("ricochet effects");
  CHECK(list.status == 0);
  for (const char* text : {"gravity: ", "ricochet.drag { rate = 0.01 }",
                           "column damping_energy: ", "retardation time of the material [R/c]"})
    CHECK_THAT(list.out, Catch::Matchers::Contains(text));
  here.write("s.lua",
             "local ricochet = require 'ricochet'\nricochet.scene { projectile = ricochet.disk { nodes = 60 }, target "
             "= ricochet.wall { nodes = 150, width = 4 }, effects = { ricochet.gravity { g = 1e-3 }, "
             "ricochet.damping { time = 1e-3 } } }");
  const Ended priced = here.shell("ricochet effects --cost s.lua");
  INFO(priced.err);
  CHECK(priced.status == 0);
  for (const char* text : {"210 nodes", "\nbare ", "\nabsorbing ", "\nthe scene's own "})
    CHECK_THAT(priced.out, Catch::Matchers::Contains(text));
}

TEST_CASE("relevance compares the same lattices with and without an effect") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local function scene(effects, seed)
  return ricochet.scene { projectile = ricochet.disk { nodes = 60, roughness = 0.03, seed = seed }, target = ricochet.wall { nodes = 150, width = 4, stiffness = 400, seed = seed },
    launch = { psi1 = 1 }, effects = effects, method = "verlet" }
end
local drag = ricochet.drag { rate = 0.02 }
local result = ricochet.relevance { scene = scene({}, 5), effects = { drag, ricochet.gravity { g = 0 } }, of = { "e" }, samples = 3 }
local sum = 0
for seed = 5, 7 do sum = sum + scene({ drag }, seed):run().e - scene({}, seed):run().e end
assert(math.abs(result[1].e.change - sum / 3) < 1e-14, result[1].e.change .. " " .. sum / 3)
assert(result[1].name == "drag" and result[1].e.count == 3 and result[1].e.se > 0 and result[1].e.sampling > result[1].e.se)
assert(result[2].e.change == 0)  -- gravity of nothing
)");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("not seen"));
}
