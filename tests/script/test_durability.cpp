// A sweep killed at any moment loses no row that was reported as stored, and doubles none.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <functional>
#include <map>
#include <random>
#include <thread>

#include "impact/outcome.hpp"
#include "script/digest.hpp"
#include "script/program.hpp"
#include "store/files.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// Starts the program, waits, and sends it a signal; the exit status, or minus the signal.
int run_and_kill(const Workplace& here, const std::vector<std::string>& arguments, const std::function<void()>& wait,
                 int signal) {
  const pid_t child = start(here, arguments);
  wait();
  kill(child, signal);
  return ended(child);
}

}  // namespace

TEST_CASE(
    "after 20 kills at random moments and --resume every row is there once, with the bits of an undisturbed run") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  const auto began = std::chrono::steady_clock::now();
  REQUIRE(here.run("s.lua samples=10 --quiet --out calm --batch 1").status == 0);
  const std::chrono::duration<double, std::milli> whole = std::chrono::steady_clock::now() - began;
  const auto window = static_cast<unsigned>(whole.count() / 2);  // however fast the machine, most kills find it at work
  const std::string expected = digest_of(read_table(here.path / "calm/s/results.h5"));
  std::mt19937 random(1);
  int killed = 0;
  std::size_t stored = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const std::chrono::milliseconds after(5 + random() % window);
    // Every few trials begin anew, so that kills hit young sweeps as well as nearly finished ones.
    const bool anew = trial % 5 == 0;
    if (anew) {
      stored = 0;
      fs::remove_all(here.path / "out");
    }
    const int status = run_and_kill(
        here, {"run", "s.lua", "samples=10", "--quiet", "--resume", "--batch", "1"},
        [&] { std::this_thread::sleep_for(after); }, SIGKILL);
    killed += status == -SIGKILL;
    std::size_t now = 0;
    if (fs::exists(here.path / "out/s/results.h5")) now += read_table(here.path / "out/s/results.h5").rows();
    if (fs::exists(here.path / "out/s/parts"))
      for (const auto& entry : fs::directory_iterator(here.path / "out/s/parts"))
        if (entry.path().extension() == ".h5") now += read_table(entry.path()).rows();  // every file is readable
    CHECK(now >= stored);
    stored = now;
  }
  CHECK(killed >= 8);
  const Ended last = here.run("s.lua samples=10 --quiet --resume");
  INFO(last.err);
  REQUIRE(last.status == 0);
  CHECK(read_table(here.path / "out/s/results.h5").rows() == 30);
  CHECK(digest_of(read_table(here.path / "out/s/results.h5")) == expected);
}

TEST_CASE("run and info print one digest of outcomes, which tells a changed bit and not how long an impact took") {
  const Workplace here;
  const Ended ended = here.script(small_sweep, "samples=1");
  REQUIRE(ended.status == 0);
  const fs::path results = here.path / "out/s/results.h5";
  Table table = read_table(results);
  const std::string digest = digest_of(table), line = "digest of outcomes " + digest + "\n";
  CHECK(digest.size() == 32);
  CHECK_THAT(ended.out, Catch::Matchers::Contains(line));
  CHECK_THAT(here.shell("ricochet info out").out, Catch::Matchers::Contains(line));
  const auto column = [&](const char* name) -> std::vector<double>& {
    return std::find_if(table.numbers.begin(), table.numbers.end(), [&](const auto& c) { return c.field.name == name; })
        ->values;
  };
  column("wall_seconds")[1] = 7;
  CHECK(digest_of(table) == digest);
  column("beta")[2] = std::nextafter(column("beta")[2], 1);
  CHECK(digest_of(table) != digest);
}

TEST_CASE("^C stores what is done, says how to resume, and exits with 130") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  const int status = run_and_kill(
      here, {"run", "s.lua", "samples=300", "--quiet"},
      [&] {
        for (int i = 0; i < 6000 && !fs::exists(here.path / "out/s/parts"); ++i)
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      },
      SIGINT);
  CHECK(status == 130);
  const Table table = read_table(here.path / "out/s/results.h5");
  CHECK(table.rows() > 0);
  CHECK(table.rows() < 900);
  CHECK_THAT(here.read("out/s/run.log"), Catch::Matchers::Contains("--resume goes on from there"));
  CHECK_FALSE(fs::exists(here.path / "out/s/parts"));
}

TEST_CASE("rows of another version or commit are refused by --resume, and left as they are") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua samples=2 --quiet").status == 0);
  const fs::path results = here.path / "out/s/results.h5";
  const Table table = read_table(results);
  Provenance origin = read_provenance(results);
  CHECK(here.run("s.lua samples=2 --quiet --resume").status == 0);
  for (const char* what : {"version", "commit"}) {
    Provenance other = origin;
    other[what] = "older";
    write_table(results, table, other);
    const std::string before = read_file(results);
    const Ended ended = here.run("s.lua samples=2 --quiet --resume");
    CHECK(ended.status == 4);
    CHECK_THAT(ended.err, Catch::Matchers::Contains(std::string("was written by ") + what + " older") &&
                              Catch::Matchers::Contains("--force"));
    CHECK(read_file(results) == before);
  }
}

TEST_CASE("threads and batch size do not change a row") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua --quiet --out a --threads 1 --batch 1").status == 0);
  REQUIRE(here.run("s.lua --quiet --out b --threads 3 --batch 3").status == 0);
  REQUIRE(here.run("s.lua --quiet --out c").status == 0);
  CHECK(digest_of(read_table(here.path / "a/s/results.h5")) == digest_of(read_table(here.path / "b/s/results.h5")));
  CHECK(digest_of(read_table(here.path / "a/s/results.h5")) == digest_of(read_table(here.path / "c/s/results.h5")));
}

