#include "script/repl.hpp"

#include <readline/history.h>
#include <readline/readline.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "script/functions.hpp"
#include "script/lua_values.hpp"
#include "script/reference.hpp"
#include "script/source.hpp"
#include "script/state.hpp"
#include "script/terminal.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

constexpr const char* values_key = "ricochet.repl";  // in the registry: what the user has defined
lua_State* completing = nullptr;                     // for readline, which passes nothing on
std::vector<std::string> candidates;

// help "disk", help(): what the reference says.
int help(lua_State* L) {
  const char* name = luaL_optstring(L, 2, "");
  lua_pushstring(L, help_on(std::string(name).starts_with("ricochet.") ? name + 9 : name).c_str());
  return 1;
}

int help_shown(lua_State* L) {
  lua_pushstring(L, help_on("").c_str());
  return 1;
}

// A table for the user's values, in front of the globals.
void make_values(lua_State* L) {
  lua_newtable(L);
  lua_newtable(L);
  lua_pushglobaltable(L);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
  lua_newtable(L);
  lua_newtable(L);
  for (const luaL_Reg& f : {luaL_Reg{"__call", guarded<help>}, {"__tostring", guarded<help_shown>}}) {
    lua_pushcfunction(L, f.func);
    lua_setfield(L, -2, f.name);
  }
  lua_setmetatable(L, -2);
  lua_setfield(L, -2, "help");
  lua_setfield(L, LUA_REGISTRYINDEX, values_key);
}

enum class Compiled { whole, incomplete, wrong };

// Leaves the chunk on the stack, with the user's values as its globals, or the message.
Compiled compile(lua_State* L, const std::string& text) {
  lua_settop(L, 0);
  const std::string kept = without_outer_locals(text);
  for (const std::string& form : {"return " + text, kept}) {
    lua_settop(L, 0);
    if (luaL_loadbufferx(L, form.data(), form.size(), "=repl", "t") != LUA_OK) continue;
    lua_getfield(L, LUA_REGISTRYINDEX, values_key);
    lua_setupvalue(L, -2, 1);
    return Compiled::whole;
  }
  const std::string message = lua_tostring(L, -1);
  return message.ends_with("<eof>") ? Compiled::incomplete : Compiled::wrong;
}

// The values of "a.b" in "a.b.na", or those of the user and the globals; names beginning with the last part.
void find_candidates(lua_State* L, const std::string& text) {
  const int top = lua_gettop(L);
  std::size_t start = 0;
  lua_getfield(L, LUA_REGISTRYINDEX, values_key);
  std::vector<std::string> names = names_in(L, -1);
  lua_pushglobaltable(L);
  for (const std::string& name : names_in(L, -1)) names.push_back(name);
  for (const Function& f : functions())
    for (const Field& field : f.fields) names.push_back(field.name);
  bool first = true;
  for (std::size_t dot; (dot = text.find('.', start)) != std::string::npos; start = dot + 1, first = false) {
    const std::string name = text.substr(start, dot - start);
    names.clear();
    for (const int outer : {top + 1, top + 2}) {  // the user's values, the globals; then what the name before gave
      lua_pushvalue(L, first ? outer : -1);
      lua_pushstring(L, name.c_str());
      lua_rawget(L, -2);
      if (!first || !lua_isnil(L, -1)) break;
    }
    if (!lua_istable(L, -1)) break;
    const int behind = luaL_getmetafield(L, -1, "__index");  // the module is empty in front
    if (behind == LUA_TTABLE) lua_replace(L, -2);
    if (behind != LUA_TTABLE && behind != LUA_TNIL) lua_pop(L, 1);
    names = names_in(L, -1);
  }
  const std::string before = text.substr(0, start), part = text.substr(start);
  for (const std::string& name : names)
    if (name.starts_with(part)) candidates.push_back(before + name);
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  lua_settop(L, top);
}

char* next_candidate(const char* text, int state) {
  static std::size_t next;
  if (state == 0) {
    next = 0;
    candidates.clear();
    find_candidates(completing, text);
  }
  return next < candidates.size() ? strdup(candidates[next++].c_str()) : nullptr;
}

char** complete(const char* text, int, int) {
  rl_attempted_completion_over = 1;  // no names of files
  rl_completion_append_character = '\0';
  return rl_completion_matches(text, next_candidate);
}

