#include "script/session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <lua.hpp>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "script/own_commit.hpp"
#include "script/terminal.hpp"
#include "script/version.hpp"
#include "store/files.hpp"
#include "store/hdf5_version.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

extern "C" void on_signal(int) {
  if (ask_to_stop()) _exit(130);
  alarm(grace);  // should something in a script not come back all the same; files are whole at any moment
}

extern "C" void on_alarm(int) { _exit(130); }

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hang_up {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is then an error of the file
}

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string version_text() {
  return fmt::format("ricochet {} (commit {})\ncompiler {}\n{} lanes, {}\nHDF5 {}, {}, Eigen {}.{}.{}", version_number,
                     version_commit, version_compiler, RICOCHET_LANES, version_target, hdf5_version(), LUA_RELEASE,
                     EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
}

namespace {

// As it is installed (PREFIX/bin beside PREFIX/share), or in a checkout or a folder of builds, somewhere above: a
// program that is copied with its library takes that, and none of another place.
fs::path library_of(const fs::path& program) {
  std::error_code error;
  for (fs::path above = program.parent_path(); above != above.root_path(); above = above.parent_path())
    for (const char* place : {"share/ricochet/lua", "lua"})
      if (fs::exists(above / place / "ricochet/init.lua", error)) return above / place;
  throw FileError(
      fmt::format("the Lua library is missing: in none of the folders above {} is a lua/ricochet/init.lua or "
                  "share/ricochet/lua/ricochet/init.lua; install the program with cmake --install, or copy "
                  "the folder lua beside it",
                  program.string()));
}

}  // namespace

Session::Session(RunOptions run_options, fs::path script_path, std::vector<std::string> script_arguments)
    : options(std::move(run_options)),
      script(std::move(script_path)),
      arguments(std::move(script_arguments)),
      start_(now_utc()) {
  if (const fs::path stem = this->script.stem(); stem == "." || stem == "..")
    throw FileError(fmt::format("{} has no name for a folder of results; rename the script", this->script.string()));
  if (options.part == Part::plan || options.part == Part::shard) scratch_ = std::make_unique<ScratchFolder>();
  library = library_of(fs::read_symlink("/proc/self/exe"));
}

fs::path Session::own_folder() const {
  if (scratch_) return scratch_->path();
  return folders.named(script == standard_input ? "stdin" : script.stem().string());
}

void Session::finish() {
  folders.remove_replaced();
  write_log();
}

bool Session::first_picture_named(const fs::path& path) {
  if (repl) return true;
  for (const fs::path& other : pictures_)
    if (is_within(path, other) || is_within(other, path)) return false;
  return pictures_.insert(path).second;
}

void Session::print(const std::string& text) {
  constexpr std::size_t most = std::size_t{64} << 20;
  if (log_.size() + text.size() > most)
    throw Error(
        "the script has printed more than 64 MiB, all of which run.log would hold; write what is so long with "
        "ricochet.file.write");
  put(text);
  log(text);
}

void Session::warn(const std::string& text) {
  if (!warned_.insert(text).second) return;
  say(fmt::format("warning: {}\n", text));
  log("warning: " + text + "\n");
}

void Session::write_log() const {
  if (folders.any_claimed().empty() || options.check || scratch_) return;
  const fs::path place = folders.claimed(own_folder()) ? own_folder() : folders.any_claimed();
  write_atomically(place / run_names::log, log_);
  steps.write(steps_file());
}

fs::path Session::steps_file() const {
  return options.steps.empty() ? fs::path(options.out) / run_names::steps : fs::path(options.steps);
}

Provenance Session::made_by() { return {{"version", version_number}, {"commit", own_commit()}}; }

Provenance Session::provenance() const {
  Provenance p;
  const auto text = sources.find(script.string());
  p["script"] = text == sources.end() ? "" : text->second;
  p["script_name"] = script.string();
  p["script_hash"] = hash_text(p["script"]);
  for (const auto& [name, required] : sources)
    if (name != script.string()) p["required_files"] += fmt::format("{} {}\n", hash_text(required), name);
  for (const std::string& argument : arguments) p["arguments"] += argument + "\n";
  p.merge(made_by());
  p["compiler"] = version_compiler;
  p["host"] = host_name();
  p["start"] = start_;
  p["end"] = now_utc();
  return p;
}

}  // namespace ricochet
