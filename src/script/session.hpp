#pragma once
// What one run of the program knows: its options, its script, its folder and its log.

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "body/plan.hpp"
#include "impact/scene.hpp"
#include "record/row.hpp"
#include "sandbox/sandbox.hpp"
#include "store/files.hpp"
#include "store/table.hpp"

namespace ricochet {

struct RunOptions {
  int threads = 0;
  int batch = 0;  ///< 0: as many lanes as there are
  std::string out = "out";
  bool resume = false, force = false, check = false, traceback = false, quiet = false, unsafe = false, help = false;
  std::string study;       ///< Lua that studies `first_scene`: the script is then only checked
  double max_seconds = 0;  ///< of the whole run; 0: no limit
};

/// ^C and SIGTERM then ask the run to stop. A second signal ends the program at once.
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
  bool done = false;   ///< the script ended early without an error: after --help
  std::string making;  ///< the values of a sweep's point while its scene is being made: "psi1 = 2"
  std::map<std::string, std::shared_ptr<const NodePlan>> plans;  ///< planned nodes of bodies, by their geometry
  double planned_nodes = 0;                                      ///< in `plans`

  std::map<std::string, std::shared_ptr<const Scene>>
      chosen;  ///< scenes with the step chosen for their accuracy, by the asked scene's hash

  /// The folder of a name: OUT/<name>. The script's own is that of its file name.
  std::filesystem::path folder(const std::string& name) const { return std::filesystem::path(options.out) / name; }
  std::filesystem::path own_folder() const { return folder(script.stem().string()); }

  /// Refuses a folder that holds earlier results, unless --resume or --force is given. Throws FileError.
  void refuse_earlier_results(const std::filesystem::path& folder) const;
  /// Makes a folder ready for writing, once, and locks it against other runs; with --force, notes the earlier products
  /// in it.
  void claim(const std::filesystem::path& folder);
  /// With --force, removes what earlier sweeps stored in a folder, once: when there is something to store instead, so
  /// that a mistake does not cost them.
  void replace_results(const std::filesystem::path& folder);
  /// The same for a folder of frames that is about to be filled; single files replace themselves.
  void replace_product(const std::filesystem::path& path);
  /// After a script without mistakes: what it did not replace of earlier results and products, with --force, is none of
  /// its own; run.log.
  void finish();

  /// Counts an impact that ran, for the exit status: 3 if some ran and none finished.
  void count(const Row& row) {
    ++(row.finished() ? finished_ : failed_);
    if (!row.finished() && first_failure.empty()) first_failure = row.status + ": " + row.reason;
  }
  bool nothing_finished() const { return failed_ > 0 && finished_ == 0; }
  /// True if results lie in a folder of this run's.
  bool something_stored() const;
  std::string first_failure;  ///< why the first impact that did not finish did not

  /// True the first time a sweep of this name runs; a second one would replace its results.
  bool first_sweep_named(const std::string& name) { return sweeps_.insert(name).second; }

  /// True if neither this path nor one above or below it was made before by a picture, film or recording.
  bool first_picture_named(const std::filesystem::path& path);

  /// Prints to the terminal and into run.log.
  void print(const std::string& text);
  /// The first time for this `key` as print(), else as log().
  void print_first(const std::string& key, const std::string& text) {
    told_.insert(key).second ? print(text) : log(text);
  }
  /// To the terminal's error stream, and into run.log; the same text once.
  void warn(const std::string& text);
  /// Only into run.log.
  void log(const std::string& text) { log_ += text; }
  /// Writes run.log, if the run has written anything else.
  void write_log() const;

  /// Version and commit of this program.
  static Provenance made_by();
  Provenance provenance() const;

 private:
  std::set<std::filesystem::path> claimed_, replaced_;
  std::map<std::filesystem::path, std::filesystem::file_time_type>
      old_;  ///< products that were there, and when they were written
  std::vector<FolderLock> locks_;
  std::set<std::filesystem::path> pictures_;
  std::set<std::string> sweeps_, warned_, told_;
  int failed_ = 0, finished_ = 0;
  std::string log_, start_;
};

/// Time in UTC, as 2026-01-31T12:00:00Z.
std::string now_utc();
std::string version_text();

}  // namespace ricochet
