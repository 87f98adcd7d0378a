#include "script/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "script/shard_merge.hpp"
#include "script/shard_plan.hpp"
#include "script/shell.hpp"
#include "script/terminal.hpp"
#include "script/version.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// A task whose time is over that often is not worth another try; lost shards are submitted again so often.
constexpr int most_restarts = 100, most_rounds = 2;

// Of a site that does not tell.
constexpr std::size_t usual_array = 1001;

constexpr const char* shard_script = "shard.sh";
constexpr const char* merge_script = "merge.sh";
constexpr const char* jobs = "jobs";

/// What both scripts are made from.
struct Scripts {
  Session& session;
  const QueueOptions& wanted;
  const ShardPlan& plan;
  int round;                        ///< how often its lost shards were submitted again
  std::vector<std::size_t> shards;  ///< those that are not there
  std::size_t tasks;

  fs::path folder() const { return fs::absolute(run_names::queue(session.sharded)); }
};

std::string program() { return fs::read_symlink("/proc/self/exe").string(); }

// The program with a command for this script.
std::string call(const Scripts& s, const std::string& command, const std::string& options) {
  return command_of(s.session, command, options, program());
}

// Of shards, merging and planning alike.
constexpr const char* own_threads = "--quiet --threads \"${SLURM_CPUS_PER_TASK:-1}\"";

// The lines for Slurm.
std::string header(const Scripts& s, const std::string& name, const std::string& log,
                   const std::vector<std::string>& own) {
  std::vector<std::string> options{"--job-name=" + name, "--ntasks=1", "--open-mode=append",
                                   "--chdir=" + fs::current_path().string(), "--output=" + (s.folder() / log).string()};
  options.insert(options.end(), own.begin(), own.end());
  if (!s.wanted.partition.empty()) options.push_back("--partition=" + s.wanted.partition);
  std::string text = "#!/bin/bash\n";
  for (const std::string& option : options) text += fmt::format("#SBATCH {}\n", shell_words(option));
  for (const std::string& option : s.wanted.sbatch) text += fmt::format("#SBATCH {}\n", option);
  return text;
}

// What a task does: its numbers, shards and calls are put before.
constexpr const char* task_text = R"sh(
echo "$(date +%FT%T) task $SLURM_ARRAY_TASK_ID on $(hostname), restart ${SLURM_RESTART_COUNT:-0}"
stopped= process= told=
# A shard is told to stop once, whenever the signal came: told twice, it ends at once.
tell() { [ -z "$stopped" ] || [ -z "$process" ] || [ -n "$told" ] || { told=1; kill -TERM "$process"; }; }
trap 'stopped=1; tell' TERM

# The end of its time is near, or the node is wanted: what is done is stored. Cancelled jobs stay so. SLURM_JOB_ID of an
# array's last task means the whole array.
again() {
  task=${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID
  for try in 1 2 3 4 5; do
    state=$(squeue -h -j "$task" -o %T) && break
    sleep 2
  done
  if [ "$state" = RUNNING ] && [ "${SLURM_RESTART_COUNT:-0}" -lt $most_restarts ]; then
    echo "queued again"
    scontrol requeue "$task"
  fi
  exit 130
}

failed=0
for ((i = SLURM_ARRAY_TASK_ID; i < ${#shards[@]}; i += tasks)); do
  [ -z "$stopped" ] || again
  run_shard "${shards[i]}" &
  process=$!
  tell
  # A signal ends the waiting, not the process.
  while wait "$process"; status=$?; kill -0 "$process" 2>/dev/null; do :; done
  [ "$status" != 143 ] || { wait "$process"; status=$?; }
  process=
  case $status in
    0) ;;
    130 | 143) again ;;
    *) echo "shard ${shards[i]} ended with $status"; failed=$status ;;
  esac
done
exit "$failed"
)sh";

std::string shard_text(const Scripts& s) {
  std::vector<std::string> own{
      fmt::format("--array=0-{}{}", s.tasks - 1, s.wanted.running > 0 ? fmt::format("%{}", s.wanted.running) : ""),
      fmt::format("--cpus-per-task={}", s.wanted.cpus), "--requeue",
      fmt::format("--signal=B:TERM@{}", s.wanted.warning)};
  if (!s.wanted.time.empty()) own.push_back("--time=" + s.wanted.time);
  return header(s, s.session.sharded.filename().string(), "task-%a.log", own) +
         "# Shards of a sweep, some in each task one after another. Made by ricochet submit, which makes it anew.\n" +
         fmt::format("shards=({})\ntasks={} most_restarts={}\n", fmt::join(s.shards, " "), s.tasks, most_restarts) +
         fmt::format("run_shard() {{\n  exec {}\n}}\n",
                     call(s, "run", fmt::format("{} --shard \"$1/{}\"", own_threads, s.plan.shards))) +
         task_text;
}

