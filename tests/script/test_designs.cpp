// Values of `over` that go together, lists of values, and rows in files of their own.

#include <catch2/catch.hpp>
#include <set>

#include "script/digest.hpp"
#include "script/program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

std::string sweep_over(const std::string& over) {
  return "local ricochet = require \"ricochet\"\nlocal rows = ricochet.sweep { name = \"s\", over = " + over +
         ", units = { speed = \"c\" }, scene = function(at) return ricochet.scene { projectile = ricochet.disk { nodes "
         "= 60, seed = at.sample }, target = ricochet.wall { nodes = 150, stiffness = 400 }, launch = { speed = "
         "at.speed, psi1 = at.psi1 } } end }:run()\n";
}

}  // namespace

TEST_CASE("zip takes values by their places, beside names that go with each, in shards as in one run") {
  const Workplace here;
  const std::string text =
      sweep_over("{ sample = { 1, 2 }, ricochet.zip { speed = { 0.1, 0.2, 0.3 }, psi1 = { 0, 1, 3 } } }");
  REQUIRE(here.script(text, "--quiet --no-report --out calm").status == 0);
  const Table table = read_table(here.path / "calm/s/results.h5");
  REQUIRE(table.rows() == 6);
  for (std::size_t row = 0; row < 6; ++row)
    CHECK(table.number("over_psi1")->values[row] == (std::vector<double>{0, 1, 3})[row / 2]);
  CHECK(table.number("speed")->values == std::vector<double>{0.1, 0.1, 0.2, 0.2, 0.3, 0.3});
  CHECK(table.number("sample")->values == std::vector<double>{1, 2, 1, 2, 1, 2});
  for (const char* shard : {"0/3", "1/3", "2/3"})
    REQUIRE(here.run(std::string("s.lua --quiet --shard ") + shard).status == 0);
  REQUIRE(here.shell("ricochet merge s.lua --quiet --no-report").status == 0);
  CHECK(digest_of(read_table(here.path / "out/s/results.h5")) == digest_of(table));
}

TEST_CASE("a latin hypercube has one point in each part of every range, and by its seed the same ones") {
  const Ended ended = script_with_module(R"(
    local function design(seed)
      return ricochet.latin_hypercube { n = 50, ranges = { speed = { 0.01, 0.3 }, psi1 = { -1, 3 } }, seed = seed }[1]
    end
    local a, b, c = design(1), design(1), design(2)
    local same, other, parts = true, false, { speed = {}, psi1 = {} }
    for i = 1, 50 do
      same = same and a.speed[i] == b.speed[i] and a.psi1[i] == b.psi1[i]
      other = other or a.speed[i] ~= c.speed[i]
      parts.speed[math.floor((a.speed[i] - 0.01) / 0.29 * 50)] = true
      parts.psi1[math.floor((a.psi1[i] + 1) / 4 * 50)] = true
    end
    local count = 0
    for _, of in pairs(parts) do for k = 0, 49 do count = count + (of[k] and 1 or 0) end end
    print(same, other, count)
    local speeds = ricochet.logspace(0.01, 1, 3)
    print(#speeds, speeds[1], math.abs(speeds[2] - 0.1) < 1e-15, speeds[3])
  )");
  INFO(ended.err);
  CHECK(ended.out == "true\ttrue\t100\n3\t0.01\ttrue\t1\n");
}

TEST_CASE("rows:save writes columns with their units, those of a script among them, as CSV and HDF5") {
  const Workplace here;
  const Ended ended =
      here.script(sweep_over("{ sample = { 1 }, ricochet.zip { speed = { 0.1, 0.2 }, psi1 = { 0, 1 } } }") +
                      "for _, row in ipairs(rows) do row.mine = row.speed * 2 end\n"
                      "rows:save { name = \"few\", columns = { \"speed\", \"status\", \"contact_time\", \"mine\" } }\n",
                  "--no-report");
  INFO(ended.err);
  REQUIRE(ended.status == 0);
  CHECK_THAT(ended.out, Contains("rows: 2 in out/s/few.h5"));
  const std::string csv = here.read("out/s/few.csv");
  CHECK(csv.substr(0, csv.find('\n')) == "speed [c],contact_time [R/c],mine,status");
  CHECK_THAT(csv, Contains("\n0.2,") && Contains(",0.4,finished\n"));
  CHECK(read_table(here.path / "out/s/few.h5").number("speed")->field.unit == "c");
}

TEST_CASE("designs that cannot be are refused at their line") {
  const auto refused = [](const std::string& line) { return script_with_module(line).err; };
  CHECK_THAT(refused("ricochet.zip { a = { 1, 2 }, b = { 1 } }"), Contains("s.lua:2") && Contains("equal length"));
  CHECK_THAT(refused("ricochet.zip { a = {} }"), Contains("not empty"));
  CHECK_THAT(refused("ricochet.latin_hypercube { n = 5, ranges = { a = { 2, 1 } } }"), Contains("{ low, high }"));
  CHECK_THAT(refused("ricochet.logspace(0, 1, 3)"), Contains("above 0"));
  const auto over = [](const std::string& text) { return script_with_module(sweep_over(text)).err; };
  CHECK_THAT(over("{ speed = { 1 }, ricochet.zip { speed = { 1 } } }"), Contains("'speed' is given twice"));
  CHECK_THAT(over("{ sample = { 1 }, 5 }"), Contains("'over' takes name = list of values"));
  CHECK_THAT(over("{ design = ricochet.zip { speed = { 1 } } }"), Contains("over.design"));
}

TEST_CASE("values of 'over' that belong to no name are refused, not left out") {
  const auto refused = [](const std::string& over) {
    const Ended ended = script_with_module(sweep_over(over));
    INFO(over << ended.err);
    CHECK(ended.status == 1);
    return ended.err;
  };
  CHECK_THAT(refused("{ speed = { 0.1 }, psi1 = { 0 }, [3] = ricochet.zip { sample = { 1, 2 } } }"), Contains("[3]"));
  CHECK_THAT(refused("{ speed = { 0.1 }, psi1 = { 0 }, [true] = { 1 } }"), Contains("[true]"));
  CHECK_THAT(refused("{ speed = { 0.1 }, { { psi1 = { 0 } }, sample = { 1, 2 } } }"), Contains("[sample]"));
}

TEST_CASE("a sweep over psi1 of a disk that spins tells what was asked for from what its contact had") {
  const std::string text = R"(local ricochet = require "ricochet"
local rows = ricochet.sweep { name = "s", over = { psi1 = { 0, 1 }, seed = { 7 } }, scene = function(at)
  return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = at.seed },
    target = ricochet.wall { nodes = 150, stiffness = 400 }, launch = { normal_speed = 0.1, psi1 = at.psi1, spin = 0.05 } } end }:run()
