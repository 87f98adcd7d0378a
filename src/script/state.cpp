#include "script/state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "core/spelling.hpp"
#include "script/kept_bodies.hpp"
#include "script/pairs.hpp"
#include "script/reader.hpp"
#include "script/script_file.hpp"
#include "store/files.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// A value as tostring() gives it.
std::string displayed(lua_State* L, int index) {
  std::size_t length = 0;
  const char* text = luaL_tolstring(L, index, &length);
  std::string result(text, length);
  lua_pop(L, 1);
  return result;
}

int print(lua_State* L) {
  std::string line;
  for (int i = 1; i <= lua_gettop(L); ++i) line += (i > 1 ? "\t" : "") + displayed(L, i);
  if (!session_of(L).options.check) session_of(L).print(line + "\n");  // with --check nothing ran that could be told of
  return 0;
}

// True if some field takes this text.
bool is_choice(const std::string& text) {
  for (const Function& f : functions())
    for (const Field& field : f.fields)
      if (std::find(field.choices.begin(), field.choices.end(), text) != field.choices.end()) return true;
  return false;
}

// What an unknown name may mean, whose nearest spelling is known.
std::string meaning(const std::string& name, const std::string& nearest) {
  if (name == "O" || name == "o") return " (did you mean the digit 0?)";
  if (name == "io") return " (files are below the run's folder, through ricochet.file)";
  if (name == "ricochet") return " (begin the script with: local ricochet = require \"ricochet\")";
  if (!nearest.empty()) return nearest;
  if (is_choice(name)) return fmt::format(" (if the text is meant, write \"{}\")", name);
  return did_you_mean(name, std::vector<std::string>{"ricochet"});
}

std::string where(lua_State* L) {
  const CallSite site = call_site(L);
  return site.file.empty() ? "" : fmt::format("{}:{}", site.file, site.line);
}