// What a merging job submits again is of the same sweep, and of the same round of it; else it is no loss.
std::string work_of(const Session& session, const ShardPlan& plan) {
  return session.sharded.filename().string() + ":" + plan.facts.at("over");
}

std::string merge_text(const Scripts& s) {
  const std::string name = s.session.sharded.filename().string();
  std::vector<std::string> own{"--cpus-per-task=1"};
  std::string again =
      fmt::format("{} --slurm --round {} --of {} --cpus {} --max-running {} --warning {}", own_threads, s.round + 1,
                  shell_words(work_of(s.session, s.plan)), s.wanted.cpus, s.wanted.running, s.wanted.warning);
  if (s.session.options.shards > 0) again += fmt::format(" --shards {}", s.session.options.shards);
  if (!s.wanted.time.empty()) again += " --time " + shell_words(s.wanted.time);
  if (!s.wanted.partition.empty()) again += " --partition " + shell_words(s.wanted.partition);
  for (const std::string& option : s.wanted.sbatch) again += " " + shell_words("--sbatch=" + option);
  std::string text = header(s, name + "-merge", "merge.log", own);
  text += "# Results of all shards. Made by ricochet submit, which makes it anew.\n";
  text += fmt::format("{}\nstatus=$?\n", call(s, "merge", own_threads));
  text += fmt::format(
      "# Impacts are missing: lost with their nodes, or of a later round or sweep.\n[ $status != 3 ] || {}\n",
      call(s, "submit", again));
  return text + "exit $status\n";
}

std::vector<std::size_t> missing_shards(const Session& session, const ShardPlan& plan) {
  std::vector<std::size_t> missing;
  std::error_code error;
  for (std::size_t k = 0; k < plan.shards; ++k)
    if (!fs::exists(run_names::shard(session.sharded, k), error)) missing.push_back(k);
  return missing;
}

// The tasks that an array may have here.
std::size_t most_tasks() {
  std::istringstream lines(ask({"scontrol", "show", "config"}).text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("MaxArraySize"))
      return std::max(2ul, std::stoul(line.substr(line.find_first_of("0123456789")))) - 1;
  return usual_array - 1;
}

// Before a submission: shards that ended with an error stay so, unless a user asks anew.
void refuse_errors(const Scripts& s) {
  std::error_code error;
  for (const std::size_t k : s.shards) {
    const fs::path file = run_names::shard_error(s.session.sharded, k);
    if (!fs::exists(file, error)) continue;
    if (s.round > 0)
      throw Error(fmt::format("shard {} ended with: {}\n  it is not submitted again: what went wrong would go wrong "
                              "again; mend it, and call ricochet submit",
                              k, read_file(file)),
                  Exit::numerical);
    if (!s.wanted.dry_run) remove_file(file);
  }
}

std::string submit(const std::vector<std::string>& words) {
  const Answer answer = ask(words);
  if (answer.status == 127)
    throw Error(
        "there is no sbatch here; call ricochet submit where jobs are submitted, or with --dry-run, which only "
        "writes the scripts");
  if (answer.status != 0) throw Error(fmt::format("sbatch refused {}: {}", words.back(), answer.complaint));
  const std::string number = answer.text.substr(0, answer.text.find(';'));
  if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos)
    throw Error(fmt::format("sbatch took {}, but said '{}' where it should say the job's number; look for it by squeue",
                            words.back(), answer.text));
  return number;
}

// Those of shards that are not there, and the one that merges them.
void submit_scripts(const Scripts& s) {
  const fs::path folder = s.folder();
  const std::string name = s.session.sharded.filename().string();
  std::string array, after;
  if (!s.shards.empty()) {
    array = submit({"sbatch", "--parsable", (folder / shard_script).string()});
    write_atomically(folder / jobs, array + "\n");
    after = "--dependency=afterany:" + array;
    putf("{} shards of '{}' in {} tasks: job {}\n", s.shards.size(), name, s.tasks, array);
  }
  const std::string script = (folder / merge_script).string();
  const std::string merge =
      after.empty() ? submit({"sbatch", "--parsable", script}) : submit({"sbatch", "--parsable", after, script});
  write_atomically(folder / jobs, fmt::format("{}{}{}\n", array, array.empty() ? "" : ",", merge));
  putf(
      "job {} merges the shards of '{}'\n  look: ricochet status {}; stop: scancel {} {}; go on: the same command "
      "again\n"
      "  what they say: {}\n",
      merge, name, shell_words(s.session.options.out), array, merge, (folder / "*.log").string());
}