for _, row in ipairs(rows) do
  print(("%g %g %.3f %g %s"):format(row.psi1, row.over_psi1, row.outcome_psi1, row.seed, row.outcome_seed))
end
print(rows:summary { by = "over_psi1", of = { "outcome_psi1", "e" } })
rows:save { name = "kept", columns = { "psi1", "outcome_psi1" } }
ricochet.plot { rows = rows, x = "psi1", y = { "outcome_psi1", "e" }, name = "p" }
)";
  std::string told;
  for (const char* how : {"", " --at-once 1 --force"}) {  // held, and read from results.h5
    const Workplace here;
    const Ended ended =
        here.script(text.substr(0, text.find("ricochet.plot")), "--quiet --no-report" + std::string(how));
    INFO(ended.err);
    REQUIRE(ended.status == 0);
    // The rim moves at R omega, half of the normal speed.
    CHECK_THAT(ended.out, Contains("0 0 0.499 7 7\n1 1 1.499 7 7\n") && !Contains("averaged over psi1"));
    const Table table = read_table(here.path / "out/s/results.h5");
    CHECK(table.number("over_psi1")->values == std::vector<double>{0, 1});
    CHECK(std::abs(std::abs(table.number("psi1")->values[1] - 1) - 0.5) < 1e-3);
    CHECK_THAT(here.read("out/s/kept.csv"), Catch::Matchers::StartsWith("psi1,outcome_psi1\n0,"));
    if (told.empty()) told = ended.out;
    CHECK(ended.out == told);
  }
  const Workplace here;
  const Ended drawn = here.script(text, "--quiet --no-report");
  INFO(drawn.err);
  REQUIRE(drawn.status == 0);
  CHECK_THAT(here.read("out/s/p.gp"), Contains("'incidence Ψ_1'") && Contains("'incidence of the contact Ψ_1'"));
  const char* taken = "require('ricochet').sweep { name = 's', over = { over_psi1 = { 1 } }, scene = print }";
  CHECK_THAT(here.script(taken, "--force").err, Contains("'over_psi1' is a column of the outcome; take another name"));
}
