#pragma once
// A bounded Lua that has never heard of an impact.
//
// The walls. A script gets Lua's libraries without io, debug and package; of os only the time. It loads text, never
// bytecode or native code. Modules come from the library's folder and from beside the script, by no `..` and through no
// link that leads out. Unknown names and new globals are errors. It writes no finalizers, and strings' methods cannot
// be changed. The library (Lua that is trusted) runs among functions of its own, so that a script that changes
// string.gsub changes its own. `unsafe` lifts these walls, but for the strict names.
//
// The bounds. Lua's own memory is at most 2 GiB. Time has no bound unless one is given, and is kept by the clock alone:
// nothing is counted. When the time is up, a watching thread sends the interpreter's thread a signal, whose handler
// sets a hook on the coroutine that runs. The hook raises an error at each instruction from then on, so that nothing
// that catches it goes on. What Lua does without an instruction or a hook (a search in a string, a handler of xpcall)
// gets a second more; then the process ends by itself.

#include <atomic>
#include <filesystem>
#include <lua.hpp>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"

namespace ricochet {

/// The run is to stop. What takes long and is not Lua looks at it and gives up.
extern std::atomic<bool> stop_requested;

/// Seconds in which a run that is told to stop must have stored what is done.
inline constexpr unsigned grace = 20;

/// Requests the stop, and Lua's at its next instruction; from any thread, or a signal's handler. True if it was
/// requested before.
bool ask_to_stop();

/// While it lives results are stored, for which the clock allows the whole grace.
struct Storing {
  Storing() { ++now; }
  ~Storing() { --now; }
  static std::atomic<int> now;
};

/// While it lives Lua runs, one state in the process, and stops when asked; after `seconds` (0: never) the clock asks.
class Clock {
 public:
  Clock(lua_State* L, double seconds, const std::string& file);
  ~Clock();

  /// "script stopped: --max-seconds 2 reached at s.lua:3"; "" before.
  static std::string time_is_up();

 private:
  std::jthread watcher_;
};

/// What the sandbox is given by who opens it, and how mistakes are worded.
struct Surroundings {
  bool unsafe;
  std::filesystem::path library;                ///< folder of the library, which is searched first
  std::filesystem::path script;                 ///< modules are searched beside it, too
  std::string native;                           ///< a module that the library alone may require
  std::map<std::string, std::string>& sources;  ///< text of every Lua file read, by the name in messages
  std::string (*read)(const std::filesystem::path&);
  std::string (*where)(lua_State*);  ///< "file:line" of the script that runs, or ""
  Error (*at_line)(lua_State*, const std::string& message);
  Error (*syntax_error)(const std::string& name, const std::string& text, const std::string& message);
  /// What an unknown name may mean, its nearest spelling in the words of did_you_mean.
  std::string (*meaning)(const std::string& name, const std::string& nearest);
};

struct Sandbox {
  explicit Sandbox(Surroundings surroundings);
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;

  /// When all that scripts find is there: gives the library its own copy of it, then makes unknown names and new
  /// globals errors.
  void close();

  const Surroundings given;
  std::vector<std::string> loading;  ///< modules that are being required, the outermost first
  std::string refused_at;            ///< where memory was refused, "file:line" or ""
  std::size_t used = 0;              ///< bytes of Lua's own memory
  lua_State* const L;
};

Sandbox& sandbox_of(lua_State* L);

/// Leaves a file's text on the stack as a chunk called `name`. `of_library`: among the library's own functions. Throws
/// Error for mistakes of syntax.
void load_file(lua_State* L, const std::filesystem::path& path, const std::string& name, bool of_library);

/// Remembers where the script is, if it stops there.
void note_stop(lua_State* L);

/// Where in the registry the exit status of the last error travels: a script that catches it sees plain text.
inline constexpr const char* exit_status = "ricochet.exit";

/// A C++ function that Lua may call: exceptions become Lua errors, and the error text is that of the exception.
template <int (*function)(lua_State*)>
int guarded(lua_State* L) {
  try {
    return function(L);
  } catch (const std::exception& error) {
    const Error known = as_error(error);
    lua_pushstring(L, known.what());
    lua_pushinteger(L, static_cast<int>(known.exit));
  }
  note_stop(L);
  lua_setfield(L, LUA_REGISTRYINDEX, exit_status);
  return lua_error(L);
}

/// Lua's coroutines, so that the one that runs is the one that stops.
void open_coroutines(lua_State* L);

/// Calls Lua's own function in the place of the one that replaces it, whose upvalue it is.
inline int original(lua_State* L, int upvalue = 1) { return lua_tocfunction(L, lua_upvalueindex(upvalue))(L); }

}  // namespace ricochet