// Wraps a Lua function of the library in a C function: the caller's frame then stays on the stack even in a tail call,
// so that a mistake can be reported at the caller's line.
int wrapped(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

int wrap(lua_State* L) {
  lua_pushcclosure(L, wrapped, 1);
  return 1;
}

// check(name, table [, ours]): the table's fields checked against those of the function; a copy with the defaults
// filled in, and a plain one of what was given alone.
int check(lua_State* L) {
  const Function& function = function_named(luaL_checkstring(L, 1));
  if (function.is_adaptive && session_of(L).options.part != Part::whole)
    throw at_this_call(L,
                       "decides by what it runs, and shards must all do the same: run it by itself, and write what it "
                       "found into the script of the sweep");
  check_table(L, 2, function, lua_toboolean(L, 3));
  lua_newtable(L);
  for (const Field& field : function.fields) {
    lua_getfield(L, 2, field.name.c_str());
    if (lua_isnil(L, -1) && !field.initial.empty()) {
      lua_pop(L, 1);
      if (field.type == "string")
        lua_pushstring(L, field.initial.c_str());
      else if (luaL_dostring(L, ("return " + field.initial).c_str()) != LUA_OK)
        throw std::logic_error("a default is no Lua value: " + field.initial);
    }
    lua_setfield(L, -2, field.name.c_str());
  }
  lua_pushvalue(L, 2);
  return 2;
}

// fail(message, field, inner field ...): an error at a field of the user's call, or at the call itself.
int fail(lua_State* L) {
  std::vector<std::string> path;
  for (int i = 2; i <= lua_gettop(L); ++i) path.push_back(luaL_checkstring(L, i));
  throw Error(report(session_of(L), call_site(L), {{path, luaL_checkstring(L, 1)}}));
}

// fail_in(function, name, message): an error at a function of the user's, called `name` by us.
int fail_in(lua_State* L) {
  const std::string name = luaL_checkstring(L, 2), message = luaL_checkstring(L, 3);
  lua_Debug info;
  lua_pushvalue(L, 1);
  lua_getinfo(L, ">S", &info);
  throw Error(
      report(session_of(L), {info.source[0] == '@' ? info.source + 1 : "", name, info.linedefined}, {{{}, message}}));
}

// fail_here(message): an error at the user's line.
int fail_here(lua_State* L) { throw at_line(L, luaL_checkstring(L, 1)); }

// unknown(what, name, names): an error at the user's line, with the nearest of the names.
int unknown(lua_State* L) {
  const std::string what = luaL_checkstring(L, 1), name = fmt::format("{:.100}", displayed(L, 2));
  std::vector<std::string> names;
  for (lua_Integer i = 1; i <= luaL_len(L, 3); ++i) {
    lua_geti(L, 3, i);
    names.push_back(displayed(L, -1));
    lua_pop(L, 1);
  }
  throw unknown_name(L, what, name, names);
}

// did_you_mean(name, names): " (did you mean 'x'?)", or nothing.
int nearest(lua_State* L) {
  std::vector<std::string> names;
  for (lua_Integer i = 1; i <= luaL_len(L, 2); ++i) {
    lua_geti(L, 2, i);
    names.push_back(displayed(L, -1));
    lua_pop(L, 1);
  }
  lua_pushstring(L, did_you_mean(luaL_checkstring(L, 1), names).c_str());
  return 1;
}

// function_names(): the names of the module.
int function_names(lua_State* L) {
  std::set<std::string> names;  // those of file.write and file.read are one
  for (const Function& f : functions())
    if (!f.is_method() && !f.is_table) names.insert(f.name.substr(0, f.name.find('.')));
  lua_newtable(L);
  for (const std::string& name : names) {
    lua_pushstring(L, name.c_str());
    lua_seti(L, -2, luaL_len(L, -2) + 1);
  }
  return 1;
}

// make_scene(f, at, place): f(at); a mistake in it is reported with the place in the sweep.
int make_scene(lua_State* L) {
  struct Making {
    std::string& place;
    ~Making() { place.clear(); }
  } making{session_of(L).making};
  making.place = luaL_checkstring(L, 3);
  lua_settop(L, 2);
  lua_call(L, 1, 1);
  return 1;
}

int is_scene(lua_State* L) {
  lua_pushboolean(L, luaL_testudata(L, 1, "ricochet.scene") != nullptr);
  return 1;
}

// is(value, metatable): true if that is the value's. getmetatable tells scripts, and the library, nothing of protected
// ones.
int is(lua_State* L) {
  lua_settop(L, 2);
  lua_pushboolean(L, lua_istable(L, 1) && lua_getmetatable(L, 1) && lua_rawequal(L, -1, 2));
  return 1;
}

// plain(value): a copy, with all tables in it copied.
int plain(lua_State* L) {
  lua_settop(L, 1);
  make_plain(L, 1);
  return 1;
}

int is_check(lua_State* L) {
  lua_pushboolean(L, session_of(L).options.check);
  return 1;
}

int is_resume(lua_State* L) {
  lua_pushboolean(L, session_of(L).options.resume);
  return 1;
}

int traceback(lua_State* L) {
  if (session_of(L).options.traceback) {
    const std::string message = displayed(L, 1);
    luaL_traceback(L, L, message.c_str(), 1);
  } else if (!lua_isstring(L, 1)) {
    const bool speaks = luaL_getmetafield(L, 1, "__tostring") != LUA_TNIL;
    const std::string message =
        speaks ? displayed(L, 1)
               : fmt::format("the script raised an error without a message ({}); give error() a text",
                             luaL_typename(L, 1));
    lua_pushstring(L, (speaks ? message : std::string(at_line(L, message).what())).c_str());
  }
  if (const std::string& place = session_of(L).making; !place.empty()) {
    const std::string message = displayed(L, -1);
    lua_pushfstring(L, "%s%s  in the sweep at %s", message.c_str(), message.ends_with("\n") ? "" : "\n", place.c_str());
  }
  return 1;
}

}  // namespace