/// What was typed in earlier sessions, in $XDG_STATE_HOME/ricochet/history.
class History {
 public:
  History() {
    const char *state = std::getenv("XDG_STATE_HOME"), *home = std::getenv("HOME");
    if ((state && *state) || (home && *home))
      file_ = (state && *state ? fs::path(state) : fs::path(home) / ".local/state") / "ricochet/history";
    read_history(file_.c_str());
  }
  ~History() {
    std::error_code error;
    fs::create_directories(file_.parent_path(), error);
    write_history(file_.c_str());
    history_truncate_file(file_.c_str(), 1000);
  }
  History(const History&) = delete;

 private:
  fs::path file_;
};

volatile std::sig_atomic_t abandoned = 0;  // ^C at a prompt gives up what was typed

// Asked by readline while it waits: after a signal it would go on to read.
int end_abandoned() {
  if (abandoned != 0) rl_done = 1;
  return 0;
}

// A line of the terminal's, or of a pipe; false at the end.
bool prompted(const char* prompt, std::string& line) {
  if (!isatty(STDIN_FILENO) || !isatty(STDOUT_FILENO)) {
    put(prompt);
    return static_cast<bool>(std::getline(std::cin, line));
  }
  static History history;
  rl_event_hook = end_abandoned;
  abandoned = 0;
  const auto on_interrupt = std::signal(SIGINT, [](int) { abandoned = 1; });  // there is nothing to stop at a prompt
  char* typed = readline(prompt);
  std::signal(SIGINT, on_interrupt);
  if (!typed) return false;
  line = typed;
  if (!line.empty()) add_history(typed);
  std::free(typed);
  return true;
}

// `help disk`, without quotes, as people type it.
std::string as_call(const std::string& line) {
  std::istringstream words(line);
  std::string help, name, more;
  const bool two = words >> help >> name && !(words >> more);
  const auto in_name = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.'; };
  if (!two || help != "help" || !std::all_of(name.begin(), name.end(), in_name)) return line;
  if (std::isdigit(static_cast<unsigned char>(name[0])) || name[0] == '.') return line;
  return "help '" + name + "'";
}

// `exit` and `quit` end the session, unless the user calls something of theirs so.
bool asks_to_end(lua_State* L, const std::string& line) {
  if (line != "exit" && line != "quit" && line != "exit()" && line != "quit()") return false;
  lua_getfield(L, LUA_REGISTRYINDEX, values_key);
  lua_pushstring(L, line.substr(0, 4).c_str());
  const bool own = lua_rawget(L, -2) != LUA_TNIL;
  lua_pop(L, 2);
  return !own;
}

// The user's next entry, compiled on the stack; false at the end.
bool read_entry(lua_State* L) {
  std::string entry, line;
  while (prompted(entry.empty() ? "> " : ">> ", line)) {
    if (abandoned != 0) {
      entry.clear();
      continue;
    }
    if (entry.empty() && asks_to_end(L, line)) return false;
    entry += entry.empty() ? as_call(line) : "\n" + line;
    const Compiled compiled = compile(L, entry);
    if (compiled == Compiled::incomplete && !line.empty()) continue;  // an empty line gives up
    if (compiled == Compiled::whole) return true;
    say(complaint(lua_tostring(L, -1)));
    entry.clear();
  }
  return false;
}

}  // namespace

void run_repl() {
  RunOptions options;
  options.fresh = true;
  Session session(options, "repl", {});
  session.repl = true;
  State state(session);
  state.run_text("local _ = rawset(_G, 'ricochet', require 'ricochet')");
  make_values(state.lua());
  completing = state.lua();
  rl_attempted_completion_function = complete;
  rl_basic_word_break_characters = " \t\n\"\\'`@$><=;|&{}()[],+-*/%#~^:";
  putf("{}\nLua with `ricochet` loaded; help lists the reference, quit or ^D ends.\n",
       version_text().substr(0, version_text().find('\n')));
  while (read_entry(state.lua())) {
    session.parameters_declared = false;
    try {
      state.run_chunk();
    } catch (const Error& error) {
      say(complaint(error.what()));
    }
    stop_requested = false;  // ^C has stopped what ran, and only that
    lua_sethook(state.lua(), nullptr, 0, 0);
    alarm(0);
  }
  session.write_log();
  put("\n");
}

}  // namespace ricochet
