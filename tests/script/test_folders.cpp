// What a run leaves in its folder, and what it may do with what is there already.

#include <catch2/catch.hpp>

#include "script/program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

constexpr const char* still_script = R"(local ricochet = require "ricochet"
local p = ricochet.parameters { name = "still" }
local scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } }
ricochet.still { scene = scene, out = p.name, size = { 64, 48 } }
)";

std::string file_bytes(const Workplace& here, const std::string& name) { return here.read(name); }

}  // namespace

TEST_CASE("a run that failed before it stored anything, or only logged, leaves its folder free") {
  const Workplace here;
  const std::string film = R"(local ricochet = require "ricochet"
ricochet.animate { scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 },
  target = ricochet.wall { nodes = 150, width = 4 } }, frames = 2, film = "f.mp4", size = { 64, 48 } }
)";
  here.write("s.lua", film);
  here.shell("mkdir bin; for t in sh env; do ln -s $(command -v $t) bin; done");
  for (int time = 0; time < 2; ++time) {
    const Ended without = here.shell("PATH=bin; ricochet run s.lua");
    CHECK(without.first_line() == "error: a film needs ffmpeg, which is not installed; apt-get install ffmpeg");
  }
  here.write("t.lua", "require('ricochet').file.read('x')");
  for (int time = 0; time < 2; ++time)
    CHECK_THAT(here.run("t.lua").first_line(), Catch::Matchers::StartsWith("error: t.lua:1: cannot read out/t/x"));
}

TEST_CASE("the option --force keeps earlier results until the new ones are whole, and --resume goes on with the new") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua samples=1 --quiet").status == 0);
  const std::string before = file_bytes(here, "out/s/results.h5");
  // Killed as soon as the first of the new rows is stored.
  here.shell(
      "'" RICOCHET_PROGRAM
      "' run s.lua samples=200 --batch 1 --force --quiet & p=$!; "
      "while [ ! -d out/s/parts.new ] && kill -0 $p 2>/dev/null; do sleep 0.01; done; sleep 0.1; kill -9 $p; wait");
  REQUIRE(fs::exists(here.path / "out/s/parts.new"));
  CHECK(file_bytes(here, "out/s/results.h5") == before);
  // Interrupted: the same, and told.
  fs::remove_all(here.path / "out/s/parts.new");
  const Ended stopped = here.shell("'" RICOCHET_PROGRAM
                                   "' run s.lua samples=200 --force --quiet & p=$!; "
                                   "while [ ! -d out/s/parts.new ]; do sleep 0.01; done; kill -INT $p; wait $p");
  CHECK(stopped.status == 130);
  CHECK_THAT(stopped.err, Catch::Matchers::Contains("the earlier results stay until all are there"));
  CHECK(file_bytes(here, "out/s/results.h5") == before);
  fs::remove_all(here.path / "out/s/parts.new");
  REQUIRE(here.shell("'" RICOCHET_PROGRAM "' run s.lua samples=30 --force --quiet --batch 1 & p=$!; "
                     "while [ ! -d out/s/parts.new ]; do sleep 0.01; done; kill -9 $p; wait; "
                     "ricochet run s.lua samples=30 --resume --quiet")
              .status == 0);
  CHECK(read_table(here.path / "out/s/results.h5").rows() == 90);
  CHECK_FALSE(fs::exists(here.path / "out/s/parts.new"));
}

TEST_CASE("a file that no run of the folder's made is neither removed nor overwritten") {
  const Workplace here;
  REQUIRE(here.script(still_script).status == 0);
  for (const char* name : {"photo.png", "parts/own.txt"}) here.write(std::string("out/s/") + name, "mine");
  REQUIRE(here.run("s.lua name=other --force").status == 0);
  CHECK(here.read("out/s/photo.png") == "mine");
  CHECK(here.read("out/s/parts/own.txt") == "mine");
  CHECK(fs::exists(here.path / "out/s/other.png"));
  CHECK_FALSE(fs::exists(here.path / "out/s/still.png"));
  const Ended in_the_way = here.run("s.lua name=photo --force");
  CHECK(in_the_way.status == 4);
  CHECK_THAT(in_the_way.first_line(), Catch::Matchers::Contains("out/s/photo.png is in the way, and no run of this "
                                                                "folder's made it; move it, or give another name"));
  CHECK(here.read("out/s/photo.png") == "mine");
}

TEST_CASE("the option --new leaves earlier results and counts folders up, the refusal names it") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  for (const char* folder : {"out/s", "out/s-2", "out/s-3"}) {
    CHECK(here.run("s.lua samples=1 --quiet --new").status == 0);
    CHECK(read_table(here.path / folder / "results.h5").rows() == 3);
  }
  CHECK(
      here.run("s.lua samples=1").first_line() ==
      "error: out/s already holds results; --resume continues them, --force replaces them, --new leaves them and goes "
      "to out/s-4");
  CHECK(here.run("s.lua samples=1 --new --force").status == 2);
}

