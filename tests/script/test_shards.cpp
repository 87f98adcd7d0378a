// A sweep in shards, each a process: merged to the digest of one run, whoever is killed, twice there or refused a lock.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "script/digest.hpp"
#include "script/program.hpp"
#include "script/shard_choice.hpp"
#include "script/shard_plan.hpp"
#include "store/files.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

std::string digest(const Workplace& here, const std::string& folder) {
  return digest_of(read_table(here.path / folder / "results.h5"));
}

/// Of the small sweep, run by itself.
std::string undisturbed(const Workplace& here, const std::string& arguments = "") {
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua --quiet --no-report --out calm " + arguments).status == 0);
  return digest(here, "calm/s");
}

/// All shards, two at a time; fails if one does.
Ended run_shards(const Workplace& here, int count, const std::string& arguments = "", const std::string& before = "") {
  return here.shell(before + fmt::format("run_one() {{ ricochet run s.lua --quiet --threads 1 {} --shard $1/{}; }}\n"
                                         "failed=0; for k in $(seq 0 2 {}); do run_one $k & first=$!\n"
                                         "  if [ $((k + 1)) -lt {} ]; then run_one $((k + 1)) || failed=$?; fi\n"
                                         "  wait $first || failed=$?; done; exit $failed",
                                         arguments, count, count - 1, count));
}

Ended merge(const Workplace& here, const std::string& arguments = "") {
  return here.shell("ricochet merge s.lua --quiet --no-report " + arguments);
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

/// wall_seconds by scene: whoever runs an impact again takes another time for it.
std::map<std::string, double> seconds_in(const fs::path& file) {
  const Table table = read_table(file);
  std::map<std::string, double> seconds;
  for (std::size_t i = 0; i < table.rows(); ++i)
    seconds[table.text("scene_hash")->values[i]] = table.number("wall_seconds")->values[i];
  return seconds;
}

/// The same of all files of rows in a folder, which may not be there yet; they come while a shard runs.
std::map<std::string, double> rows_below(const fs::path& shards) {
  std::map<std::string, double> rows;
  if (!fs::exists(shards)) return rows;
  for (const std::string& name : files_in(shards)) {
    if (!name.ends_with(".h5")) continue;
    try {
      rows.merge(seconds_in(shards / name));
    } catch (const ricochet::FileError&) {
      if (fs::exists(shards / name)) throw;  // else it went into another one meanwhile
    }
  }
  return rows;
}

/// Writes a table of rows again with the next number in one place.
void change_a_bit(const fs::path& from, const fs::path& to) {
  Table table = read_table(from);
  for (NumberColumn& column : table.numbers)
    if (column.field.name == "vn") column.values.front() = std::nextafter(column.values.front(), 2);
  write_table(to, table, read_provenance(from));
}

}  // namespace

TEST_CASE("1, 3, 4 and 7 shards are merged to the digest of one run, and leave one file each until then") {
  const Workplace here;
  const std::string expected = undisturbed(here);
  for (const int count : {1, 3, 4, 7}) {
    INFO(count << " shards");
    fs::remove_all(here.path / "out");
    const Ended shards = run_shards(here, count);
    INFO(shards.err);
    REQUIRE(shards.status == 0);
    CHECK(files_in(here.path / "out/s") == std::set<std::string>{"plan.h5", "shards"});
    CHECK(files_in(here.path / "out/s/shards").size() == static_cast<std::size_t>(count));
    const Ended merged = merge(here);
    INFO(merged.err);
    REQUIRE(merged.status == 0);
    CHECK(merged.out == here.read("calm/s/run.log").substr(here.read("calm/s/run.log").find("psi1 ")));
    CHECK(digest(here, "out/s") == expected);
    CHECK(files_in(here.path / "out/s") == std::set<std::string>{"results.csv", "results.h5", "run.log"});
  }
}

