// Shards on a Slurm that each test brings up on this machine, of three nodes, and takes down: `ricochet_tests
// "[slurm]"`. A lost node takes Slurm half a minute to notice, so that all take some minutes: they are hidden from the
// usual run.

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstring>
#include <functional>
#include <set>
#include <thread>

#include "script/digest.hpp"
#include "script/program.hpp"
#include "store/files.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

bool is_free(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool free = bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(socket);
  return free;
}

/// The first of so many free ports.
int free_ports(int count) {
  for (int first = 20000 + getpid() % 1000 * 20;; first += count) {
    bool free = first + count < 60000;
    for (int port = first; free && port < first + count; ++port) free = is_free(port);
    if (free) return first;
    if (first > 60000) first = 20000;
  }
}

/// Three nodes, and a folder to work in from which jobs are submitted.
class Cluster {
 public:
  explicit Cluster(int longest_array = 1001) {
    for (const char* program : {"/usr/sbin/slurmctld", "/usr/sbin/slurmd", "/usr/sbin/munged"})
      if (!fs::exists(program)) {
        WARN("skipped: there is no " << program << "; apt-get install slurmctld slurmd slurm-client munge");
        return;
      }
    const Ended up =
        here.shell(fmt::format("'{}/tests/slurm/up' slurm 3 {} {}", RICOCHET_SOURCE, free_ports(4), longest_array));
    INFO(up.err);
    REQUIRE(up.status == 0);
    works_ = true;
  }
  ~Cluster() {
    if (works_) here.shell(std::string("'") + RICOCHET_SOURCE + "/tests/slurm/down' slurm");
  }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  explicit operator bool() const { return works_; }

  Ended shell(const std::string& command) const { return here.shell(". slurm/env; " + command); }
  Ended submit(const std::string& arguments) const {
    const Ended ended = shell("ricochet submit s.lua --quiet --slurm " + arguments);
    INFO(ended.err);
    REQUIRE(ended.status == 0);
    return ended;
  }

  /// Until nothing is in the queue.
  void wait(int seconds = 85) const {
    for (int i = 0; i < 4 * seconds; ++i) {
      const Ended queue = shell("squeue -h -o %i");
      if (queue.status == 0 && queue.out.empty()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
    FAIL("still in the queue: " << shell("squeue; sinfo -N").out << logs());
  }
  /// Until that many files of rows are stored.
  void wait_for_rows(std::size_t files) const {
    for (int i = 0; i < 1200 && rows_files() < files; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(25));
    REQUIRE(rows_files() >= files);
  }
  std::string logs() const { return here.shell("tail -n 100 out/s/slurm/*.log 2>/dev/null").out; }
  std::string log(const std::string& name) const { return here.read("out/s/slurm/" + name + ".log"); }
  std::string digest(const std::string& folder = "out/s") const {
    return digest_of(read_table(here.path / folder / "results.h5"));
  }

  /// Of the program or of jobs: those whose environment holds all of these, on this cluster.
  std::vector<pid_t> processes(const std::string& variable, const std::string& command) const {
    std::vector<pid_t> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/proc", error)) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      const auto read = [&](const char* what) {
        std::ifstream file(entry.path() / what, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {}) + '\0';
      };
      const std::string environment = read("environ");
      if (environment.find((here.path / "slurm").string()) != std::string::npos &&
          environment.find(variable + '\0') != std::string::npos && read("cmdline").find(command) != std::string::npos)
        found.push_back(std::stoi(name));
    }
    return found;
  }
  pid_t daemon(const std::string& node) const { return std::stoi(here.read("slurm/spool/" + node + ".pid")); }

  Workplace here;

 private:
  std::size_t rows_files() const {
    std::error_code error;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(here.path / "out/s/shards", error))
      count += entry.path().extension() == ".h5";
    return count;
  }

  bool works_ = false;
};

/// 48 impacts of tenths of a second each.
std::string slow_sweep() {
  std::string text = small_sweep;
  text.replace(text.find("nodes = 60"), 10, "nodes = 250");
  text.replace(text.find("width = 4, depth = 1.5, nodes = 150"), 35, "nodes = 1000");
  return text;
}

