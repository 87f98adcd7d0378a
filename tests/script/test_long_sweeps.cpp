// Sweeps of more points than are kept together: made chunk by chunk, to the same rows, in bounded memory.

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <set>
#include <thread>

#include "script/digest.hpp"
#include "script/program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

std::string digest(const Workplace& here, const std::string& folder) {
  return digest_of(read_table(here.path / folder / "results.h5"));
}

std::size_t files_in(const fs::path& folder) {
  std::error_code error;
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder, error), fs::directory_iterator()));
}

/// What was printed after the summary of the sweep itself, which tells seconds and folders.
std::string printed(const Ended& run) { return run.out.substr(std::min(run.out.find("BEGIN"), run.out.size())); }

/// A script's rows as it may use them, of names of every kind.
const char* uses_rows = R"(local ricochet = require "ricochet"
local sweep = ricochet.sweep {
  name = "s",
  over = { sample = { 1, 2, 3 }, rough = { false, true }, wall = { "hard", "soft" },
           ricochet.zip { psi1 = { 0, 1, 4 }, speed = { 0.1, 0.12, 0.05 } } },
  units = { speed = "c" },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = 40, roughness = at.rough and 0.03 or 0, seed = at.sample },
      target = ricochet.wall { width = 4, depth = 1.5, nodes = 100, stiffness = at.wall == "soft" and 100 or 400,
        seed = at.sample },
      launch = { psi1 = at.psi1, speed = at.speed },
    }
  end,
}
local rows = sweep:run()
print("BEGIN", #rows, rows[1].e, rows[36].wall, rows[7].rough, math.type(rows[9].sample))
local sum, count = 0, 0
for i, row in ipairs(rows) do
  sum, count = sum + row.e * i, count + 1
  row.twice = 2 * row.e
end
print(count, sum, rows[5].twice == 2 * rows[5].e, rows[3] == rows[3])
rows:summary { by = { "psi1", "wall" }, of = { "e", "twice" } }:print()
local soft = rows:where { wall = "soft", rough = true }
print(#soft, soft[2].scene_hash, pcall(function() return rows[1].misspelt end))
print(pcall(function() return rows[37] end), pcall(function() return rows.e end))
print(pcall(function() rows:summary { by = "psi1", of = { "misspelt" } } end))
print(rows:paired { by = "psi1", of = "e", at = { 0, 4 } }.change)
for name, value in pairs(rows[2]) do if name ~= "wall_seconds" then print(name, value) end end
print((tostring(rows[4]):gsub("wall_seconds[^\n]*", "")))
print(rows)
table.sort(rows, function(a, b) return a.e < b.e end)
print(rows[1].e, rows[36].e)
rows:save { name = "few", columns = { "e", "wall", "speed" } }
ricochet.plot { rows = rows, x = "psi1", y = { "e" }, name = "e" }
ricochet.report { rows = { rows[2], rows[30] } }
for _, row in ipairs(sweep:record { rows = { 3 }, frames = 5 }) do print(row.e == rows[3].e) end
)";

/// Many points of a tiny disk on a plane, whose impacts end at once.
const char* many_points = R"(local ricochet = require "ricochet"
local p = ricochet.parameters {
  samples = { 10, int = true, min = 1, doc = "lattices" }, angles = { 100, int = true, min = 1, doc = "angles" },
  fails = { 0, int = true, doc = "the call in which the scene fails" }, marks = { false, doc = "files at calls" },
}
local calls = 0
local psi1 = {}
for i = 1, p.angles do psi1[i] = 3 * i / p.angles end
local rows = ricochet.sweep {
  name = "s",
  over = { sample = ricochet.range(p.samples), psi1 = psi1, v = ricochet.range(0.01, 0.1, 0.01) },
  scene = function(at)
    calls = calls + 1
    if calls == p.fails then error "this scene is wrong" end
    return ricochet.scene { projectile = ricochet.disk { nodes = 12, seed = at.sample }, target = ricochet.plane {},
      launch = { speed = at.v, psi1 = at.psi1 }, ending = { at = "time", time = 0.2 } }
  end,
}:run()
print("calls", calls)
local sum = 0
for _, row in ipairs(rows) do sum = sum + row.psi1 * row.time end
print("sum", #rows, sum)
)";

/// The most memory that the program had resident, in kB, while it ran to a good end; files that lay there at most.
struct Used {
  long resident = 0;
  std::size_t files = 0;
};
Used used_by(const Workplace& here, const std::vector<std::string>& arguments, const fs::path& folder) {
  const pid_t child = start(here, arguments);
  Used used;
  int status = 0;
  struct rusage usage {};
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    used.files = std::max(used.files, files_in(folder));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  REQUIRE(WIFEXITED(status));
  REQUIRE(WEXITSTATUS(status) == 0);
  used.resident = usage.ru_maxrss;
  return used;
}

}  // namespace

