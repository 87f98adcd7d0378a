#pragma once
// The folders that a run writes into, and what of earlier runs lies in them. What a run makes there is on a list of
// its own in the folder (run_names::list); nothing else is ever replaced or removed.

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "store/files.hpp"

namespace ricochet {

struct RunOptions;

class RunFolders {
 public:
  using Warn = std::function<void(const std::string& text)>;

  RunFolders(const RunOptions& options, Warn warn) : options_(options), warn_(std::move(warn)) {}

  /// The folder of a name: OUT/<name>; with --new the first of OUT/<name>, <name>-2, <name>-3 ... that holds nothing;
  /// with --new --resume the last that holds something.
  std::filesystem::path named(const std::string& name) const;

  /// Refuses a folder that holds what earlier runs made, unless --resume or --force is given. Throws FileError.
  void refuse_earlier(const std::filesystem::path& folder) const;

  /// Makes a folder ready for writing, once, and locks it against other runs; warns where the file system has no locks.
  /// Throws FileError.
  void claim(const std::filesystem::path& folder);
  /// Puts a file or a folder of frames below a claimed folder on its list. Throws FileError if one is there that is
  /// not of an earlier run's making.
  void own(const std::filesystem::path& path);

  /// The sweep of this claimed folder has stored its results, in place of any earlier ones.
  void results_are_whole(const std::filesystem::path& folder) { results_.insert(folder); }

  /// After a script without mistakes: with --force, what it did not replace of earlier results and products is none of
  /// its own, and goes.
  void remove_replaced();

  bool claimed(const std::filesystem::path& folder) const { return claimed_.count(folder) > 0; }
  /// The first of the claimed folders; none if nothing was claimed.
  std::filesystem::path any_claimed() const { return claimed_.empty() ? "" : claimed_.begin()->first; }
  /// True if results lie in a claimed folder.
  bool something_stored() const;

 private:
  static std::filesystem::path last_tried(const std::filesystem::path& folder);

  struct Made {
    std::set<std::string> before, now;  ///< paths below the folder, of earlier runs and of this one
  };

  const RunOptions& options_;
  Warn warn_;
  mutable std::map<std::string, std::filesystem::path> named_;
  std::map<std::filesystem::path, Made> claimed_;
  std::set<std::filesystem::path> results_;
  std::vector<FolderLock> locks_;
};

}  // namespace ricochet