TEST_CASE("a file that --force cannot remove or replace is a file error that names it") {
  const Workplace here;
  REQUIRE(here.script(still_script).status == 0);
  if (here.shell("chattr +i out/s/still.png").status != 0) {
    WARN("no right to make a file immutable here");
    return;
  }
  const Ended replaced = here.run("s.lua --force"), removed = here.run("s.lua name=other --force");
  here.shell("chattr -i out/s/still.png");
  for (const Ended& ended : {replaced, removed}) {
    CHECK(ended.status == 4);
    CHECK_THAT(ended.first_line(),
               Catch::Matchers::Contains("out/s/still.png: Operation not permitted; give a writable "
                                         "folder with --out"));
  }
}

TEST_CASE("info shows every argument, every required file and the scene") {
  const Workplace here;
  here.write("m.lua", "return 1");
  here.write("s.lua",
             std::string("local m = require 'm'\n") + small_sweep +
                 "ricochet.record { scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = "
                 "ricochet.wall { nodes = 150, width = 4 } }, frames = 3, out = 'path' }\n");
  const std::string psi1 = "samples = { 4,", both = "psi1 = { { 0, 1, 4 }, doc = 'angles' }, samples = { 4,";
  std::string text = here.read("s.lua");
  text.replace(text.find(psi1), psi1.size(), both);
  here.write("s.lua", text);
  const Ended run = here.run("s.lua samples=1 psi1=0,1 --quiet");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const Ended rows = here.shell("ricochet info out/s/results.h5"), path = here.shell("ricochet info out/s/path.h5");
  CHECK_THAT(rows.out, Catch::Matchers::Contains("arguments      samples=1\n               psi1=0,1\n") &&
                           Catch::Matchers::Contains("m.lua\n") && Catch::Matchers::Contains("ricochet/init.lua\n"));
  CHECK_THAT(path.out, Catch::Matchers::Contains("scene ") && Catch::Matchers::Contains("stiffness"));
  // A folder is what is in it; a table of text tells nothing.
  CHECK(here.shell("ricochet info out/s").out == rows.out);
  const Ended csv = here.shell("ricochet info out/s/results.csv");
  CHECK(csv.status == 4);
  CHECK_THAT(csv.err, Catch::Matchers::Contains("give the .h5 beside it"));
}

TEST_CASE("plots of a version that kept no list are told before the impacts, not after them") {
  const Workplace here;
  const std::string text =
      std::string(small_sweep) + "ricochet.plot { rows = rows, x = 'psi1', y = { 'e' }, name = 'p' }\n";
  REQUIRE(here.script(text, "samples=1 --quiet").status == 0);
  fs::remove(here.path / "out/s/run.files");
  const std::string before = here.read("out/s/results.h5");
  for (const char* option : {"--force", "--resume"}) {
    const Ended ended = here.run(std::string("s.lua samples=2 --quiet ") + option);
    CHECK(ended.status == 4);
    CHECK_THAT(ended.first_line(), Catch::Matchers::Contains("out/s holds plots of an earlier version") &&
                                       Catch::Matchers::EndsWith("--new, which goes to out/s-2"));
    CHECK((here.read("out/s/results.h5") == before));
  }
  CHECK(here.run("s.lua samples=2 --quiet --new").status == 0);
}

TEST_CASE("what --new began is gone on with by --new --resume, as the message says") {
  const Workplace here;
  REQUIRE(here.script(small_sweep, "samples=1 --quiet").status == 0);
  const Ended ended =
      here.shell("'" RICOCHET_PROGRAM
                 "' run s.lua samples=400 --quiet --new & pid=$!; for k in $(seq 600); do ls out/s-2/parts/* "
                 ">/dev/null 2>&1 && break; sleep 0.05; done; kill -INT $pid; wait $pid");
  CHECK(ended.status == 130);
  CHECK_THAT(ended.err, Catch::Matchers::Contains("are stored in out/s-2; --new --resume goes on from there"));
  const Ended resumed = here.run("s.lua samples=400 --new --resume");
  CHECK(resumed.status == 0);
  CHECK_THAT(resumed.out, Catch::Matchers::Contains("out/s-2/results.h5"));
  CHECK_FALSE(fs::exists(here.path / "out/s-3"));
  CHECK(here.run("s.lua samples=1 --quiet --new --force").status == 2);
}

TEST_CASE("a sweep that is not called as its script says where its rows are, and where all else is") {
  const Workplace here;
  here.write("angles.lua", small_sweep);
  const Ended ended = here.run("angles.lua samples=1");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK_THAT(ended.out,
             Catch::Matchers::EndsWith("\nfolders: rows of sweeps in out/s; all else of the script in out/angles\n"));
  CHECK(fs::exists(here.path / "out/angles/report.html"));
  CHECK(fs::exists(here.path / "out/s/results.h5"));
  CHECK(here.script(small_sweep, "samples=1 --out same").out.find("folders:") == std::string::npos);
  CHECK(here.run("angles.lua samples=1 --quiet --out calm").out.find("folders:") == std::string::npos);
}
