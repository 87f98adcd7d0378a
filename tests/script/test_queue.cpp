// What submit and status make of what a queue says, and the scripts they leave: with stand-ins for Slurm's programs,
// the first of which runs at once what is submitted. A true Slurm: test_slurm.cpp.

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "script/digest.hpp"
#include "script/program.hpp"
#include "store/files.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

/// A folder whose `bin` holds the stand-ins. `lose`: the tasks of an array are lost while a file of that name is there.
class Queue {
 public:
  Queue() {
    program("sbatch", R"(echo "sbatch: a word of the site" >&2
script="${@: -1}"
[ ! -e nonsense ] || { echo "Submitted batch job"; exit 0; }
echo "$script" >>submitted
number=$(wc -l <submitted)
last=$(sed -n 's/^#SBATCH --array=0-\([0-9]*\).*/\1/p' "$script")
for ((i = 0; i <= ${last:-0}; ++i)); do
  [ -n "$last" ] && [ -e lose ] && continue
  SLURM_JOB_ID=$number SLURM_ARRAY_JOB_ID=$number SLURM_ARRAY_TASK_ID=$i bash "$script" >>log 2>&1
done
echo "$number;here")");
    program("squeue", "cat queue\ncat trouble >&2\nexit $(cat status)");
    program("scontrol", "echo \"$@\" >>asked");
    says("", "", 0);
    here.write("s.lua", small_sweep);
  }

  /// What squeue says from now on.
  void says(const std::string& queue, const std::string& trouble, int status) const {
    here.write("queue", queue);
    here.write("trouble", trouble);
    here.write("status", std::to_string(status));
  }
  Ended shell(const std::string& command) const { return here.shell("PATH=$PWD/bin:$PATH; " + command); }
  Ended submit(const std::string& arguments = "--shards 3") const {
    return shell("ricochet submit s.lua --slurm --quiet " + arguments);
  }

  Workplace here;

 private:
  void program(const std::string& name, const std::string& text) const {
    here.write("bin/" + name, "#!/bin/bash\n" + text + "\n");
    fs::permissions(here.path / "bin" / name, fs::perms::owner_all);
  }
};

}  // namespace

TEST_CASE("one submit brings a script of four sweeps to its end: a later sweep is no loss of an earlier one") {
  const Queue queue;
  std::string text = "local ricochet = require \"ricochet\"\n";
  for (const char* name : {"a", "b", "c", "d"})
    text += fmt::format(
        "ricochet.sweep {{ name = \"{}\", over = {{ sample = {{ 1, 2 }} }}, scene = function(at)\n"
        "  return ricochet.scene {{ projectile = ricochet.disk {{ nodes = 60, seed = at.sample }}, target = "
        "ricochet.wall {{ nodes = 150, stiffness = 400 }} }} end }}:run()\n",
        name);
  queue.here.write("s.lua", text);
  const Ended ended = queue.submit("--shards 2");
  INFO(ended.err << queue.here.read("log"));
  REQUIRE(ended.status == 0);
  CHECK_THAT(ended.out, Contains("job 1\n"));  // without the site's word and the name of the cluster
  CHECK(queue.here.read("out/a/slurm/jobs").substr(0, 2) == "1,");
  for (const char* name : {"a", "b", "c", "d"})
    CHECK(read_table(queue.here.path / "out" / name / "results.h5").rows() == 2);
}

TEST_CASE("one submit brings a sweep by error to its end, a round as an array each") {
  const Queue queue;
  std::string text = small_sweep;
  text.replace(text.find("sample = ricochet.range(p.samples), "), 36, "");
  text.replace(text.find("scene = function"), 0, "samples = \"by_error\", standard_error = 0.1, ");
  queue.here.write("s.lua", text);
  const Ended ended = queue.submit("--shards 2");
  INFO(ended.err << queue.here.read("log"));
  REQUIRE(ended.status == 0);
  CHECK_THAT(queue.here.read("log"), Contains("round 2 of 's' is to be run") && Contains("averaged over sample"));
  REQUIRE(queue.here.run("s.lua --quiet --no-report --out calm").status == 0);
  CHECK(digest_of(read_table(queue.here.path / "out/s/results.h5")) ==
        digest_of(read_table(queue.here.path / "calm/s/results.h5")));
}

