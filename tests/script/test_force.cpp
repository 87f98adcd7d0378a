// What --force replaces, and when.

#include <catch2/catch.hpp>

#include "script/program.hpp"

using namespace ricochet::test;

TEST_CASE("with --force a mistake costs no earlier results, and the next run without one replaces them") {
  const Workplace here;
  std::string text = small_sweep;
  text.insert(text.find("local rows"),
              "ricochet.file.write('note.txt', 'hello')\nif p.samples == 3 then error 'three' end\n");
  REQUIRE(here.script(text, "samples=1").status == 0);
  const std::string before = here.read("out/s/results.h5");
  const Ended mistaken = here.run("s.lua --force samples=3");
  CHECK(mistaken.status == 1);
  CHECK_THAT(mistaken.err, Catch::Matchers::Contains("what was stored stays in"));
  CHECK((here.read("out/s/results.h5") == before));
  CHECK(here.run("s.lua --force samples=2").status == 0);
  CHECK((here.read("out/s/results.h5") != before));
  CHECK_FALSE(fs::exists(here.path / "out/s/parts"));
  // What a forced run does not replace was another's.
  CHECK(here.script("local ricochet = require 'ricochet'\nricochet.file.write('note.txt', 'hello')\n", "--force")
            .status == 0);
  CHECK_FALSE(fs::exists(here.path / "out/s/results.h5"));
}

TEST_CASE("with --force a mistake costs no pictures or recordings, and what the next run does not make again goes") {
  const Workplace here;
  const std::string text =
      "local ricochet = require 'ricochet'\nlocal p = ricochet.parameters { stage = 0 "
      "}\nricochet.file.write('note.txt', 'hello')\n"
      "if p.stage == 1 then error 'one' end\nif p.stage == 3 then\n"
      "  ricochet.animate { scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall "
      "{ nodes = 150, width = 4 }, step = 1 }, frames = 5, out = 'film' }\nend\nlocal scene = ricochet.scene { "
      "projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } }\n"
      "ricochet.animate { scene = scene, frames = p.stage == 2 and 3 or 5, size = { 64, 36 }, out = 'film' }\n"
      "if p.stage == 0 then ricochet.record { scene = scene, frames = 3 } ricochet.still { scene = scene, size = { 64, "
      "36 } } end\n";
  REQUIRE(here.script(text).status == 0);
  const char* products[] = {"out/s/trajectory.h5", "out/s/trajectory.xdmf", "out/s/still.png", "out/s/film/000004.png"};
  for (const char* product : products) CHECK(fs::exists(here.path / product));
  CHECK(here.run("s.lua stage=1 --force").status == 1);
  CHECK(here.run("s.lua stage=3 --force").status == 1);
  for (const char* product : products) CHECK(fs::exists(here.path / product));
  here.write("out/s/mine.txt", "mine");
  CHECK(here.run("s.lua stage=2 --force").status == 0);
  for (const char* product : products) CHECK_FALSE(fs::exists(here.path / product));
  CHECK(here.read("out/s/mine.txt") == "mine");
  CHECK(fs::exists(here.path / "out/s/note.txt"));
}

TEST_CASE("with --force the frames of a film stay whole until all the new ones are there, however the run ends") {
  const Workplace here;
  const std::string text =
      "local ricochet = require 'ricochet'\nlocal p = ricochet.parameters { speed = 0.05 }\nricochet.animate { scene = "
      "ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 }, "
      "launch = { speed = p.speed } }, frames = 200, size = { 64, 36 }, out = 'film' }\n";
  REQUIRE(here.script(text).status == 0);
  const auto frames = [&] {
    std::string all;
    for (int k = 0; k < 200; ++k) {
      char name[40];
      std::snprintf(name, sizeof name, "out/s/film/%06d.png", k);
      all += here.read(name);
    }
    return all;
  };
  const std::string before = frames();
  here.write("out/s/film/mine.txt", "mine");
  // Killed once the first new picture is there.
  const Ended killed = here.shell("'" RICOCHET_PROGRAM
                                  "' run s.lua --force speed=0.04 & pid=$!; for k in $(seq 600); do test -e "
                                  "out/s/film.new/000003.png && break; sleep 0.05; done; kill -9 $pid; wait $pid; test "
                                  "-e out/s/film.new/000003.png");
  INFO(killed.err);
  CHECK(killed.status == 0);
  CHECK((frames() == before));
  CHECK(here.run("s.lua --force speed=0.04").status == 0);
  CHECK((frames() != before));
  CHECK_FALSE(fs::exists(here.path / "out/s/film.new"));
  CHECK(here.read("out/s/film/mine.txt") == "mine");
}

TEST_CASE("a script that has no name for a folder is refused, and costs nothing beside it") {
  const Workplace here;
  here.write("mine.png", "mine");
  for (const char* name : {"...lua", "..lua"}) {
    here.write(name, "local ricochet = require 'ricochet'\nricochet.file.write('note.txt', 'hello')\n");
    const Ended ended = here.run(std::string("./") + name + " --force");
    CHECK(ended.status == 4);
    CHECK_THAT(ended.first_line(), Catch::Matchers::Contains("has no name for a folder of results; rename the script"));
  }
  CHECK(here.read("mine.png") == "mine");
  CHECK_FALSE(fs::exists(here.path / "note.txt"));
}
