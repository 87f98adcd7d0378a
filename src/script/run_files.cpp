// ricochet.file: files below the run's folder.

#include "script/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "script/reader.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// A path below a folder; `what` names it. `links`: may lead out of it.
fs::path below(lua_State* L, const fs::path& folder, const char* what, const std::string& name, bool links) {
  const fs::path path(name);
  bool plain = !name.empty() && path.is_relative() && name.find('\\') == std::string::npos &&
               name.find('\0') == std::string::npos && name.find('\n') == std::string::npos;
  for (const fs::path& part : path) plain = plain && part != ".." && part != ".";
  if (!plain)
    throw at_line(L, fmt::format("'{}' is no name below {}; give a relative name without '..'", name.c_str(), what));
  const fs::path whole = folder / path;
  std::error_code error;
  const fs::path real = fs::weakly_canonical(whole, error), root = fs::weakly_canonical(folder, error);
  if (!links && (error || !is_within(real, root)))
    throw FileError(at_line(L, fmt::format("'{}' leads out of {} {}", name, what, folder.string())).what());
  return whole;
}

}  // namespace

fs::path below_folder(lua_State* L, const std::string& name) {
  return below(L, session_of(L).own_folder(), "the run's folder", name, false);
}

fs::path beside_script(lua_State* L, const std::string& name) {
  const Session& session = session_of(L);
  const fs::path folder = session.script.parent_path();
  return below(L, folder.empty() ? "." : folder, "the script's folder", name, session.options.unsafe);
}

namespace {

// Files that cannot be read or written are named at the script's line.
template <class Work>
void at_script(lua_State* L, Work work) {
  try {
    work();
  } catch (const FileError& error) {
    throw FileError(at_line(L, error.what()).what());
  }
}

std::string text_argument(lua_State* L, int index) {
  std::size_t length = 0;
  const char* text = luaL_checklstring(L, index, &length);
  return {text, length};
}

int file_write(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = text_argument(L, 1);
  const fs::path path = below_folder(L, name);
  if (run_names::is_of_the_run(name))
    throw at_line(L, fmt::format("'{}' is the name of a file that runs leave themselves; give another", name));
  std::size_t length = 0;
  const char* text = luaL_checklstring(L, 2, &length);
  if (session.options.check) return 0;
  session.folders.claim(session.own_folder());
  at_script(L, [&] {
    session.folders.own(path);
    make_folder(path.parent_path());
    write_atomically(path, {text, length});
  });
  return 0;
}

int file_read(lua_State* L) {
  const fs::path path = below_folder(L, text_argument(L, 1));
  std::string text;
  at_script(L, [&] { text = read_file(path); });
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

}  // namespace

Group file_functions() {
  return {.functions = {{.name = "file.write",
                         .doc = "Writes text into a file below the run's folder: ricochet.file.write(name, text).",
                         .returns = "nothing",
                         .example = "ricochet.file.write(\"note.txt\", \"done\")",
                         .call = guarded<file_write>,
                         .arguments = {{"name", "string"}, {"text", "string"}}},
                        {.name = "file.read",
                         .doc = "Reads a file below the run's folder: ricochet.file.read(name).",
                         .returns = "string",
                         .example = "ricochet.file.read(\"note.txt\")",
                         .call = guarded<file_read>,
                         .arguments = {{"name", "string"}}}}};
}

}  // namespace ricochet