TEST_CASE("merge leaves what run leaves, and info the same digest") {
  const Workplace here;
  here.write("s.lua", std::string(small_sweep) +
                          "ricochet.plot { rows = rows, x = \"psi1\", y = { \"e\" }, name = \"e\" }\n"
                          "ricochet.file.write(\"note.txt\", \"done\")\n");
  REQUIRE(here.run("s.lua --quiet --out calm samples=1").status == 0);
  REQUIRE(run_shards(here, 2, "samples=1").status == 0);
  CHECK(files_in(here.path / "out/s") == std::set<std::string>{"plan.h5", "shards"});
  REQUIRE(here.shell("ricochet merge s.lua --quiet samples=1").status == 0);
  CHECK(files_in(here.path / "out/s") == files_in(here.path / "calm/s"));
  CHECK_THAT(here.shell("ricochet info out").out, Contains("digest of outcomes " + digest(here, "calm/s")));
}

TEST_CASE("a shard given as auto takes its number from the variables of the job that it runs in") {
  const Workplace here;
  const std::string expected = undisturbed(here, "samples=2");
  const char* jobs[][2] = {{"OMPI_COMM_WORLD_RANK=0 OMPI_COMM_WORLD_SIZE=2", "PMI_RANK=1 PMI_SIZE=2"},
                           {"SLURM_PROCID=0 SLURM_STEP_NUM_TASKS=2",
                            "SLURM_ARRAY_TASK_ID=8 SLURM_ARRAY_TASK_MIN=7 SLURM_ARRAY_TASK_COUNT=2 SLURM_PROCID=0 "
                            "SLURM_NTASKS=1 PMI_RANK=0 PMI_SIZE=1"}};
  const std::string clean =
      "unset OMPI_COMM_WORLD_RANK PMI_RANK SLURM_ARRAY_TASK_ID SLURM_PROCID SLURM_STEP_NUM_TASKS PBS_ARRAY_INDEX "
      "SGE_TASK_ID; ";
  for (const auto& [first, second] : jobs) {
    fs::remove_all(here.path / "out");
    for (const char* job : {first, second}) {
      const Ended shard = here.shell(clean + "export " + job + "; ricochet run s.lua --quiet samples=2 --shard auto");
      INFO(job << shard.err);
      CHECK(shard.status == 0);
    }
    REQUIRE(merge(here, "samples=2").status == 0);
    CHECK(digest(here, "out/s") == expected);
  }
  const auto shard = [&](const std::string& given) {
    return here.shell(clean + "ricochet run s.lua --shard " + given);
  };
  CHECK(shard("auto").status == 2);
  CHECK_THAT(shard("auto").err, Contains("SLURM_ARRAY_TASK_ID"));
  CHECK_THAT(shard("4/4").err, Contains("there is no shard 4 of 4"));
  CHECK_THAT(shard("first").err, Contains("K/N"));
  CHECK_THAT(shard("0/4 --force").err, Contains("--force"));
}

