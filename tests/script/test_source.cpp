#include <catch2/catch.hpp>

#include "script/source.hpp"

using namespace ricochet;

const char* script = R"(local r = require "ricochet"
-- disk { radus = 1 } in a comment
local text = "disk { radus = 2 }"
local s = r.scene {
  projectile = r.disk {
    nodes = 5, -- { radus = 3 }
	radus = 4,
  },
  launch = { speed = 1, psi1 = f(function() return { psi1 = 2 } end) },
}
)";

TEST_CASE("a field is found in its own table, not in comments, strings or inner tables") {
  const auto field = find_field(script, 5, "disk", {"radus"});
  REQUIRE(field);
  CHECK(field->line == 7);
  CHECK(field->column == 2);
  CHECK_FALSE(find_field(script, 4, "scene", {"radus"}));
  CHECK(find_field(script, 4, "scene", {"launch"})->line == 9);
  const auto inner = find_field(script, 4, "scene", {"launch", "psi1"});
  REQUIRE(inner);
  CHECK(inner->column == 25);
  CHECK_FALSE(find_field(script, 4, "scene", {"launch", "spin"}));
}

TEST_CASE("a field that is missing is not found in the next call's table") {
  const std::string calls = "local a = disk {}\nlocal b = disk { E = 2 }\nlocal c =\ndisk { E = 2 }\n";
  CHECK_FALSE(find_field(calls, 1, "disk", {"E"}));
  CHECK(find_field(calls, 2, "disk", {"E"})->line == 2);
  CHECK(find_field(calls, 3, "disk", {"E"})->line == 4);
}

TEST_CASE("an excerpt shows the line and points below the name, tabs kept") {
  CHECK(excerpt(script, {7, 2, 5}) == "    7 | \tradus = 4,\n      | \t^^^^^\n");
  CHECK(excerpt(script, {1, 1, 0}) == "    1 | local r = require \"ricochet\"\n");
  CHECK(excerpt(script, {99, 1, 0}).empty());
}