// 200 trials, some minutes: ricochet_tests "200 trials*".
TEST_CASE(
    "200 trials of kills, full disks, read-only folders and damaged files lose no stored row and repair nothing in "
    "silence",
    "[.slow]") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua samples=40 --quiet --out calm").status == 0);
  const std::string expected = digest_of(read_table(here.path / "calm/s/results.h5"));
  const std::vector<std::string> command{"run", "s.lua", "samples=40", "--quiet", "--resume", "--batch", "1"};
  const bool may_mount =
      geteuid() == 0 &&
      here.shell("mkdir -p probe && mount -t tmpfs -o size=64k none probe && umount probe").status == 0;
  std::mt19937 random(2);
  std::map<std::string, int> counts;
  const auto stored = [&] {
    std::size_t rows = 0;
    if (fs::exists(here.path / "out/s/results.h5")) rows += read_table(here.path / "out/s/results.h5").rows();
    if (fs::exists(here.path / "out/s/parts"))
      for (const auto& entry : fs::directory_iterator(here.path / "out/s/parts"))
        if (entry.path().extension() == ".h5") rows += read_table(entry.path()).rows();
    return rows;
  };
  const auto completes = [&](std::size_t before) {
    CHECK(stored() >= before);
    const Ended last = here.run("s.lua samples=40 --quiet --resume");
    INFO(last.err);
    CHECK(last.status == 0);
    CHECK(stored() == 120);
    CHECK(digest_of(read_table(here.path / "out/s/results.h5")) == expected);
  };
  const auto killed_at_random = [&](int signal) {
    return run_and_kill(
        here, command, [&] { std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % 500)); }, signal);
  };
  for (int trial = 0; trial < 200; ++trial) {
    fs::remove_all(here.path / "out");
    const int kind = trial % 20;
    if (kind < 6) {
      const int status = killed_at_random(SIGKILL);
      counts[status == -SIGKILL ? "killed" : "killed too late"]++;
      const std::size_t before = stored();
      killed_at_random(SIGKILL);  // and again while it resumes
      completes(before);
    } else if (kind < 10) {
      const int status = killed_at_random(SIGTERM);
      INFO("status " << status);
      CHECK((status == 130 || status == 0 || status == -SIGTERM));
      counts[status == 130 ? "terminated" : status == 0 ? "terminated too late" : "terminated before it began"]++;
      completes(stored());
    } else if (kind < 12) {
      if (!may_mount) continue;
      const unsigned kilobytes = 8 + 4 * (random() % 80);
      REQUIRE(here.shell(fmt::format("mkdir out && mount -t tmpfs -o size={}k none out", kilobytes)).status == 0);
      const Ended full = here.run("s.lua samples=40 --quiet --resume --batch 1");
      INFO(kilobytes << " kB: " << full.err);
      CHECK((full.status == 4 || full.status == 0));
      if (full.status == 4) CHECK_THAT(full.err, Catch::Matchers::Contains("No space left on device; free some space"));
      counts[full.status == 4 ? "disk full" : "disk just large enough"]++;
      REQUIRE(here.shell("mount -o remount,size=20m out").status == 0);
      completes(stored());
      here.shell("umount out");
    } else if (kind < 13) {
      if (!may_mount) continue;
      REQUIRE(here.shell("mkdir out && mount -t tmpfs -o size=20m none out").status == 0);
      killed_at_random(SIGKILL);
      const std::size_t before = stored();
      REQUIRE(here.shell("mount -o remount,ro out").status == 0);
      const Ended locked = here.run("s.lua samples=40 --quiet --resume");
      INFO(locked.err);
      CHECK((locked.status == 4 || (locked.status == 0 && before == 120)));
      CHECK(stored() == before);
      counts["read-only"]++;
      REQUIRE(here.shell("mount -o remount,rw out").status == 0);
      completes(before);
      here.shell("umount out");
    } else {
      // Damage to the whole sweep's file, or to a part of one that was killed.
      const bool part = kind < 16;
      const auto first_part = [&] {
        for (int i = 0; i < 3000 && (!fs::exists(here.path / "out/s/parts") || fs::is_empty(here.path / "out/s/parts"));
             ++i)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      };
      if (part)
        run_and_kill(here, command, first_part, SIGKILL);
      else
        REQUIRE(here.run("s.lua samples=40 --quiet --resume").status == 0);
      std::vector<fs::path> files;
      if (fs::exists(here.path / "out"))
        for (const auto& entry : fs::recursive_directory_iterator(here.path / "out"))
          if (entry.path().extension() == ".h5") files.push_back(entry.path());
      if (files.empty()) {
        counts["nothing to damage"]++;
        continue;
      }
      const fs::path file = files[random() % files.size()];
      const std::string whole = read_file(file);
      std::string damaged = whole;
      if (trial % 2)
        damaged.resize(random() % whole.size());
      else
        damaged[random() % whole.size()] ^= static_cast<char>(1 << random() % 8);
      write_atomically(file, damaged);
      const Ended refused = here.run("s.lua samples=40 --quiet --resume");
      INFO(file.string() << ": " << refused.err);
      CHECK(refused.status == 4);
      CHECK_THAT(refused.err, Catch::Matchers::Contains(file.filename().string()) &&
                                  Catch::Matchers::Contains("restore it from a copy, or remove it"));
      CHECK(read_file(file) == damaged);
      counts[trial % 2 ? "truncated" : "bit flipped"]++;
      write_atomically(file, whole);
      completes(stored());
    }
  }
  for (const auto& [what, count] : counts) fmt::print("{:24} {}\n", what, count);
}