State::State(Session& session)
    : session_(session),
      sandbox_({.unsafe = session.options.unsafe,
                .library = session.library,
                .script = session.script,
                .native = "ricochet.core",
                .sources = session.sources,
                .read = read_source,
                .where = where,
                .at_line = at_line,
                .syntax_error = syntax_error,
                .meaning = meaning}) {
  *static_cast<Session**>(lua_getextraspace(L_)) = &session_;
  order_pairs(L_);
  lua_register(L_, "print", guarded<print>);

  lua_newtable(L_);  // the module's native part, which lua/ricochet/init.lua requires as "ricochet.core"
  const luaL_Reg natives[] = {{"check", guarded<check>},      {"fail", guarded<fail>},
                              {"fail_in", guarded<fail_in>},  {"fail_here", guarded<fail_here>},
                              {"unknown", guarded<unknown>},  {"function_names", function_names},
                              {"did_you_mean", nearest},      {"wrap", wrap},
                              {"wrap_keeping", wrap_keeping}, {"is", is},
                              {"plain", guarded<plain>},      {"is_check", is_check},
                              {"is_resume", is_resume},       {"make_scene", make_scene},
                              {"is_scene", is_scene}};
  for (const luaL_Reg& f : natives) {
    lua_pushcfunction(L_, f.func);
    lua_setfield(L_, -2, f.name);
  }
  add_functions(L_);
  luaL_getsubtable(L_, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_insert(L_, -2);
  lua_setfield(L_, -2, "ricochet.core");
  lua_pop(L_, 1);
  sandbox_.close();
}

namespace {

// What was under way says "interrupted", and perhaps what of it is stored.
Error stopped(const std::string& message) {
  constexpr std::string_view begins = "interrupted";
  const std::string time_is_up = Clock::time_is_up();
  if (time_is_up.empty()) return Error(message, Exit::interrupted);
  return Error(time_is_up + (message.starts_with(begins) ? message.substr(begins.size()) : ""));
}

}  // namespace

// Calls the chunk on top of the stack.
void State::call_chunk(int results) {
  lua_pushcfunction(L_, traceback);
  lua_insert(L_, -2);
  const int handler = lua_gettop(L_) - 1;
  lua_pushinteger(L_, static_cast<int>(Exit::script));
  lua_setfield(L_, LUA_REGISTRYINDEX, exit_status);
  const int status = lua_pcall(L_, 0, results, handler);
  lua_remove(L_, handler);
  if (status == LUA_OK || session_.done) return;
  if (status == LUA_ERRMEM && !stop_requested)
    throw Error(
        fmt::format("{}the script needs more than 2 GiB of memory; look for a table or string that grows "
                    "without end, or recursion without end",
                    sandbox_.refused_at.empty() ? "" : sandbox_.refused_at + ": "));
  const std::string message =
      lua_isstring(L_, -1) ? lua_tostring(L_, -1) : "the script raised an error without a message";
  lua_pop(L_, 1);
  lua_getfield(L_, LUA_REGISTRYINDEX, exit_status);
  const Exit exit = static_cast<Exit>(lua_tointeger(L_, -1));
  lua_pop(L_, 1);
  if (stop_requested) throw stopped(message);
  // Lua's own errors name a line; show it.
  std::string shown = message;
  for (const auto& [name, text] : session_.sources)
    if (message.starts_with(name + ":") && message.find(" | ") == std::string::npos) {
      const std::size_t end = std::min(message.find('\n'), message.size());
      shown = message.substr(0, end) + "\n" + excerpt(text, {std::atoi(message.c_str() + name.size() + 1), 1, 0}) +
              message.substr(std::min(end + 1, message.size()));
    }
  throw Error(shown, exit);
}

void State::run_script() {
  check_script(session_.script);
  const Clock clock(L_, session_.options.max_seconds, session_.script.string());
  load_file(L_, session_.script, session_.script.string(), false);
  warn_of_encoding(session_);
  call_chunk(0);
  if (!session_.parameters_declared) refuse_unused_arguments(session_);
}

void State::study_first_scene() {
  const Clock clock(L_, session_.options.max_seconds, session_.script.string());
  lua_settop(L_, 0);
  if (lua_getfield(L_, LUA_REGISTRYINDEX, "ricochet.first_scene") == LUA_TNIL)
    throw Error(fmt::format("{} makes no scene", session_.script.string()));
  lua_pop(L_, 1);
  // Through a global of its own: the chunk takes no arguments.
  lua_pushglobaltable(L_);
  lua_pushliteral(L_, "first_scene");
  lua_getfield(L_, LUA_REGISTRYINDEX, "ricochet.first_scene");
  lua_rawset(L_, -3);
  lua_pop(L_, 1);
  const std::string& text = session_.options.study;
  if (luaL_loadbufferx(L_, text.data(), text.size(), "=study", "t") != LUA_OK)
    throw std::logic_error("study_first_scene");
  call_chunk(0);
}

void State::run_chunk() {
  const Clock clock(L_, session_.options.max_seconds, session_.script.string());
  call_chunk(LUA_MULTRET);
  for (int i = 1; i <= lua_gettop(L_); ++i) session_.print(displayed(L_, i) + "\n");
  lua_settop(L_, 0);
}

void State::run_text(const std::string& text) {
  const std::string expression = "return " + text;
  lua_settop(L_, 0);
  if (luaL_loadbufferx(L_, expression.data(), expression.size(), "=repl", "t") != LUA_OK) {
    lua_settop(L_, 0);
    if (luaL_loadbufferx(L_, text.data(), text.size(), "=repl", "t") != LUA_OK) {
      const std::string message = lua_tostring(L_, -1);
      lua_settop(L_, 0);
      throw Error(message);
    }
  }
  run_chunk();
}

}  // namespace ricochet