TEST_CASE("a sweep that is made chunk by chunk gives the rows, words and files of one that is made at once") {
  const Workplace here;
  const Ended whole = here.script(uses_rows, "--quiet --out whole");
  INFO(whole.err);
  REQUIRE(whole.status == 0);
  for (const char* at_once : {"1", "7", "35"}) {
    fs::remove_all(here.path / "long");
    const Ended chunks = here.run(fmt::format("s.lua --quiet --out long --at-once {}", at_once));
    INFO(at_once << chunks.err);
    REQUIRE(chunks.status == 0);
    CHECK(printed(chunks) == printed(whole));
    CHECK(digest(here, "long/s") == digest(here, "whole/s"));
    CHECK(here.read("long/s/few.csv") == here.read("whole/s/few.csv"));
    CHECK(here.shell("ls whole/s").out == here.shell("ls long/s").out);
    const auto replays = [&](const std::string& folder) {
      const std::string page = here.read(folder + "/s/report.html");
      std::set<std::string> hashes;
      for (std::size_t at = 0; (at = page.find("id=\"replay-", at)) != std::string::npos; ++at)
        if (page.find_first_not_of("0123456789abcdef", at + 11) == at + 43) hashes.insert(page.substr(at + 11, 32));
      return hashes;
    };
    CHECK(replays("long").size() == 2);
    CHECK(replays("long") == replays("whole"));
  }
  CHECK(here.run("s.lua --check --at-once 7").status == 0);
}

TEST_CASE("chunk by chunk, accuracy, samples by error, twins and shards are what they are at once") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua --quiet --no-report --out whole").status == 0);
  for (int k = 0; k < 3; ++k)  // of four points each
    REQUIRE(here.run(fmt::format("s.lua --quiet --no-report --at-once 3 --shard {}/3 --out long", k)).status == 0);
  CHECK(files_in(here.path / "long/s/shards") == 3);
  REQUIRE(here.shell("ricochet merge s.lua --quiet --no-report --at-once 5 --out long").status == 0);
  CHECK(digest(here, "long/s") == digest(here, "whole/s"));
  std::string by_accuracy = small_sweep;
  by_accuracy.insert(by_accuracy.find("launch"), "accuracy = 1e-3, ");
  here.write("s.lua", by_accuracy);
  REQUIRE(here.run("s.lua --quiet --no-report --out one --at-once 5").status == 0);
  for (int k = 0; k < 2; ++k)
    REQUIRE(here.run(fmt::format("s.lua --quiet --at-once 5 --shard {}/2 --out two --steps two.steps", k)).status == 0);
  REQUIRE(here.shell("ricochet merge s.lua --quiet --no-report --at-once 5 --out two").status == 0);
  CHECK(digest(here, "two/s") == digest(here, "one/s"));
  // Which scenes are kept together has no say in their steps, so that a run goes on with another number.
  REQUIRE(here.run("s.lua --quiet --no-report --out at_once --steps at_once.steps").status == 0);
  CHECK(digest(here, "at_once/s") == digest(here, "one/s"));
  const Ended on = here.run("s.lua --no-report --out at_once --at-once 7 --resume");
  INFO(on.err);
  CHECK(on.status == 0);
  CHECK(on.err.find("s: ") == std::string::npos);  // nothing was left to run
  std::string twins = small_sweep;
  twins.replace(twins.find("psi1 = at.psi1"), 14, "psi1 = 1");
  here.write("s.lua", twins);
  CHECK_THAT(here.run("s.lua --out t --no-report --at-once 6").err, Contains("repeat another one exactly"));
}

