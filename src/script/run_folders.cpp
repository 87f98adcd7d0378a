#include "script/run_folders.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "script/session.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// False for a folder that is not there, or in which a run would lose nothing: that of one that only logged or failed.
bool holds_work(const fs::path& folder) {
  if (run_names::holds_results(folder)) return true;
  const std::set<std::string> made = run_names::made_in(folder);
  return std::any_of(made.begin(), made.end(),
                     [&](const std::string& name) { return run_names::is_product(folder / name); });
}

// A folder for another try: not there yet, or one that holds no work.
fs::path next_free(const fs::path& folder) {
  std::error_code error;
  fs::path next = folder;
  for (int k = 2; (fs::exists(next, error) && !fs::is_directory(next, error)) || holds_work(next); ++k)
    next = folder.string() + fmt::format("-{}", k);
  return next;
}

}  // namespace

fs::path RunFolders::last_tried(const fs::path& folder) {
  fs::path last = folder;
  for (int k = 2;; ++k) {
    const fs::path next = folder.string() + fmt::format("-{}", k);
    if (!holds_work(next)) return last;
    last = next;
  }
}

fs::path RunFolders::named(const std::string& name) const {
  const fs::path folder = fs::path(options_.out) / name;
  if (!options_.fresh) return folder;
  const auto known = named_.find(name);
  return known != named_.end() ? known->second
                               : named_[name] = options_.resume ? last_tried(folder) : next_free(folder);
}

void RunFolders::refuse_earlier(const fs::path& folder) const {
  std::error_code error;
  if (options_.resume || options_.force || options_.check) return;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw FileError(fmt::format("{} is a file; give another folder with --out", folder.string()));
  if (holds_work(folder))
    throw FileError(fmt::format("{} already holds results; {}--force replaces them, --new leaves them and goes to {}",
                                folder.string(), options_.study.empty() ? "--resume continues them, " : "",
                                next_free(folder).string()));
}

void RunFolders::claim(const fs::path& folder) {
  if (claimed(folder)) return;
  refuse_earlier(folder);
  if (run_names::has_unlisted_plots(folder))
    throw FileError(
        fmt::format("{} holds plots of an earlier version, which kept no list of what it made: new ones would be "
                    "refused once all impacts are done; move them, or use --new, which goes to {}",
                    folder.string(), next_free(folder).string()));
  make_folder(folder);
  if (const std::string& refusal = locks_.emplace_back(folder).refusal(); !refusal.empty())
    warn_(fmt::format("{} cannot be locked ({}), so that a second run into it would not be noticed; start none",
                      folder.string(), refusal));
  refuse_earlier(folder);  // what another run left while this one waited to begin
  claimed_[folder].before = run_names::made_in(folder);
}

void RunFolders::own(const fs::path& path) {
  for (auto& [folder, made] : claimed_) {
    const std::string name = path.lexically_relative(folder).string();
    if (name.empty() || name.starts_with("..")) continue;
    std::error_code error;
    if (made.now.count(name) > 0) return;
    if (made.before.count(name) == 0 && fs::exists(fs::symlink_status(path, error)) &&
        !(fs::is_directory(path, error) && fs::is_empty(path, error)))
      throw FileError(fmt::format(
          "{} is in the way, and no run of this folder's made it; move it, or give another name", path.string()));
    made.now.insert(name);
    std::set<std::string> all = made.before;
    all.insert(made.now.begin(), made.now.end());
    run_names::write_made(folder, all);
    return;
  }
  throw std::logic_error("a file is made in a folder that is not claimed");
}

void RunFolders::remove_replaced() {
  if (!options_.force) return;
  for (auto& [folder, made] : claimed_) {
    if (results_.count(folder) == 0) run_names::remove_results(folder);
    for (const std::string& name : made.before)
      if (made.now.count(name) == 0) run_names::remove_product(folder / name);
    run_names::write_made(folder, made.now);
  }
}

bool RunFolders::something_stored() const {
  return std::any_of(claimed_.begin(), claimed_.end(),
                     [](const auto& claimed) { return run_names::holds_results(claimed.first); });
}

}  // namespace ricochet