TEST_CASE("the shard that a job means: tasks of arrays, and processes within them, each another one") {
  const auto chosen = [](const std::string& given, const std::vector<std::pair<const char*, const char*>>& variables) {
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_ARRAY_TASK_ID", "SLURM_PROCID",
                             "SLURM_STEP_NUM_TASKS", "PBS_ARRAY_INDEX", "SGE_TASK_ID", "SLURM_ARRAY_TASK_MIN"})
      unsetenv(name);
    for (const auto& [name, value] : variables) setenv(name, value, 1);
    RunOptions options;
    choose_shard(options, given);
    for (const auto& [name, value] : variables) unsetenv(name);
    return fmt::format("{}/{}", options.shard, options.shards);
  };
  CHECK(chosen("auto/20", {{"SGE_TASK_ID", "1"}}) == "0/20");
  CHECK(chosen("auto/20", {{"SGE_TASK_ID", "20"}}) == "19/20");
  CHECK(chosen("auto/20", {{"PBS_ARRAY_INDEX", "19"}}) == "19/20");
  CHECK(chosen("auto/20", {{"SLURM_ARRAY_TASK_ID", "7"}, {"SLURM_ARRAY_TASK_MIN", "7"}}) == "7/20");
  const std::pair<const char*, const char*> task{"SLURM_ARRAY_TASK_ID", "2"}, tasks{"SLURM_ARRAY_TASK_COUNT", "5"};
  CHECK(chosen("auto", {task, tasks, {"PMI_RANK", "0"}, {"PMI_SIZE", "1"}}) == "2/5");
  // A script that runs one process in a task of four processors is one of five, its four under srun are of twenty.
  CHECK(chosen("auto", {task, tasks, {"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "4"}}) == "2/5");
  for (const char* process : {"0", "1", "2", "3"})
    CHECK(chosen("auto", {task, tasks, {"SLURM_PROCID", process}, {"SLURM_STEP_NUM_TASKS", "4"}}) ==
          fmt::format("{}/20", 8 + std::stoi(process)));
  CHECK(chosen("auto", {task, tasks, {"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "2"}}) == "5/10");
  CHECK_THROWS_WITH(chosen("auto", {{"PBS_ARRAY_INDEX", "3"}}), Contains("nothing tells of how many"));
}

TEST_CASE("what is stored so far of shards, or of a run at work, is looked into beside it, each scene once") {
  const Workplace here;
  undisturbed(here);
  REQUIRE(here.run("s.lua --quiet --shard 1/2").status == 0);
  const Ended rows = here.shell("ricochet status out --csv");
  INFO(rows.out << rows.err);
  CHECK(rows.status == 0);
  CHECK(rows.out.substr(0, rows.out.find(',')) == "over_psi1");
  CHECK(std::count(rows.out.begin(), rows.out.end(), '\n') == 7);
  const std::string head = rows.out.substr(0, rows.out.find('\n')), whole = here.read("calm/s/results.csv");
  CHECK(head == whole.substr(0, whole.find('\n')));
  CHECK_THAT(here.shell("ricochet info out").out, Contains("stored so far") && Contains("6 rows"));
  REQUIRE(here.run("s.lua --quiet --shard 0/2").status == 0);
  REQUIRE(merge(here).status == 0);
  CHECK(here.shell("ricochet status out --csv").out == here.read("out/s/results.csv"));
  CHECK_THAT(here.shell("ricochet status . --csv").err, Contains("holds no sweep"));
  // A run that is at work holds its folder.
  const pid_t child =
      start(here, {"run", "s.lua", "samples=400", "--quiet", "--force", "--threads", "1", "--flush", "0"});
  const auto counted = [&] {
    const Ended now = here.shell("ricochet status out/s --csv");
    CHECK(now.status == 0);
    return std::count(now.out.begin(), now.out.end(), '\n') - 1;
  };
  const auto stored = [&] { return fs::exists(here.path / "out/s/parts.new") ? counted() : 0; };
  for (int i = 0; i < 600 && stored() < 1; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto first = counted();
  CHECK_THAT(here.shell("ricochet info out").out, Contains("stored so far"));
  kill(child, SIGKILL);
  ended(child);
  CHECK(counted() >= first);
  CHECK(counted() >= 1);
}

TEST_CASE("a shard that was killed goes on from what it stored, to the digest of one run") {
  const Workplace here;
  const std::string expected = undisturbed(here, "samples=40");
  const fs::path shards = here.path / "out/s/shards";
  const pid_t child = start(here, {"run", "s.lua", "samples=40", "--quiet", "--shard", "0/2", "--flush", "0"});
  for (int i = 0; i < 6000 && rows_below(shards).size() < 16; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGKILL);
  REQUIRE(ended(child) == -SIGKILL);
  const std::map<std::string, double> stored = rows_below(shards);
  CHECK(stored.size() >= 16);
  CHECK(stored.size() < 60);
  REQUIRE(run_shards(here, 2, "samples=40").status == 0);
  const std::map<std::string, double> now = seconds_in(shards / "000.h5");
  CHECK(now.size() == 60);
  for (const auto& [scene, seconds] : stored) CHECK(now.at(scene) == seconds);  // not one ran twice
  REQUIRE(merge(here, "samples=40").status == 0);
  CHECK(digest(here, "out/s") == expected);
}

TEST_CASE("a shard that is told to stop stores what is done, exits with 130 and leaves no error for the others") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  const pid_t child = start(here, {"run", "s.lua", "samples=300", "--quiet", "--shard", "0/2", "--flush", "0.05"});
  const fs::path shards = here.path / "out/s/shards";
  for (int i = 0; i < 6000 && (!fs::exists(shards) || files_in(shards).empty()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGTERM);
  CHECK(ended(child) == 130);
  for (const std::string& name : files_in(shards)) CHECK(name.starts_with("000-"));
  const Ended merged = merge(here, "samples=300");
  CHECK(merged.status == 3);
  CHECK_THAT(merged.err, Contains("are missing, in 2 of 2 shards") && Contains("shard 1: nothing of 450 stored") &&
                             Contains("ricochet run s.lua samples=300 --shard 0/2 --out out") && Contains("--partial"));
  CHECK_FALSE(fs::exists(here.path / "out/s/results.h5"));
}

TEST_CASE("the same shard twice at a time: both end well, and what they leave is compared") {
  const Workplace here;
  const std::string expected = undisturbed(here, "samples=20");
  const std::vector<std::string> command{"run", "s.lua", "samples=20", "--quiet", "--shard", "0/1", "--flush", "0"};
  const pid_t first = start(here, command), second = start(here, command);
  CHECK(ended(first) == 0);
  CHECK(ended(second) == 0);
  CHECK(files_in(here.path / "out/s/shards") == std::set<std::string>{"000.h5"});
  const fs::path whole = here.path / "out/s/shards/000.h5", forged = here.path / "out/s/shards/000-elsewhere-1-0.h5";
  change_a_bit(whole, forged);
  const Ended refused = merge(here, "samples=20");
  CHECK(refused.status == 4);
  CHECK_THAT(refused.err, Contains("shards/000.h5, written on ") && Contains("shards/000-elsewhere-1-0.h5") &&
                              Contains("vn ") && Contains("remove the wrong file"));
  fs::remove(forged);
  REQUIRE(merge(here, "samples=20").status == 0);
  CHECK(digest(here, "out/s") == expected);
}

TEST_CASE("a shard of more points than are kept together goes by chunks: killed, twice there, stopped") {
  const Workplace here;
  const std::string expected = undisturbed(here, "samples=20");
  const fs::path shards = here.path / "out/s/shards";
  const std::vector<std::string> command{"run", "s.lua", "samples=20", "--quiet", "--at-once", "7", "--flush", "0"};
  const auto of = [&](const char* shard) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"--shard", shard});
    return words;
  };
  const pid_t child = start(here, of("0/2"));
  for (int i = 0; i < 6000 && rows_below(shards).size() < 2; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGKILL);
  REQUIRE(ended(child) == -SIGKILL);
  const std::map<std::string, double> stored = rows_below(shards);
  CHECK(stored.size() >= 2);
  CHECK(stored.size() < 30);
  const Ended again = here.run("s.lua samples=20 --at-once 7 --shard 0/2");
  INFO(again.err);
  REQUIRE(again.status == 0);
  CHECK_THAT(again.out, Contains("shard 0/2 of 's' is done: 30 of 30 impacts finished"));
  CHECK_THAT(again.err, Contains("s, shard 0/2: 30/30"));
  const std::map<std::string, double> now = seconds_in(shards / "000.h5");
  CHECK(now.size() == 30);
  for (const auto& [scene, seconds] : stored) CHECK(now.at(scene) == seconds);  // not one ran twice
  const pid_t first = start(here, of("1/2")), second = start(here, of("1/2"));
  CHECK(ended(first) == 0);
  CHECK(ended(second) == 0);
  std::set<std::string> left = files_in(shards);
  std::erase_if(left, [](const std::string& name) { return name.ends_with(".new"); });  // of what was killed
  CHECK(left == std::set<std::string>{"000.h5", "001.h5"});
  change_a_bit(shards / "001.h5", shards / "001-elsewhere-1-0.h5");
  const Ended refused = here.run("s.lua samples=20 --quiet --at-once 7 --shard 1/2");
  CHECK(refused.status == 4);
  CHECK_THAT(refused.err, Contains("vn ") && Contains("remove the wrong file"));
  fs::remove(shards / "001-elsewhere-1-0.h5");
  fs::remove(shards / "001.error");
  REQUIRE(merge(here, "samples=20").status == 0);
  CHECK(digest(here, "out/s") == expected);
  const pid_t stopping = start(here, {"run", "s.lua", "samples=300", "--quiet", "--at-once", "7", "--shard", "0/2"});
  for (int i = 0; i < 6000 && (!fs::exists(shards) || files_in(shards).empty()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(stopping, SIGTERM);
  CHECK(ended(stopping) == 130);
  for (const std::string& name : files_in(shards)) CHECK(name.starts_with("000-"));
}

TEST_CASE("where no folder can be locked, or any, shards and merge come to the same, and a plain run warns") {
  if (!machine_can_be_broken) return;
  const Workplace here;
  const std::string expected = undisturbed(here, "samples=2");
  for (const char* fault : {"enosys", "enolck", "eopnotsupp", "flock"}) {
    INFO(fault);
    const bool refuses = fault != std::string("flock");
    fs::remove_all(here.path / "out");
    CHECK(run_shards(here, 2, "samples=2", with_fault(fault)).status == 0);
    CHECK(here.shell(with_fault(fault) + "ricochet merge s.lua --quiet --no-report samples=2").status == 0);
    CHECK(digest(here, "out/s") == expected);
    const Ended plain = here.shell(with_fault(fault) + "ricochet run s.lua --quiet --no-report --force samples=2");
    CHECK(plain.status == 0);
    CHECK((plain.err.find("warning: out/s cannot be locked (") != std::string::npos) == refuses);
    CHECK(digest(here, "out/s") == expected);
  }
}

TEST_CASE("a shard whose file another process of it took up and removed at the last moment ends well") {
  if (!machine_can_be_broken) return;
  const Workplace here;
  const std::string expected = undisturbed(here, "samples=2");
  const Ended ended = here.shell(with_fault("twin", "shards/000.h5") + "ricochet run s.lua samples=2 --shard 0/1");
  INFO(ended.err);
  CHECK(ended.status == 0);
  REQUIRE(merge(here, "samples=2").status == 0);
  CHECK(digest(here, "out/s") == expected);
}

TEST_CASE("shards grow a sweep that is there, and are not begun where rows of other scenes lie") {
  for (const char* chunks : {"", "--at-once 4"}) {
    const Workplace here;
    const std::string expected = undisturbed(here);
    REQUIRE(here.run("s.lua --quiet --no-report samples=2").status == 0);
    REQUIRE(run_shards(here, 2, chunks).status == 0);
    REQUIRE(merge(here, chunks).status == 0);
    CHECK(digest(here, "out/s") == expected);
    std::string other = small_sweep;
    here.write("s.lua", other.replace(other.find("nodes = 60"), 10, "nodes = 61"));
    const Ended refused = here.run(std::string("s.lua --quiet --shard 0/2 ") + chunks);
    CHECK(refused.status == 4);
    CHECK_THAT(refused.err, Contains("out/s holds 12 rows of other scenes"));
    CHECK_FALSE(fs::exists(here.path / "out/s/plan.h5"));
  }
}

TEST_CASE("results are those of a script and its arguments, in whatever order these were given") {
  const Provenance facts{{"script_hash", "0a"}, {"arguments", "a=1 b=2"}};
  CHECK(is_of_results(facts, {{"script_hash", "0a"}, {"arguments", "b=2\na=1\n"}}));
  CHECK_FALSE(is_of_results(facts, {{"script_hash", "0b"}, {"arguments", "b=2\na=1\n"}}));
  CHECK_FALSE(is_of_results(facts, {{"script_hash", "0a"}, {"arguments", "b=2\n"}}));
  CHECK(is_of_results({{"script_hash", "0a"}, {"arguments", ""}}, {{"script_hash", "0a"}}));
}

TEST_CASE("names and folders of one process alone: below a folder by components, temporary for one user") {
  CHECK(is_within("/x/lua/ricochet/init.lua", "/x/lua"));
  CHECK(is_within("/x/lua", "/x/lua"));
  CHECK_FALSE(is_within("/x/lua2/mine.lua", "/x/lua"));
  fs::path path;
  {
    const ScratchFolder one, other;
    path = one.path();
    CHECK(path != other.path());
    CHECK(fs::status(path).permissions() == fs::perms::owner_all);
    write_atomically(path / "file", "text");
  }
  CHECK_FALSE(fs::exists(path));
}

TEST_CASE("another script, version, machine or number of shards is refused before any impact, and named") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua --quiet --shard 0/3").status == 0);
  const fs::path path = here.path / "out/s/plan.h5";
  const Table steps = read_table(path);
  const Provenance plan = read_provenance(path);
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const Ended ended = here.run("s.lua --quiet " + arguments);
    INFO(arguments << " " << why << ": " << ended.err);
    CHECK(ended.status == 4);
    CHECK_THAT(ended.err, Contains(why) && Contains("out/s/plan.h5"));
    CHECK(files_in(here.path / "out/s/shards").count("001.h5") == 0);
  };
  refused("--shard 1/4", "is of 3 shards, not of 4");
  refused("--shard 1/3 samples=5", "with other parameters");
  for (const auto& [fact, why] : std::map<std::string, std::string>{
           {"version", "another version"}, {"commit", "another commit"}, {"canary", "comes to other bits"}}) {
    Provenance other = plan;
    other[fact] = "changed";
    write_table(path, steps, other);
    refused("--shard 1/3", why);
  }
  write_table(path, steps, plan);
  here.write("s.lua", std::string(small_sweep) + "-- changed\n");
  refused("--shard 1/3", "another text of the script");
  const Ended merged = merge(here);
  CHECK(merged.status == 4);
  CHECK_THAT(merged.err, Contains("another text of the script"));
  here.write("s.lua", small_sweep);
  CHECK_THAT(here.read("out/s/shards/001.error"), Contains("another text of the script"));
  CHECK_THAT(merge(here).err, Contains("it ended with: ") && Contains("another text of the script"));
  CHECK(here.run("s.lua --quiet --shard 1/3").status == 0);
  CHECK_FALSE(fs::exists(here.path / "out/s/shards/001.error"));
}

TEST_CASE("merge tells a shard's own error, and --partial makes results of what is there") {
  const Workplace here;
  const std::string text = small_sweep;
  const std::string scene = "return ricochet.scene {";
  std::string failing = text;
  failing.replace(failing.find(scene), scene.size(), "if at.sample == 2 then error(\"no such disk\") end\n" + scene);
  here.write("s.lua", failing);
  CHECK(run_shards(here, 4).status == 1);
  const Ended merged = merge(here);
  CHECK(merged.status == 1);  // the script makes all scenes there, and says so itself
  CHECK_THAT(merged.err, Contains("no such disk"));
  fs::remove_all(here.path / "out");
  here.write("s.lua", text);
  for (const char* shard : {"0/4", "2/4"}) REQUIRE(here.run(std::string("s.lua --quiet --shard ") + shard).status == 0);
  const Ended partial = merge(here, "--partial");
  CHECK(partial.status == 0);
  CHECK_THAT(partial.err, Contains("6 of 12 impacts of 's' are missing"));
  CHECK(read_table(here.path / "out/s/results.h5").rows() == 6);
  CHECK_THAT(partial.out, Contains("averaged over sample"));
  REQUIRE(run_shards(here, 4).status == 0);
  CHECK(merge(here).status == 0);
  CHECK(digest(here, "out/s") == undisturbed(here));
}

TEST_CASE("steps that trials choose are those of one run, and a second sweep follows where the first is merged") {
  const Workplace here;
  std::string text = small_sweep;
  text.replace(text.find("launch = { psi1"), 0, "accuracy = 1e-2, ");
  text +=
      "local mean = rows:summary { by = \"psi1\", of = { \"e\" } }[1].e.mean\n"
      "ricochet.sweep { name = \"second\", over = { sample = ricochet.range(2) }, scene = function(at)\n"
      "  return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = at.sample },\n"
      "    target = ricochet.wall { width = 4, depth = 1.5, nodes = 150, stiffness = 400 * mean, seed = at.sample } }\n"
      "end }:run()\n";
  here.write("s.lua", text);
  REQUIRE(here.run("s.lua --quiet --no-report --out calm").status == 0);
  REQUIRE(run_shards(here, 3).status == 0);
  CHECK_FALSE(fs::exists(here.path / "out/second"));
  const Ended first = merge(here);
  CHECK(first.status == 3);
  CHECK_THAT(first.err, Contains("no shard of 'second' has run"));
  CHECK(digest(here, "out/s") == digest(here, "calm/s"));
  const Ended planned = here.run("s.lua --shard 0/2");
  CHECK(planned.status == 0);
  CHECK_THAT(planned.out, Contains("remembered: ") && !Contains("tries steps"));  // of the first one's scenes
  REQUIRE(run_shards(here, 2).status == 0);
  REQUIRE(merge(here).status == 0);
  CHECK(digest(here, "out/second") == digest(here, "calm/second"));
}

TEST_CASE("a shard of a second sweep reads the rows of a long first one from its merged results") {
  const Workplace here;
  std::string text = small_sweep;
  text +=
      "local mean = rows:summary { by = \"psi1\", of = { \"e\" } }[1].e.mean\n"
      "print(\"mean\", mean, rows[5].e, rows[12].scene_hash, #rows)\n"
      "ricochet.sweep { name = \"second\", over = { sample = ricochet.range(2) }, scene = function(at)\n"
      "  return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = at.sample },\n"
      "    target = ricochet.wall { width = 4, depth = 1.5, nodes = 150, stiffness = 400 * mean, seed = at.sample } }\n"
      "end }:run()\n";
  here.write("s.lua", text);
  const Ended calm = here.run("s.lua --no-report --out calm");
  REQUIRE(calm.status == 0);
  REQUIRE(run_shards(here, 2, "--at-once 5").status == 0);
  CHECK(merge(here, "--at-once 5").status == 3);
  const Ended second = here.run("s.lua --at-once 5 --shard 0/2");
  INFO(second.err);
  REQUIRE(second.status == 0);
  const std::size_t at = calm.out.find("mean\t");
  CHECK_THAT(second.out, Contains(calm.out.substr(at, calm.out.find('\n', at) - at)));
  REQUIRE(here.run("s.lua --quiet --at-once 5 --shard 1/2").status == 0);
  REQUIRE(merge(here, "--at-once 5").status == 0);
  CHECK(digest(here, "out/second") == digest(here, "calm/second"));
  // Results of the same script and arguments whose rows are of another sweep are not taken for its own.
  Table other = read_table(here.path / "out/s/results.h5");
  for (NumberColumn& column : other.numbers)
    if (column.field.name == "sample") column.values.front() = 7;
  write_table(here.path / "out/s/results.h5", other, read_provenance(here.path / "out/s/results.h5"));
  fs::remove_all(here.path / "out/second");
  const Ended refused = here.run("s.lua --at-once 5 --shard 0/2");
  CHECK(refused.status == 4);
  CHECK_THAT(refused.err, Contains("out/s/results.h5 is not of the scenes of the sweep"));
}

TEST_CASE(
    "what decides by rows, or a scene by more than its point, is refused in a shard, and plain runs leave shards") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  REQUIRE(here.run("s.lua --quiet --shard 0/3").status == 0);
  for (const char* option : {"", "--resume"}) {
    const Ended plain = here.run(std::string("s.lua --quiet ") + option);
    CHECK(plain.status == 4);
    CHECK_THAT(plain.err, Contains("out/s") && Contains("--force"));
  }
  CHECK(fs::exists(here.path / "out/s/shards/000.h5"));
  const std::string head =
      "local ricochet = require \"ricochet\"\nlocal count = 0\n"
      "local function scene(at) count = count + 1\n"
      "  return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = SEED }, target = "
      "ricochet.wall { nodes = 150 } } end\n";
  const auto script = [&](const std::string& seed, const std::string& rest) {
    std::string whole = head + rest;
    return here.script(whole.replace(whole.find("SEED"), 4, seed), "--shard 0/2 --out other");
  };
  CHECK_THAT(
      script("count", "ricochet.sweep { name = \"s\", over = { sample = ricochet.range(3) }, scene = scene }:run()")
          .err,
      Contains("s.lua:3") && Contains("two different scenes"));
  CHECK_THAT(script("at.sample",
                    "ricochet.plan { sweep = ricochet.sweep { name = \"s\", over = { sample = { 1, 2 } }, "
                    "scene = scene }, standard_error = 0.1 }:run()")
                 .err,
             Contains("ricochet.plan") && Contains("run it by itself"));
}

// A minute: ricochet_tests "40 kills*".
TEST_CASE("40 kills of shards and merges lose no row that was stored, and all come to the digest of one run",
          "[.slow]") {
  const Workplace here;
  const std::string expected = undisturbed(here, "samples=20");
  const fs::path shards = here.path / "out/s/shards";
  std::mt19937 random(7);
  int killed = 0, merges_killed = 0;
  for (int trial = 0; trial < 20; ++trial) {
    INFO("trial " << trial);
    fs::remove_all(here.path / "out");
    std::vector<pid_t> running;
    for (const char* shard : {"0/3", "1/3", "2/3"})
      running.push_back(
          start(here, {"run", "s.lua", "samples=20", "--quiet", "--threads", "1", "--shard", shard, "--flush", "0"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(50 + random() % 1200));
    kill(running[random() % 3], SIGKILL);
    for (const pid_t shard : running) {
      const int status = ended(shard);
      killed += status == -SIGKILL;
      CHECK((status == 0 || status == -SIGKILL));
    }
    std::map<std::string, double> stored;
    for (const std::string& name : files_in(shards))
      if (name.ends_with(".h5")) stored.merge(seconds_in(shards / name));
    REQUIRE(run_shards(here, 3, "samples=20").status == 0);
    std::map<std::string, double> now;
    for (const char* name : {"000.h5", "001.h5", "002.h5"}) now.merge(seconds_in(shards / name));
    for (const auto& [scene, seconds] : stored) CHECK(now.at(scene) == seconds);
    const pid_t merging = start(here, {"merge", "s.lua", "samples=20", "--quiet", "--no-report"});
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 250));
    kill(merging, SIGKILL);
    merges_killed += ended(merging) == -SIGKILL;
    const Ended merged = merge(here, "samples=20");
    INFO(merged.err);
    CHECK(merged.status == 0);
    CHECK(digest(here, "out/s") == expected);
  }
  CHECK(killed >= 10);
  CHECK(merges_killed >= 10);
}