TEST_CASE("trials choose the steps of as many scenes together whatever --at-once is, more than that, too", "[.slow]") {
  const Workplace here;
  std::string text = many_points;
  text.replace(text.find("launch ="), 0, "accuracy = 0.1, ");
  text.replace(text.find("ricochet.range(0.01, 0.1, 0.01)"), 31, "{ 0.1 }");
  here.write("s.lua", text);
  text.replace(text.find("time = 0.2"), 10, "time = 0.05");
  for (const char* at_once : {"8192", "9000"}) {
    const Ended run =
        here.run(fmt::format("s.lua --quiet --no-report samples=1 angles=8400 --out {} --at-once {} --steps {}.steps",
                             at_once, at_once, at_once));
    INFO(run.err);
    REQUIRE(run.status == 0);
  }
  CHECK(digest(here, "9000/s") == digest(here, "8192/s"));
}

TEST_CASE("the progress of a long sweep counts points, though scenes that repeat others run once") {
  const Workplace here;
  std::string twins = small_sweep;
  twins.replace(twins.find("{ 0, 1, 4 }"), 11, "p.all and { 0, 1, 4 } or { 0, 1 }");
  twins.replace(twins.find("samples = {"), 0, "all = { true, doc = \"angles\" }, ");
  while (twins.find("seed = at.sample") != std::string::npos)
    twins.replace(twins.find("seed = at.sample"), 16, "seed = 1");
  here.write("s.lua", twins);
  const auto last = [](const Ended& run) {
    INFO(run.err);
    REQUIRE(run.status == 0);
    const std::size_t at = run.err.rfind("s: ");
    REQUIRE(at != std::string::npos);
    return run.err.substr(at, run.err.find("  ", at) - at);
  };
  CHECK(last(here.run("s.lua --no-report --at-once 6")) == "s: 12/12");
  CHECK(last(here.run("s.lua --no-report --at-once 6 --out more all=false")) == "s: 8/8");
  CHECK(last(here.run("s.lua --no-report --at-once 6 --out more --resume")) == "s: 12/12");  // of 8 that are there
  CHECK(last(here.run("s.lua --no-report --out whole")) == "s: 12/12");
  CHECK(digest(here, "more/s") == digest(here, "whole/s"));
}

TEST_CASE("merging in part tells and counts the same of a long sweep as of one that is made at once") {
  const Workplace here;
  std::string text = small_sweep;
  text.replace(text.find("launch = {"), 0, "time_limit = at.sample == 1 and 0.1 or nil, ");
  here.write("s.lua", text);
  REQUIRE(here.run("s.lua --quiet --shard 0/4").status == 0);
  std::string told[2];
  for (const int k : {0, 1}) {
    fs::remove_all(here.path / "out/s/results.h5");
    const Ended merged =
        here.shell(fmt::format("ricochet merge s.lua --quiet --partial --no-report --at-once {}", k == 0 ? 5 : 100));
    told[k] = fmt::format("{}\n{}", merged.status, merged.err);
    CHECK_THAT(here.read("out/s/run.log"), Contains("s: 0 of 12 impacts finished"));
  }
  CHECK(told[0] == told[1]);
  CHECK_THAT(told[0],
             Catch::Matchers::StartsWith("3\n") && Contains("not one impact finished; the first ended out_of_time"));
}

TEST_CASE("an interruption while trials choose steps says what is stored and that it goes on") {
  const Workplace here;
  std::string text = small_sweep;
  text.replace(text.find("launch"), 0, "accuracy = 1e-7, ");
  text.replace(text.find("nodes = 60"), 10, "nodes = 600");
  text.replace(text.find("nodes = 150"), 11, "nodes = 2000");
  here.write("s.lua", text);
  const auto stopped = [&](const std::string& arguments) {
    return here.shell(
        "'" RICOCHET_PROGRAM "' run s.lua --no-report " + arguments +
        " >log 2>complaint & for i in $(seq 600); do grep -q 'tries steps' log && break; sleep 0.05; done\n"
        "kill -TERM $!; wait $!; status=$?; cat complaint; exit $status");
  };
  const auto told = [&](const std::string& arguments, const std::string& what) {
    const Ended ended = stopped(arguments);
    INFO(arguments << ended.out);
    CHECK(ended.status == 130);
    CHECK_THAT(ended.out, Contains("interrupted while trials chose steps") && Contains(what));
  };
  told("", "no impact of 's' has run; the same command begins again");
  told("--at-once 5", "0 of 12 impacts are stored in out/s; --resume goes on from there");
  told("--shard 0/2 --out shards", "no shard of 's' has begun, and there is no plan yet");
}

