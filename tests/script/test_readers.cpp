// Other programs read our files. ricochet_tests "[.slow]" needs python3-h5py python3-mdanalysis paraview.

#include <catch2/catch.hpp>
#include <set>
#include <sstream>

#include "script/program.hpp"

using namespace ricochet::test;

namespace {

const char* recorded = R"(local ricochet = require "ricochet"
local scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, stiffness = 400, width = 4 } }
ricochet.record { scene = scene, frames = 7 }
)";

Ended python(const Workplace& here, const std::string& text) {
  here.write("read.py", text);
  return here.shell("/usr/bin/python3 read.py");
}

}  // namespace

TEST_CASE("results.h5 opens in h5py", "[.slow]") {
  const Workplace here;
  REQUIRE(here.script(small_sweep, "--quiet").status == 0);
  const Ended ended = python(here, R"(import h5py
f = h5py.File("out/s/results.h5")
print(len(f["rows/e"]), f["rows/vn"].attrs["unit"].decode(), f["rows/status"][0].decode(), f["provenance/script_name"][0].decode())
)");
  INFO(ended.err);
  CHECK(ended.out == "12 c finished s.lua\n");
}

TEST_CASE("pandas reads the rows of several runs, and a file that h5py opened to write is as it was", "[.slow]") {
  const Workplace here;
  REQUIRE(here.script(small_sweep, "samples=2 --quiet --no-report --out a").status == 0);
  REQUIRE(here.run("s.lua samples=4 --quiet --no-report --out b").status == 0);
  const std::string before = here.read("b/s/results.h5");
  const Ended touched = python(here, "import h5py\nh5py.File('b/s/results.h5', 'r+').close()\n");
  INFO(touched.err);
  CHECK(touched.status == 0);
  CHECK(here.read("b/s/results.h5") == before);
  const Ended added =
      python(here, "import h5py\nf = h5py.File('b/s/results.h5', 'r+')\nf['mine'] = [1, 2, 3]\nf.close()\n");
  INFO(added.err);
  CHECK(added.status == 0);
  const Ended told = here.shell("ricochet info b");
  INFO(told.err);
  CHECK(told.status == 0);
  CHECK_THAT(told.out, Catch::Matchers::Contains("12 rows"));
  REQUIRE(here.run("s.lua samples=4 --quiet --no-report --resume --out b").status == 0);
  CHECK(python(here, "import h5py\nprint(list(h5py.File('b/s/results.h5')['mine'][:]))\n").out == "[1, 2, 3]\n");
  const Ended joined = here.shell("/usr/bin/python3 '" RICOCHET_SOURCE "/examples/read_results.py' a/s b/s");
  INFO(joined.err);
  CHECK_THAT(joined.out, Catch::Matchers::StartsWith("12 impacts of 2 runs; vn in c\n"));
  // The program's own means.
  std::istringstream ours(here.shell("ricochet run s.lua samples=4 --quiet --resume --out b").out);
  for (std::string line; std::getline(ours, line);)
    if (line.find("+-") != std::string::npos && line.find("psi1") == std::string::npos)
      CHECK_THAT(joined.out, Catch::Matchers::Contains(line.substr(line.find('.') - 1, 5)));
}

TEST_CASE("runs over other parameters are joined without a loss, where h5py and pandas are installed") {
  const Workplace here;
  if (here.shell("/usr/bin/python3 -c 'import h5py, pandas'").status != 0) {
    WARN("skipped: h5py and pandas are not installed (apt-get install python3-h5py python3-pandas)");
    return;
  }
  // The impact at a speed of 0.1 and psi1 = 0 is in both.
  const auto run_over = [&](const std::string& over, const std::string& launch, const std::string& more) {
    return here
        .script("local ricochet = require 'ricochet'\nricochet.sweep { name = 's', over = { " + over +
                    " }, scene = function(at) return ricochet.scene { projectile = ricochet.disk { nodes = 40 }, "
                    "target = ricochet.plane {}, launch = { " +
                    launch + " } } end }:run()\n",
                "--quiet --no-report --out " + more)
        .status;
  };
  REQUIRE(run_over("psi1 = { 0, 1, 2 }", "speed = 0.1, psi1 = at.psi1", "a") == 0);
  REQUIRE(run_over("speed = { 0.05, 0.1 }", "speed = at.speed, psi1 = 0", "b") == 0);
  const std::string join = "/usr/bin/python3 '" RICOCHET_SOURCE "/examples/read_results.py' ";
  const Ended joined = here.shell(join + "a/s b/s");
  INFO(joined.err + joined.out);
  CHECK_THAT(joined.out, Catch::Matchers::StartsWith("4 impacts of 2 runs; vn in c\n"));
  std::istringstream lines(joined.out);
  std::set<std::string> places;  // "0.0 0.10"
  std::string over, speed, line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    words >> over >> speed;
    if (line.find("impacts") == std::string::npos && over != "over_psi1" &&
        line.find_first_of("0123456789") != std::string::npos)
      places.insert(over + " " + speed);
  }
  CHECK(places == std::set<std::string>{"0.0 0.10", "1.0 NaN", "2.0 NaN", "NaN 0.05"});
  CHECK_THAT(here.shell(join + "a/s a/s").out, Catch::Matchers::StartsWith("3 impacts of 2 runs"));
}

TEST_CASE("trajectory.h5 opens in MDAnalysis", "[.slow]") {
  const Workplace here;
  REQUIRE(here.script(recorded, "--quiet").status == 0);
  const Ended ended = python(here, R"(import warnings; warnings.simplefilter("ignore")
import MDAnalysis as mda, numpy as np
u = mda.Universe.empty(210, trajectory=False)
u.load_new("out/s/trajectory.h5", format="H5MD", convert_units=False)
heights = [ts.positions[:60, 1].mean() for ts in u.trajectory]
print(len(u.trajectory), u.trajectory.n_atoms, u.trajectory.has_velocities if hasattr(u.trajectory, "has_velocities") else True, min(heights) < heights[0] and heights[-1] > min(heights))
)");
  INFO(ended.err);
  CHECK(ended.out == "7 210 True True\n");
}

TEST_CASE("the .xdmf opens in ParaView, with its times and velocities", "[.slow]") {
  const Workplace here;
  REQUIRE(here.script(recorded, "--quiet").status == 0);
  here.write("read.py", R"(from paraview.simple import *
r = Xdmf3ReaderT(FileName=["out/s/trajectory.xdmf"])
times = list(r.TimestepValues)
def height(t):
    UpdatePipeline(t, r)
    d = servermanager.Fetch(r)
    while d.IsA("vtkMultiBlockDataSet"): d = d.GetBlock(0)
    return sum(d.GetPoint(i)[1] for i in range(60)) / 60, d
before, during = height(times[1])[0], height(times[3])
print(len(times), during[1].GetNumberOfPoints(), during[1].GetNumberOfCells() > 300, during[1].GetPointData().GetArray("velocity").GetNumberOfComponents(), during[0] < before)
)");
  const Ended ended = here.shell("pvpython --force-offscreen-rendering read.py");
  INFO(ended.err);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("7 210 True 3 True"));
}