/// As many impacts of three points as the mean of e needs, of some tenths of a second each.
std::string by_error_sweep() {
  std::string text = slow_sweep();
  text.replace(text.find("sample = ricochet.range(p.samples), "), 36, "");
  text.replace(text.find("scene = function"), 0, "samples = \"by_error\", standard_error = 0.04, ");
  return text;
}

/// The digest of one run of the script.
std::string undisturbed(const Cluster& cluster, const std::string& script, const std::string& arguments) {
  cluster.here.write("s.lua", script);
  REQUIRE(cluster.here.run("s.lua --quiet --no-report --out calm " + arguments).status == 0);
  return cluster.digest("calm/s");
}

}  // namespace

TEST_CASE("an array of shards, srun and mpirun come to the digest of one run", "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, small_sweep, "samples=8");
  CHECK_THAT(cluster.submit("--shards 4 samples=8").out, Contains("4 shards of 's' in 4 tasks: job 1"));
  cluster.wait();
  INFO(cluster.logs());
  CHECK(cluster.digest() == expected);
  CHECK(fs::exists(cluster.here.path / "out/s/report.html"));
  CHECK_THAT(cluster.submit("--shards 4 samples=8").out, Contains("nothing is left to submit"));
  const auto by_hand = [&](const std::string& launcher) {
    fs::remove_all(cluster.here.path / "out");
    const Ended ran = cluster.shell(launcher + " '" + RICOCHET_PROGRAM + "' run s.lua samples=8 --quiet --shard auto");
    INFO(launcher << ran.err);
    CHECK(ran.status == 0);
    CHECK(cluster.shell("ricochet merge s.lua samples=8 --quiet --no-report").status == 0);
    CHECK(cluster.digest() == expected);
  };
  by_hand("srun -n 3");
  if (cluster.shell("command -v mpirun").status == 0)
    by_hand("env -u SLURM_CONF OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 3");
  else
    WARN("skipped: mpirun is not there");
}