TEST_CASE("of a long sweep the scenes are made as they are run, and what is stored survives a mistake in one") {
  const Workplace here;
  const Ended failed = here.script(many_points, "--no-report --at-once 500 samples=4 angles=50 fails=1500");
  CHECK(failed.status == 1);
  CHECK_THAT(failed.err, Contains("this scene is wrong") && Contains("in the sweep at"));
  CHECK_THAT(failed.err, Contains("what was stored stays in out"));
  CHECK(files_in(here.path / "out/s/parts") == 2);  // two chunks of 500 in files of their own
  const std::string so_far = here.shell("ricochet status out/s --csv").out;
  CHECK_THAT(so_far.substr(0, so_far.find('\n')), Catch::Matchers::StartsWith("over_psi1,sample,v,e,"));
  const Ended refused = here.run("s.lua --no-report --at-once 500 samples=3 angles=49 --resume");
  CHECK(refused.status == 4);
  CHECK_THAT(refused.err, Contains("rows of other scenes"));
  const Ended rest = here.run("s.lua --no-report --at-once 500 samples=4 angles=50 --resume");
  INFO(rest.err);
  REQUIRE(rest.status == 0);
  const std::size_t told = rest.err.find("s: ");
  REQUIRE(told != std::string::npos);
  CHECK(std::stoul(rest.err.substr(told + 3)) > 1000);  // the first thousand did not run again
  const Ended whole = here.run("s.lua --no-report samples=4 angles=50 --out whole");
  REQUIRE(whole.status == 0);
  CHECK(digest(here, "out/s") == digest(here, "whole/s"));
  CHECK(rest.out.substr(rest.out.find("sum")) == whole.out.substr(whole.out.find("sum")));
  const Ended more = here.run("s.lua --quiet --no-report --at-once 500 samples=5 angles=50 --resume");
  INFO(more.err);
  CHECK(more.status == 0);
}

TEST_CASE("a long sweep that is killed, or told to stop, goes on from what its parts hold") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  const std::string command = "s.lua --quiet --no-report samples=60 --at-once 40";
  REQUIRE(here.run(command + " --out calm").status == 0);
  for (const int signal : {SIGKILL, SIGTERM}) {
    fs::remove_all(here.path / "out");
    const pid_t child = start(here, {"run", "s.lua", "--no-report", "samples=60", "--at-once", "40", "--flush", "0"});
    for (int i = 0; i < 6000 && files_in(here.path / "out/s/parts") < 3; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(child, signal);
    CHECK(ended(child) == (signal == SIGKILL ? -SIGKILL : 130));
    const Ended rest = here.run(command + " --resume");
    INFO(rest.err);
    REQUIRE(rest.status == 0);
    CHECK(digest(here, "out/s") == digest(here, "calm/s"));
    CHECK_FALSE(fs::exists(here.path / "out/s/parts"));
  }
}

TEST_CASE("memory and files of a long sweep are those of a chunk") {
  const Workplace here;
  here.write("s.lua", many_points);
  const Used used =
      used_by(here, {"run", "s.lua", "--quiet", "--no-report", "--at-once", "1000"}, here.path / "out/s/parts");
  CHECK(used.files <= 14);
  if (!machine_can_be_broken) return;  // sanitizers have a memory of their own
  CHECK(used.resident < 90'000);       // at once it takes 106 MB
}

TEST_CASE("a million points: less than 1 GB, run, and merged from shards", "[.slow]") {
  const Workplace here;
  here.write("s.lua", many_points);
  const Used run = used_by(here, {"run", "s.lua", "--quiet", "samples=1000"}, here.path / "out/s/parts");
  WARN(fmt::format("run: {} MB, {} files", run.resident / 1000, run.files));
  CHECK(run.resident < 1'000'000);
  CHECK(run.files < 200);
  for (int k = 0; k < 40; ++k)
    REQUIRE(here.run(fmt::format("s.lua --quiet samples=1000 --out shards --shard {}/40", k)).status == 0);
  const Used merged =
      used_by(here, {"merge", "s.lua", "--quiet", "samples=1000", "--out", "shards"}, here.path / "shards/s");
  WARN(fmt::format("merge: {} MB", merged.resident / 1000));
  CHECK(merged.resident < 1'000'000);
  CHECK(here.shell("ricochet info out/s | grep digest").out == here.shell("ricochet info shards/s | grep digest").out);
}
