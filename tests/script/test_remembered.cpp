// Methods and steps that trials chose, remembered for runs to come.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "program.hpp"
#include "script/own_commit.hpp"
#include "script/remembered_steps.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

// `rows` with every bit of what is not a time.
std::string asked(const std::string& accuracy) {
  return R"lua(local ricochet = require "ricochet"
local rows = ricochet.sweep {
  name = "s", over = { psi1 = { 0, 3 }, sample = { 1, 2, 3 } },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = 60, roughness = 0.03, seed = at.sample },
      target = ricochet.wall { width = 4, depth = 1.5, nodes = 150, stiffness = 400, roughness = 0.03,
        seed = at.sample },
      launch = { psi1 = at.psi1 }, contact = { V0 = 150, xi = 300 }, accuracy = )lua" +
         accuracy + R"lua(,
    }
  end,
}:run()
local list = {}
for _, row in ipairs(rows) do
  list[#list + 1] = ("%.17g %.17g %.17g %s"):format(row.e, row.psi2, row.error_step, row.scene_hash)
end
print("bits: " .. table.concat(list, ";"))
)lua";
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

}  // namespace

TEST_CASE("a choice of steps is remembered, and the run by it has the bits of one that tried") {
  const Workplace here;
  const Ended cold = here.script(asked("1e-2"));
  const std::string bits = bits_of(cold);
  INFO(cold.out << cold.err);
  REQUIRE(!bits.empty());
  CHECK_THAT(cold.out, Contains("tries steps in 6 of 6 scenes") && !Contains("remembered"));
  const Ended warm = here.run("s.lua --force");
  CHECK(bits_of(warm) == bits);
  CHECK_THAT(warm.out, Contains("remembered: ") && !Contains("tries steps"));
  SECTION("another accuracy is another choice, which leaves the first one known") {
    CHECK_THAT(here.script(asked("3e-2"), "--force").out, Contains("tries steps"));
    CHECK_THAT(here.script(asked("1e-2"), "--force").out, Contains("remembered: "));
  }
  SECTION("of a program of another commit nothing is taken") {
    std::string text = here.read("out/run.steps");
    text.insert(text.find("(commit ") + 8, "0");
    write(here.path / "out/run.steps", text);
    CHECK_THAT(here.run("s.lua --force").out, Contains("tries steps"));
  }
  SECTION("of a damaged file nothing is taken, which is told, and it is written anew") {
    std::string text = here.read("out/run.steps");
    text[text.size() - 5] ^= 1;
    write(here.path / "out/run.steps", text);
    const Ended again = here.run("s.lua --force");
    CHECK(bits_of(again) == bits);
    CHECK_THAT(again.err, Contains("out/run.steps is damaged"));
    CHECK_THAT(here.run("s.lua --force").out, Contains("remembered: "));
  }
  SECTION("a file of one's own holds it for other folders of results") {
    CHECK(here.run("s.lua --force --steps s.steps").status == 0);
    CHECK_THAT(here.run("s.lua --out other --steps s.steps").out, Contains("remembered: "));
    CHECK_FALSE(fs::exists(here.path / "other/run.steps"));
  }
  SECTION("a file of something else is not overwritten") {
    write(here.path / "letter.txt", "Dear all\n");
    const Ended refused = here.run("s.lua --force --steps letter.txt");
    CHECK(refused.status == 4);
    CHECK_THAT(refused.first_line(), Contains("letter.txt is not a file of steps"));
    CHECK(here.read("letter.txt") == "Dear all\n");
    CHECK_THAT(here.run("s.lua --force --steps .").first_line(), Contains("is not a file; give another"));
  }
}

TEST_CASE("what trials chose is read as it was written, every bit") {
  const Workplace here;
  const fs::path file = here.path / "some.steps";
  const TriedChoice whole{{"pefrl", 0.1, 1.0 / 3, 1.5, 2e-4, Found::extrapolated, 18, 5e8, {}}, not_given};
  TriedChoice some = whole;
  some.choice.left_out = {{2, 0.7, ""}, {4, not_given, "tunnelled"}};
  some.error_contact = 1e-3;
  {
    RememberedSteps steps;
    TriedChoices& tried = steps.read(file);
    CHECK(tried.empty());
    tried["a"] = whole;
    tried["b"] = some;
    steps.write(file);
  }
  RememberedSteps again;
  const TriedChoices& tried = again.read(file);
  REQUIRE(tried.size() == 2);
  for (const auto& [name, wanted] : TriedChoices{{"a", whole}, {"b", some}}) {
    const auto& [choice, error_contact] = tried.at(name);
    CHECK(choice.method == "pefrl");
    CHECK((choice.step == 0.1 && choice.theta == 1.0 / 3 && choice.longest == 1.5 && choice.error == 2e-4));
    CHECK((choice.found == Found::extrapolated && choice.trials == 18 && choice.evaluations == 5e8));
    CHECK(std::isnan(error_contact) == std::isnan(wanted.error_contact));
    CHECK(choice.left_out.size() == wanted.choice.left_out.size());
  }
  CHECK(tried.at("b").choice.left_out[0].scene == 2);
  CHECK(tried.at("b").choice.left_out[0].error == 0.7);
  CHECK(std::isnan(tried.at("b").choice.left_out[1].error));
}

TEST_CASE("a file of more choices than are kept counts as empty: it grows no further") {
  const Workplace here;
  const fs::path file = here.path / "many.steps";
  const TriedChoice some{{"pefrl", 0.1, 1.0 / 3, 1.5, 2e-4, Found::extrapolated, 18, 5e8, {}}, 1e-3};
  const auto add_up_to = [&](std::size_t count) {
    RememberedSteps steps;
    TriedChoices& tried = steps.read(file);
    for (std::size_t i = 0; i < count; ++i) tried[fmt::format("{:016x}", i)] = some;
    steps.write(file);
    return RememberedSteps().read(file).size();
  };
  CHECK(add_up_to(20'000) == 20'000);
  CHECK(add_up_to(20'001) == 0);
  CHECK(add_up_to(1) == 1);
}

TEST_CASE("a program of changed or unknown sources goes by its own hash, one of a commit by that") {
  const Workplace here;
  write(here.path / "one", "one");
  write(here.path / "other", "other");
  for (const std::string commit : {"0a2d1a7-dirty", "unknown"}) {
    CHECK_THAT(commit_of(commit, here.path / "one"), Catch::Matchers::StartsWith(commit + ", program "));
    CHECK(commit_of(commit, here.path / "one") != commit_of(commit, here.path / "other"));
  }
  CHECK(commit_of("0a2d1a7", here.path / "one") == "0a2d1a7");
}