TEST_CASE("a sweep by error: the pilot as an array, then a round after the other, to the digest of one run",
          "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, by_error_sweep(), "");
  const auto planned = [&] { return std::stoul(read_provenance(cluster.here.path / "out/s/plan.h5").at("impacts")); };
  CHECK_THAT(cluster.submit("--shards 3").out, Contains("3 shards of 's' in 3 tasks: job 1"));
  cluster.shell("scancel 2");  // the pilot's merging: it is done by hand, and what it says looked into
  const std::size_t pilot = planned();
  CHECK(pilot == 3 * 8);
  cluster.wait();
  INFO(cluster.logs());
  const Ended merged = cluster.shell("ricochet merge s.lua --quiet --no-report");
  INFO(merged.out << merged.err);
  CHECK(merged.status == 3);
  CHECK_THAT(merged.out, Contains("s: 24 impacts in 1 rounds so far") && Contains("(wanted 0.04) of 8 impacts"));
  CHECK_THAT(merged.err, Contains("round 2 of 's' is to be run") && Contains("ricochet submit does so"));
  CHECK_THAT(cluster.submit("--shards 3").out, Contains("3 shards of 's' in 3 tasks"));
  CHECK(planned() > pilot);
  // A shard of the round is killed: the merging job submits it again, and then the round that follows.
  std::vector<pid_t> shard;
  for (int i = 0; i < 400 && shard.empty(); ++i) {
    shard = cluster.processes("SLURM_ARRAY_TASK_ID=1", "--shard");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  REQUIRE(!shard.empty());
  kill(shard.front(), SIGKILL);
  cluster.wait();
  CHECK_THAT(cluster.logs(), Contains("shard 1 ended with 137"));
  const std::string log = cluster.log("merge");
  CHECK_THAT(log, Contains("are missing, in 1 of 3 shards") && Contains("1 shards of 's' in 1 tasks"));
  CHECK_THAT(log, Contains("round 3 of 's' is to be run") && Contains("rounds\n") && Contains("averaged over sample"));
  CHECK(cluster.digest() == expected);
  CHECK_FALSE(fs::exists(cluster.here.path / "out/s/plan.h5"));
  CHECK(cluster.here.read("out/s/s_samples.csv") == cluster.here.read("calm/s/s_samples.csv"));
  CHECK_THAT(cluster.submit("--shards 3").out, Contains("nothing is left to submit"));
}

TEST_CASE("a shard killed in the middle is submitted again by the merging job, and goes on", "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, slow_sweep(), "samples=12");
  cluster.submit("--shards 2 samples=12");
  cluster.wait_for_rows(1);
  std::vector<pid_t> shard;
  for (int i = 0; i < 200 && shard.empty(); ++i) shard = cluster.processes("SLURM_ARRAY_TASK_ID=1", "--shard");
  REQUIRE(shard.size() == 1);
  kill(shard.front(), SIGKILL);
  cluster.wait();
  INFO(cluster.logs());
  CHECK_THAT(cluster.log("task-1"), Contains("shard 1 ended with 137"));
  CHECK_THAT(cluster.log("merge"), Contains("are missing, in 1 of 2 shards") && Contains("1 shards of 's' in 1 tasks"));
  CHECK(cluster.digest() == expected);
}

TEST_CASE("the same shard twice, in a job and by hand: both end well", "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, slow_sweep(), "samples=8");
  cluster.submit("--shards 2 samples=8");
  const Ended twin = cluster.shell("ricochet run s.lua samples=8 --quiet --shard 1/2");
  INFO(twin.err);
  CHECK(twin.status == 0);
  cluster.wait();
  INFO(cluster.logs());
  CHECK(cluster.digest() == expected);
}

TEST_CASE("a node that is lost with its job: Slurm starts the shard elsewhere, and all are merged", "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, slow_sweep(), "samples=40");
  cluster.submit("--shards 3 samples=40");
  std::vector<pid_t> job;
  for (int i = 0; i < 200 && cluster.processes("SLURMD_NODENAME=n1", "--shard").empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  job = cluster.processes("SLURMD_NODENAME=n1", "");
  REQUIRE(!job.empty());
  std::set<pid_t> all(job.begin(), job.end());
  all.insert(cluster.daemon("n1"));
  for (const pid_t process : job) {  // the step's own process is the parent of what it runs
    std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
    std::string words((std::istreambuf_iterator<char>(stat)), {});
    pid_t parent = 0;
    if (std::sscanf(words.c_str() + words.rfind(')') + 1, " %*c %d", &parent) == 1 && parent > 1) all.insert(parent);
  }
  for (const pid_t process : all) kill(process, SIGKILL);
  cluster.wait();
  INFO(cluster.logs());
  CHECK(cluster.digest() == expected);
  CHECK_THAT(cluster.logs(), Contains("restart 1"));
}

TEST_CASE("a node that is out of sight while its job lives on: two copies of a shard end well", "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, slow_sweep(), "samples=24");
  cluster.submit("--shards 3 samples=24");
  const auto patiently = [](int times, const auto& is_there) {
    for (int i = 0; i < times && !is_there(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return is_there();
  };
  const auto at_work = [&] { return cluster.processes("SLURMD_NODENAME=n1", "--shard"); };
  REQUIRE(patiently(200, [&] { return !at_work().empty(); }));
  kill(cluster.daemon("n1"), SIGKILL);
  // However fast the machine is, the first copy is still there when the second one comes.
  const std::vector<pid_t> first = at_work();
  for (const pid_t process : first) kill(process, SIGSTOP);
  const bool again = patiently(2400, [&] { return cluster.logs().find("restart 1") != std::string::npos; });
  for (const pid_t process : first) kill(process, SIGCONT);
  cluster.wait();
  INFO(cluster.logs());
  CHECK(again);
  CHECK_THAT(cluster.logs(), !Contains("ended with"));
  CHECK(cluster.digest() == expected);
}

namespace {

// Later and later: kills the n-th daemon, and starts it again.
void kill_five_times(const Cluster& cluster, const std::function<pid_t(int)>& daemon,
                     const std::function<std::string(int)>& start) {
  for (int n = 0; n < 5; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(700 + 300 * n));
    kill(daemon(n), SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    REQUIRE(cluster.shell(start(n)).status == 0);
  }
}

}  // namespace

TEST_CASE("the queue itself is killed and comes back: the shards do not notice, and are merged", "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, slow_sweep(), "samples=24");
  cluster.submit("--shards 6 samples=24");
  kill_five_times(
      cluster, [&](int) { return std::stoi(cluster.here.read("slurm/state/pid")); },
      [](int) { return "/usr/sbin/slurmctld"; });
  cluster.wait();
  INFO(cluster.logs());
  // A job of its last seconds may be forgotten with it: the same command submits what is missing, be it the merging.
  if (!fs::exists(cluster.here.path / "out/s/results.h5")) {
    cluster.submit("--shards 6 samples=24");
    cluster.wait();
  }
  CHECK(cluster.digest() == expected);
}

TEST_CASE("five times a node's daemon is killed and comes back: no shard is lost", "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, slow_sweep(), "samples=24");
  cluster.submit("--shards 6 samples=24");
  const auto node = [](int n) { return "n" + std::to_string(n % 3 + 1); };
  kill_five_times(
      cluster, [&](int n) { return cluster.daemon(node(n)); }, [&](int n) { return "/usr/sbin/slurmd -N " + node(n); });
  cluster.wait();
  INFO(cluster.logs());
  CHECK(cluster.digest() == expected);
}

TEST_CASE("a task whose time ends stores, is queued again and goes on; a cancelled one stays so", "[.slurm]") {
  const Cluster cluster;
  if (!cluster) return;
  cluster.here.write("s.lua", slow_sweep());
  cluster.submit("--shards 3 samples=400");
  cluster.wait_for_rows(0);
  for (int i = 0; i < 200 && cluster.processes("SLURM_ARRAY_TASK_ID=2", "--shard").empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::seconds(2));
  CHECK(cluster.shell("ricochet submit s.lua --quiet --slurm --shards 3 samples=400").status == 1);  // at work
  cluster.shell("scancel 1 2");
  cluster.wait();
  CHECK_THAT(cluster.logs(), !Contains("queued again"));
  CHECK_THAT(cluster.shell("ricochet status out").out, Contains("none of them is in the queue"));
  fs::remove_all(cluster.here.path / "out");
  const std::string expected = undisturbed(cluster, slow_sweep(), "samples=300");
  cluster.submit("--shards 3 samples=300 --time 1 --warning 30");
  cluster.wait(150);
  INFO(cluster.logs());
  for (const char* task : {"task-0", "task-1", "task-2"})
    CHECK_THAT(cluster.log(task), Contains("queued again") && Contains("restart 1"));
  CHECK_THAT(cluster.log("merge"), !Contains("are missing"));  // each task queued itself, the array's last one, too
  CHECK(cluster.digest() == expected);
}

TEST_CASE("more shards than an array may have tasks; a script's error is told and not tried again", "[.slurm]") {
  const Cluster cluster(11);
  if (!cluster) return;
  const std::string expected = undisturbed(cluster, small_sweep, "samples=40");
  CHECK_THAT(cluster.submit("--shards 100 samples=40").out, Contains("100 shards of 's' in 10 tasks"));
  cluster.wait();
  INFO(cluster.logs());
  CHECK(cluster.digest() == expected);
  std::string failing = small_sweep;
  const std::string scene = "return ricochet.scene {";
  failing.replace(failing.find(scene), scene.size(), "if at.sample == 3 then error(\"no such disk\") end\n" + scene);
  cluster.here.write("s.lua", failing);
  fs::remove_all(cluster.here.path / "out");
  cluster.submit("--shards 4");
  cluster.wait();
  CHECK_THAT(cluster.log("merge"), Contains("no such disk") && !Contains("in 1 tasks"));
  CHECK_THAT(cluster.logs(), Contains("ended with 1") && !Contains("queued again"));
  CHECK_THAT(cluster.shell("ricochet status out").out, Contains("1 ended with an error") && Contains("no such disk"));
}
