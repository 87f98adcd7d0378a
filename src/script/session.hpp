#pragma once
// What one run of the program knows: its options, its script, its folder and its log.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "body/plan.hpp"
#include "core/hash_pieces.hpp"
#include "impact/chosen_steps.hpp"
#include "impact/scene.hpp"
#include "record/row.hpp"
#include "sandbox/sandbox.hpp"
#include "script/page.hpp"
#include "script/remembered_steps.hpp"
#include "script/run_folders.hpp"
#include "store/table.hpp"

namespace ricochet {

class ChunkSteps;

/// What of its script's sweeps a process does: all; only the plan for shards; one shard; or the merging of them.
enum class Part { whole, plan, shard, merge };

struct RunOptions {
  int threads = 0;
  int batch = 0;  ///< 0: as many lanes as there are
  std::string out = "out";
  bool resume = false, force = false, fresh = false;  ///< what to do where results are: fresh is --new
  bool report = true;                                 ///< leave report.html
  bool check = false, traceback = false, quiet = false, unsafe = false, help = false;
  std::string steps;       ///< file of the methods and steps that trials chose; empty: run.steps in `out`
  std::string study;       ///< Lua that studies `first_scene`: the script is then only checked
  double max_seconds = 0;  ///< of the whole run; 0: no limit

  Part part = Part::whole;
  std::size_t shard = 0, shards = 0;  ///< which, from 0, of how many; 0 of a plan: as it sees fit
  double flush = 30;                  ///< seconds of a shard's or a long sweep's rows that a kill may lose
  long at_once = 8192;                ///< scenes of a sweep that are made and kept together
  bool partial = false;               ///< merge what is there
};

/// The name of a script that is read from standard input.
inline constexpr const char* standard_input = "-";

/// A sweep that has run, for its replays.
struct Swept {
  std::string name;
  std::filesystem::path folder;
  /// The scene of a row by its hash, with the step that was chosen; none if it cannot be had.
  std::function<std::optional<Scene>(const std::string& hash)> scene_of;
};

/// What a script says of its report (ricochet.report).
struct PageWish {
  std::string title, notes, which = "typical";
  std::vector<std::string> questions;
  std::vector<PageLine> lines;
  std::vector<std::string> plots;   ///< columns
  std::vector<std::string> hashes;  ///< of the scenes of rows to replay; empty: chosen as `which` says
  int replays = 6, frames = 120;
};

/// ^C, SIGTERM and SIGHUP (a terminal that is gone), unless nohup ignores it, then ask the run to stop. A second signal
/// ends the program at once.
void catch_signals();

class Session {
 public:
  Session(RunOptions run_options, std::filesystem::path script_path, std::vector<std::string> script_arguments);

  RunOptions options;
  std::filesystem::path script;
  std::filesystem::path library;               ///< folder of the Lua library
  std::map<std::string, std::string> sources;  ///< text of every Lua file read, by the name in messages
  std::vector<std::string> arguments;          ///< name=value, as given
  bool parameters_declared = false;
  bool repl = false;              ///< what is typed may be made again under the same name
  bool done = false;              ///< the script ended early without an error: after --help
  std::filesystem::path sharded;  ///< folder of the sweep of which this process makes the plan or runs a shard
  std::string making;             ///< the values of a sweep's point while its scene is being made: "psi1 = 2"
  std::map<std::string, std::shared_ptr<const NodePlan>> plans;  ///< planned nodes of bodies, by their geometry
  double planned_nodes = 0;                                      ///< in `plans`
  /// Of scenes that are not needed any more: Lua does not see how much they hold.
  void forget_plans() {
    plans.clear();
    planned_nodes = 0;
  }

  std::map<std::string, std::shared_ptr<const Scene>>
      chosen;  ///< scenes with the step chosen for their accuracy, by the asked scene's hash
  std::map<std::string, KnownChoices> rounds;  ///< of sweeps that run in rounds, by name: what their trials chose

  std::shared_ptr<ChunkSteps> planned_steps;  ///< of a plan of shards that is being made
  std::vector<HashKey> planned_scenes;        ///< where rows are there already

  RememberedSteps steps;

  RunFolders folders{options, [this](const std::string& text) { warn(text); }};

  std::vector<Swept> swept;                    ///< in the order in which they ran
  std::vector<std::pair<Scene, Row>> singles;  ///< that ran by themselves, the first `most_singles`
  static constexpr std::size_t most_singles = 1000;
  PageWish page;
  std::vector<std::pair<std::string, PagePlot>> plotted;  ///< by the scene's hash of one of the rows

  /// The script's own folder, named as its file is. A shard's pictures and files are nobody's: they go to a folder that
  /// goes with it.
  std::filesystem::path own_folder() const;

  /// After a script without mistakes: removes what it replaced, and writes run.log.
  void finish();

  /// Counts an impact that ran, for the exit status: 3 if some ran and none finished.
  void count(const Row& row) {
    ++(row.finished() ? finished_ : failed_);
    if (!row.finished() && first_failure.empty()) first_failure = row.status + ": " + row.reason;
  }
  /// The same of many: how many did and did not finish, and how and why the first that did not.
  void count(std::size_t finished, std::size_t failed, const std::string& failure) {
    finished_ += finished;
    failed_ += failed;
    if (first_failure.empty()) first_failure = failure;
  }
  bool nothing_finished() const { return failed_ > 0 && finished_ == 0; }
  std::string first_failure;  ///< why the first impact that did not finish did not

  /// True the first time a sweep of this name runs; a second one would replace its results.
  bool first_sweep_named(const std::string& name) { return sweeps_.insert(name).second || repl; }

  /// True if neither this path nor one above or below it was made before by a picture, film or recording.
  bool first_picture_named(const std::filesystem::path& path);

  /// What the script prints, to standard output and into run.log.
  void print(const std::string& text);
  /// What the program says of its own accord: the same, but with --quiet only into run.log.
  void inform(const std::string& text) { options.quiet ? log(text) : print(text); }
  /// The first time for this `key` as inform(), else as log().
  void inform_first(const std::string& key, const std::string& text) {
    told_.insert(key).second ? inform(text) : log(text);
  }
  /// To the terminal's error stream, and into run.log; the same text once.
  void warn(const std::string& text);
  /// Only into run.log.
  void log(const std::string& text) { log_ += text; }
  /// What run.log will hold, so far.
  const std::string& logged() const { return log_; }
  /// The file of what trials chose.
  std::filesystem::path steps_file() const;
  /// Writes run.log and what trials chose, if the run has written anything else.
  void write_log() const;

  /// Version and commit of this program.
  static Provenance made_by();
  Provenance provenance() const;

 private:
  std::set<std::filesystem::path> pictures_;
  std::unique_ptr<const ScratchFolder> scratch_;  ///< of a shard
  std::set<std::string> sweeps_, warned_, told_;
  std::size_t failed_ = 0, finished_ = 0;
  std::string log_, start_;
};

/// Time in UTC, as 2026-01-31T12:00:00Z.
std::string now_utc();
std::string version_text();

}  // namespace ricochet
