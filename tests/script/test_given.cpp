// What a script gives is taken as it was when it was given, whatever the script makes of it later.

#include <catch2/catch.hpp>

#include "script/program.hpp"

using namespace ricochet::test;

namespace {

const std::string bodies =
    "local ricochet = require 'ricochet'\nlocal disk, wall = ricochet.disk { nodes = 60 }, ricochet.wall { nodes = "
    "150, width = 4 }\n";

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
  const std::string begin = "local ricochet = require 'ricochet'\nricochet.sweep { name = 'w', over = { ",
                    end = " }, scene = print }\n";
  CHECK(here.script(begin + "psi1 = { 0, 1, nil, 3 }" + end).first_line() ==
        "error: s.lua:2: sweep: over.psi1 has nothing (nil) at place 3; leave that place out");
  CHECK(here.script("local v = {} for i = 1, 1100 do v[i] = i end for i = 300, 900 do v[i] = nil end " + begin +
                    "psi1 = v" + end)
            .first_line() == "error: s.lua:2: sweep: over.psi1 has nothing (nil) at place 300; leave that place out");
  CHECK(here.script(begin + "count = { 0, 1 }" + end).first_line() ==
        "error: s.lua:2: sweep: over.count: 'count' is a column of summaries; take another name");
}

TEST_CASE("fields that come by a table of defaults are fields, everywhere") {
  const Workplace here;
  const Ended ended = here.script(bodies + R"lua(
local defaults = { __index = { projectile = disk, target = wall, launch = setmetatable({ speed = 0.05 }, { __index = { psi1 = 1 } }) } }
local scene = ricochet.scene(setmetatable({ theta = 0.25 }, defaults))
local plain = ricochet.scene { projectile = disk, target = wall, theta = 0.25, launch = { speed = 0.05, psi1 = 1 } }
assert(scene:text() == plain:text() and scene:run().e == plain:run().e)
local function bare(of) return ricochet.relevance { scene = of, effects = { ricochet.gravity { g = 1e-4 } }, of = { "e" }, samples = 2 }[1].e.bare end
assert(bare(scene) == bare(plain))
print(pcall(ricochet.scene, setmetatable({ targt = wall }, defaults)))
)lua");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("unknown field 'targt' (did you mean 'target'?)"));
}
