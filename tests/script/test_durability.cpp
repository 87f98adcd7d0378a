// A sweep killed at any moment loses no row that was reported as stored, and doubles none.

#include <catch2/catch.hpp>
#include <csignal>
#include <functional>
#include <fmt/format.h>
#include <random>
#include <thread>

#include "core/hash.hpp"
#include "impact/outcome.hpp"
#include "script/program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// Everything about the rows but the time they took.
std::string rows_hash(const fs::path& file) {
  const Table table = read_table(file);
  std::string text;
  for (const auto& column : table.numbers)
    if (column.field.name != "wall_seconds")
      for (const double v : column.values) text += fmt::format("{:a};", v);
  for (const auto& column : table.texts)
    for (const std::string& v : column.values) text += v + ";";
  return hash_text(text);
}

/// Starts the program, waits, and sends it a signal; the exit status, or minus the signal.
int run_and_kill(const Workplace& here, const std::vector<std::string>& arguments, const std::function<void()>& wait, int signal) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(here.path.c_str()) != 0) _exit(99);
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, 1), dup2(null, 2);
    std::vector<char*> words{const_cast<char*>(RICOCHET_PROGRAM)};
    for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
    words.push_back(nullptr);
    execv(RICOCHET_PROGRAM, words.data());
    _exit(99);
  }
  wait();
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

TEST_CASE("after 20 kills at random moments and --resume every row is there once, with the bits of an undisturbed run") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua samples=10 --quiet --out calm").status == 0);
  const std::string expected = rows_hash(here.path / "calm/s/results.h5");
  std::mt19937 random(1);
  int killed = 0;
  std::size_t stored = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const std::chrono::milliseconds after(5 + random() % 300);
    // Every few trials begin anew, so that kills hit young sweeps as well as nearly finished ones.
    const bool anew = trial % 5 == 0;
    if (anew) stored = 0, fs::remove_all(here.path / "out");
    const int status = run_and_kill(here, {"run", "s.lua", "samples=10", "--quiet", "--resume", "--batch", "1"}, [&] { std::this_thread::sleep_for(after); }, SIGKILL);
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
  CHECK(rows_hash(here.path / "out/s/results.h5") == expected);
}

TEST_CASE("^C stores what is done, says how to resume, and exits with 130") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  const int status = run_and_kill(here, {"run", "s.lua", "samples=300", "--quiet"}, [&] {
    for (int i = 0; i < 6000 && !fs::exists(here.path / "out/s/parts"); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }, SIGINT);
  CHECK(status == 130);
  const Table table = read_table(here.path / "out/s/results.h5");
  CHECK(table.rows() > 0);
  CHECK(table.rows() < 900);
  CHECK_THAT(here.read("out/s/run.log"), Catch::Matchers::Contains("--resume goes on from there"));
  CHECK_FALSE(fs::exists(here.path / "out/s/parts"));
}

TEST_CASE("threads and batch size do not change a row") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua --quiet --out a --threads 1 --batch 1").status == 0);
  REQUIRE(here.run("s.lua --quiet --out b --threads 3 --batch 3").status == 0);
  REQUIRE(here.run("s.lua --quiet --out c").status == 0);
  CHECK(rows_hash(here.path / "a/s/results.h5") == rows_hash(here.path / "b/s/results.h5"));
  CHECK(rows_hash(here.path / "a/s/results.h5") == rows_hash(here.path / "c/s/results.h5"));
}
