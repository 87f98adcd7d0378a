// ricochet.modes as a script sees it.

#include <catch2/catch.hpp>
#include <filesystem>

#include "script/program.hpp"

using namespace ricochet::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("scripts: modes of a body are listed by rising frequency, in its units, and drawn") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
local bar = ricochet.rectangle { width = 0.1, height = 0.01, material = ricochet.materials.steel, nodes = 1200,
  interior = "elements" }
local modes = ricochet.modes { body = bar, count = 4, out = "bar", size = { 640, 360 } }
assert(#modes == 4 and modes[1].omega < modes[2].omega and modes[4].mode == 4 and modes[1].participation_x < 1e-9)
-- The slowest is that of a slender bar that bends: 22.37 sqrt(E I/(rho A))/length^2, a little slower as it is not.
local slender = 22.37 * math.sqrt(205e9 / 7850 / 12) * 0.01 / 0.1 ^ 2
assert(modes[1].omega < slender and modes[1].omega > 0.93 * slender, modes[1].omega / slender)
local most = 0
for _, node in ipairs(modes[1].shape) do most = math.max(most, node.ux ^ 2 + node.uy ^ 2) end
assert(math.abs(most - 1) < 1e-12)
)");
  INFO(ended.err);
  CHECK(ended.status == 0);
  CHECK(fs::exists(here.path / "out/s/bar.png"));
}

TEST_CASE("scripts: what has no modes, or fewer, is refused by name") {
  const Workplace here;
  const auto refused = [&](const std::string& call) {
    const Ended ended = here.script("local ricochet = require \"ricochet\"\nricochet.modes { " + call + " }\n");
    CHECK(ended.status == 1);
    return ended.err;
  };
  CHECK_THAT(refused("body = ricochet.plane {}"), Contains("'body': nothing moves inside a rigid body"));
  CHECK_THAT(refused("body = ricochet.disk { nodes = 30 }, count = 90"), Contains("has 57 modes; ask for no more"));
  CHECK_THAT(refused("body = ricochet.disk { nodes = 30 }, film = \"x\""), Contains("'film': 'x' must end in .mp4"));
  CHECK_THAT(refused("body = ricochet.disk { nodes = 30 }, count = 3, film = \"x.mp4\", filmed = 5"),
             Contains("'filmed': is 5, and 3 modes are asked for"));
}
