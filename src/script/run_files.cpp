// Files below the run's folder: ricochet.file, and gnuplot for ricochet.plot.

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <filesystem>

#include "script/objects.hpp"
#include "script/state.hpp"
#include "store/files.hpp"

extern char** environ;

namespace ricochet {

namespace fs = std::filesystem;

fs::path below_folder(lua_State* L, const std::string& name) {
  const Session& session = session_of(L);
  const fs::path path(name);
  bool plain = !name.empty() && path.is_relative() && name.find('\\') == std::string::npos && name.find('\0') == std::string::npos;
  for (const fs::path& part : path) plain = plain && part != ".." && part != ".";
  if (!plain) throw at_line(L, fmt::format("'{}' is no name below the run's folder; give a relative name without '..'", name.c_str()));
  // A link inside the folder must not lead out of it.
  const fs::path whole = session.own_folder() / path;
  std::error_code error;
  const fs::path real = fs::weakly_canonical(whole, error), root = fs::weakly_canonical(session.own_folder(), error);
  if (error || std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
    throw FileError(at_line(L, fmt::format("'{}' leads out of the run's folder {}", name, session.own_folder().string())).what());
  return whole;
}

namespace {

// gnuplot(name, text): writes NAME.gp into the run's folder and lets gnuplot draw NAME.svg and NAME.png.
int gnuplot(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  const fs::path script = below_folder(L, name + ".gp");
  spend(L, work_a_plot);
  session.claim(session.own_folder());
  write_atomically(script, luaL_checkstring(L, 2));
  const std::string file = script.filename().string();
  const char* arguments[] = {"gnuplot", file.c_str(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, script.parent_path().c_str());
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "gnuplot", &actions, nullptr, const_cast<char**>(arguments), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) throw FileError("gnuplot is not installed; apt-get install gnuplot-nox");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw FileError(fmt::format("gnuplot could not draw {} (its message stands above)", script.string()));
  session.print(fmt::format("plot: {}\n", fs::path(script).replace_extension(".png").string()));
  return 0;
}

// Files that cannot be read or written are named at the script's line.
template <class Work>
void at_script(lua_State* L, Work work) {
  try {
    work();
  } catch (const FileError& error) {
    throw FileError(at_line(L, error.what()).what());
  }
}

int file_write(lua_State* L) {
  Session& session = session_of(L);
  std::size_t length = 0;
  const char* given = luaL_checklstring(L, 1, &length);
  const std::string name(given, length);
  const fs::path path = below_folder(L, name);
  if (is_of_the_run(name)) throw at_line(L, fmt::format("'{}' is the name of a file that runs leave themselves; give another", name));
  const char* text = luaL_checklstring(L, 2, &length);
  if (session.options.check) return 0;
  spend(L, work_a_file + static_cast<double>(length) / 8);
  session.claim(session.own_folder());
  at_script(L, [&] { make_folder(path.parent_path()), write_atomically(path, {text, length}); });
  return 0;
}

int file_read(lua_State* L) {
  std::size_t length = 0;
  const char* name = luaL_checklstring(L, 1, &length);
  const fs::path path = below_folder(L, {name, length});
  std::string text;
  at_script(L, [&] { text = read_file(path); });
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

}  // namespace

void add_run_files(lua_State* L) {
  const luaL_Reg list[] = {{"gnuplot", guarded<gnuplot>}, {"file_write", guarded<file_write>}, {"file_read", guarded<file_read>}};
  for (const luaL_Reg& f : list) lua_pushcfunction(L, f.func), lua_setfield(L, -2, f.name);
}

}  // namespace ricochet
