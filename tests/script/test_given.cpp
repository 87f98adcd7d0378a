// What a script gives is taken as it was when it was given, whatever the script makes of it later.

#include <catch2/catch.hpp>

#include "script/program.hpp"

using namespace ricochet::test;

namespace {

const std::string bodies = "local ricochet = require 'ricochet'\nlocal disk, wall = ricochet.disk { nodes = 60 }, ricochet.wall { nodes = 150, width = 4 }\n";

}  // namespace

TEST_CASE("a table that changes after it was given changes nothing that was made from it") {
  const Workplace here;
  const Ended ended = here.script(bodies + R"lua(
local launch, of = { speed = 0.1 }, { "e" }
local scene = ricochet.scene { projectile = disk, target = wall, launch = launch }
local function bare() return ricochet.relevance { scene = scene, effects = { ricochet.gravity { g = 1e-4 } }, of = { "e" }, samples = 2 }[1].e.bare end
local before, text = bare(), scene:text()
launch.speed = 0.02
assert(bare() == before and scene:text() == text)
assert(scene:run().e ~= ricochet.scene { projectile = disk, target = wall, launch = launch }:run().e)

local values = { 0, 1 }
local sweep = ricochet.sweep { name = "w", over = { psi1 = values }, scene = function(at) return ricochet.scene { projectile = disk, target = wall, launch = { psi1 = at.psi1 } } end }
values[1], values[3] = 7, 8
local rows = sweep:run()
assert(#rows == 2 and rows[1].psi1 == 0 and rows[2].psi1 == 1)
)lua");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("a hole in a sweep's values, and a name that summaries take, are mistakes") {
  const Workplace here;
  const std::string begin = "local ricochet = require 'ricochet'\nricochet.sweep { name = 'w', over = { ", end = " }, scene = print }\n";
  CHECK(here.script(begin + "psi1 = { 0, 1, nil, 3 }" + end).first_line() == "error: s.lua:2: sweep: over.psi1 has nothing (nil) at place 3; leave that place out");
  CHECK(here.script("local v = {} for i = 1, 1100 do v[i] = i end for i = 300, 900 do v[i] = nil end " + begin + "psi1 = v" + end).first_line() ==
        "error: s.lua:2: sweep: over.psi1 has nothing (nil) at place 300; leave that place out");
  CHECK(here.script(begin + "count = { 0, 1 }" + end).first_line() == "error: s.lua:2: sweep: over.count: 'count' is a column of summaries; take another name");
}

TEST_CASE("fields that come by a table of defaults are fields, everywhere") {
  const Workplace here;
  const Ended ended = here.script(bodies + R"lua(
local defaults = { __index = { projectile = disk, target = wall, launch = setmetatable({ speed = 0.05 }, { __index = { psi1 = 1 } }) } }
local scene = ricochet.scene(setmetatable({ theta = 1 }, defaults))
local plain = ricochet.scene { projectile = disk, target = wall, theta = 1, launch = { speed = 0.05, psi1 = 1 } }
assert(scene:text() == plain:text() and scene:run().e == plain:run().e)
local function bare(of) return ricochet.relevance { scene = of, effects = { ricochet.gravity { g = 1e-4 } }, of = { "e" }, samples = 2 }[1].e.bare end
assert(bare(scene) == bare(plain))
print(pcall(ricochet.scene, setmetatable({ targt = wall }, defaults)))
)lua");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("unknown field 'targt' (did you mean 'target'?)"));
}

TEST_CASE("with --force a mistake costs no pictures or recordings, and what the next run does not make again goes") {
  const Workplace here;
  const std::string text = "local ricochet = require 'ricochet'\nlocal p = ricochet.parameters { stage = 0 }\nricochet.file.write('note.txt', 'hello')\n"
                           "if p.stage == 1 then error 'one' end\nif p.stage == 3 then\n"
                           "  ricochet.animate { scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 }, step = 1 }, frames = 5, out = 'film' }\nend\nlocal scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } }\n"
                           "ricochet.animate { scene = scene, frames = p.stage == 2 and 3 or 5, size = { 64, 36 }, out = 'film' }\n"
                           "if p.stage == 0 then ricochet.record { scene = scene, frames = 3 } ricochet.still { scene = scene, size = { 64, 36 } } end\n";
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