void warn_of_build(Session& session) {
  if (!std::string_view(version_target).starts_with("portable"))
    session.warn(
        "this build is for this machine's processor: on a node of another kind a task ends with 132; build the "
        "portable one (./workbench build portable), which gives the same bits");
}

}  // namespace

std::string submitted_jobs(const fs::path& folder) {
  const fs::path file = run_names::queue(folder) / jobs;
  std::error_code error;
  if (!fs::exists(file, error)) return "";
  std::string list = read_file(file);
  return list.substr(0, list.find('\n'));
}

QueueStates states_of(const std::string& list) {
  QueueStates states;
  if (list.empty()) return states;
  const Answer answer = ask({"squeue", "-h", "-r", "-j", list, "-o", "%T"});
  // Of a job that ended long ago it says so and fails.
  const bool forgotten = answer.complaint.find("Invalid job id") != std::string::npos;
  if (answer.status == 127)
    states.trouble = "there is no squeue here";
  else if (answer.status != 0 && !forgotten)
    states.trouble = answer.complaint.empty() ? fmt::format("squeue ended with {}", answer.status) : answer.complaint;
  std::istringstream words(answer.text);
  for (std::string word; states.trouble.empty() && words >> word;) {
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
    ++states.tasks[word];
  }
  return states;
}

std::string QueueStates::text() const {
  std::string text;
  for (const auto& [state, count] : tasks) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state);
  return text;
}

namespace {

// Twice the same shards at a time would be no mistake, but twice the work.
void refuse_others_at_work(const Session& session, const QueueOptions& wanted) {
  if (!wanted.of.empty()) return;  // the merging job that asks is at work itself
  const std::string list = submitted_jobs(session.sharded);
  const QueueStates states = states_of(list);
  if (!states.tasks.empty())
    throw Error(fmt::format("jobs {} are at work on these shards ({}); wait for them, or scancel {}", list,
                            states.text(), list));
  if (!states.trouble.empty() && !wanted.dry_run)
    throw Error(
        fmt::format("whether jobs {} are still at work on these shards is not known: {}; call ricochet submit "
                    "again where and when the queue answers",
                    list, states.trouble));
}

void refuse_further_round(const Scripts& s) {
  if (s.round <= most_rounds) return;
  throw Error(
      fmt::format("{} shards of '{}' are still not there after they were submitted again {} times; see why in "
                  "{}, mend it, and call ricochet submit",
                  s.shards.size(), s.session.sharded.filename().string(), most_rounds, (s.folder() / "*.log").string()),
      Exit::numerical);
}

void tell_how_to_submit(const Scripts& s) {
  const std::string merge = shell_words((s.folder() / merge_script).string()),
                    name = s.session.sharded.filename().string();
  if (s.shards.empty())
    return putf("all shards of '{}' are there; submit their merging by hand:\n  sbatch {}\n", name, merge);
  putf(
      "{} shards of '{}' in {} tasks; submit them by hand:\n  array=$(sbatch --parsable {})\n"
      "  sbatch --dependency=afterany:$array {}\n",
      s.shards.size(), name, s.tasks, shell_words((s.folder() / shard_script).string()), merge);
}

}  // namespace

void submit_shards(Session& session, const QueueOptions& wanted) {
  if (session.sharded.empty()) {
    putf("nothing is left to submit: the script has no sweep that was not merged\n");
    return;
  }
  const ShardPlan plan = read_plan(session.sharded);
  refuse_others_at_work(session, wanted);
  const int round = wanted.of == work_of(session, plan) ? wanted.round : 0;
  Scripts scripts{session, wanted, plan, round, missing_shards(session, plan), 0};
  refuse_errors(scripts);
  refuse_further_round(scripts);
  scripts.tasks = std::min(scripts.shards.size(), most_tasks());
  make_folder(scripts.folder());
  if (!scripts.shards.empty()) write_atomically(scripts.folder() / shard_script, shard_text(scripts));
  write_atomically(scripts.folder() / merge_script, merge_text(scripts));
  warn_of_build(session);
  wanted.dry_run ? tell_how_to_submit(scripts) : submit_scripts(scripts);
}

}  // namespace ricochet