TEST_CASE("shards that are lost again and again are submitted twice more, and then told") {
  const Queue queue;
  queue.here.write("lose", "");
  REQUIRE(queue.submit().status == 0);
  INFO(queue.here.read("log"));
  CHECK_THAT(queue.here.read("log"),
             Contains("3 shards of 's' are still not there after they were submitted again 2 times"));
  const std::string submitted = queue.here.read("submitted");
  CHECK(std::count(submitted.begin(), submitted.end(), '\n') == 6);
  fs::remove(queue.here.path / "lose");
  REQUIRE(queue.submit().status == 0);
  CHECK(read_table(queue.here.path / "out/s/results.h5").rows() == 12);
}

TEST_CASE("a queue that does not answer is not taken for an empty one, nor any word for a job's number") {
  const Queue queue;
  queue.here.write("lose", "");
  REQUIRE(queue.submit().status == 0);
  const std::string jobs = "jobs " + queue.here.read("out/s/slurm/jobs").substr(0, 3);
  queue.says("", "slurm_load_jobs error: Unable to contact slurm controller", 1);
  const Ended refused = queue.submit();
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err, Contains("whether jobs ") && Contains("is not known: slurm_load_jobs error: Unable"));
  CHECK_THAT(queue.shell("ricochet status out").out, Contains("the queue does not tell: slurm_load_jobs error"));
  CHECK(queue.submit("--shards 3 --dry-run").status == 0);
  queue.says("RUNNING\nPENDING\nPENDING\n", "", 0);
  CHECK_THAT(queue.submit().err, Contains("are at work on these shards (2 pending, 1 running)"));
  CHECK_THAT(queue.shell("ricochet status out").out, Contains(": 2 pending, 1 running\n"));
  queue.says("", "slurm_load_jobs error: Invalid job id specified", 1);  // of jobs that ended long ago
  CHECK_THAT(queue.shell("ricochet status out").out, Contains("none of them is in the queue (any more)"));
  queue.here.write("nonsense", "");
  CHECK_THAT(queue.submit().err, Contains("said 'Submitted batch job' where it should say the job's number"));
}

TEST_CASE("a dry run names the scripts that it wrote; a script of standard input is no job's") {
  const Queue queue;
  const Ended first = queue.submit("--shards 3 --dry-run");
  CHECK_THAT(first.out, Contains("3 shards of 's' in 3 tasks") && Contains("slurm/shard.sh"));
  for (const char* script : {"shard", "merge"}) {
    const std::string text = queue.here.read(std::string("out/s/slurm/") + script + ".sh");
    CHECK_THAT(text, Contains("--threads \"${SLURM_CPUS_PER_TASK:-1}\""));
  }
  for (const char* shard : {"0/3", "1/3", "2/3"})
    REQUIRE(queue.here.run(std::string("s.lua --quiet --shard ") + shard).status == 0);
  fs::remove(queue.here.path / "out/s/slurm/shard.sh");
  const Ended merging = queue.submit("--shards 3 --dry-run");
  CHECK(merging.status == 0);
  CHECK_THAT(merging.out, Contains("all shards of 's' are there") && Contains("merge.sh") && !Contains("shard.sh"));
  const Ended piped = queue.shell("ricochet submit - --slurm");
  CHECK(piped.status == 2);
  CHECK_THAT(piped.err, Contains("standard input"));
}

TEST_CASE("a task that is told to stop at the very moment it starts a shard tells the shard, and is queued again") {
  const Queue queue;
  REQUIRE(queue.submit("--shards 3 --dry-run samples=400").status == 0);
  // The last task of an array has the number of the whole array, of which squeue would tell every task.
  queue.here.write(
      "bin/squeue",
      "#!/bin/bash\n[[ \" $* \" == *' 7_0 '* ]] && echo RUNNING || printf 'RUNNING\\nRUNNING\\nPENDING\\n'\n");
  queue.here.write("before.sh",
                   "export SLURM_JOB_ID=7 SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=0\n"
                   "debug() { [ \"$BASH_COMMAND\" != 'process=$!' ] || kill -TERM $$; }\n"
                   "trap debug DEBUG\n");
  const Ended ended = queue.shell("cat before.sh out/s/slurm/shard.sh >task.sh; bash task.sh");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 130);
  CHECK_THAT(ended.out, Contains("queued again"));
  CHECK_THAT(queue.here.read("asked"), Contains("requeue 7_0\n"));
  CHECK_FALSE(fs::exists(queue.here.path / "out/s/shards/000.h5"));
}
