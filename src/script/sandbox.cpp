#include "script/sandbox.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/spelling.hpp"
#include "script/reader.hpp"
#include "store/files.hpp"

namespace ricochet {

namespace fs = std::filesystem;

std::string displayed(lua_State* L, int index) {
  std::size_t length = 0;
  const char* text = luaL_tolstring(L, index, &length);
  std::string result(text, length);
  lua_pop(L, 1);
  return result;
}

std::string shortened(const std::string& name) { return name.size() <= 100 ? name : name.substr(0, 100) + "..."; }

namespace {

// The library runs among functions of its own: what a script makes of string.gsub or table.concat does not reach it.
constexpr const char* library_environment = "ricochet.library";

}  // namespace

void load_file(lua_State* L, const fs::path& path, const std::string& name, bool of_library) {
  Session& session = session_of(L);
  std::string text = read_file(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // a byte order mark, which some editors write
  if (text.starts_with("#!")) text.insert(0, "--");        // a first line for the shell
  session.sources[name] = text;
  if (load_counted(L, text, "@" + name) != LUA_OK) {
    const std::string message = lua_tostring(L, -1);
    lua_pop(L, 1);
    if (text.starts_with("\x1bLua")) throw Error(name + ": bytecode is not accepted; give the script's text");
    int line = 0;
    if (message.starts_with(name + ":")) line = std::atoi(message.c_str() + name.size() + 1);
    throw Error(message + (line > 0 ? syntax_hint(text, line, message) + "\n" + excerpt(text, {line, 1, 0}) : ""));
  }
  if (of_library) {
    lua_getfield(L, LUA_REGISTRYINDEX, library_environment);
    lua_setupvalue(L, -2, 1);
  }
}

namespace {

int print(lua_State* L) {
  std::string line;
  for (int i = 1; i <= lua_gettop(L); ++i) line += (i > 1 ? "\t" : "") + displayed(L, i);
  spend(L, static_cast<double>(line.size()) / 8);
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

// string.fromat: an error with the nearest name, not nil.
int unknown_library_function(lua_State* L) {
  std::vector<std::string> names;
  for (lua_pushnil(L); names.size() < most_names && lua_next(L, 1) != 0; lua_pop(L, 1))
    names.push_back(shortened(displayed(L, -2)));
  const std::string name = shortened(displayed(L, 2)), nearest = hint(L, name, names);
  throw at_line(L, fmt::format("{} has no '{}'{}", lua_tostring(L, lua_upvalueindex(1)), name, nearest));
}

int unknown_global(lua_State* L) {
  const std::string name = lua_type(L, 2) == LUA_TSTRING ? shortened(displayed(L, 2)) : "?";
  std::vector<std::string> names;
  lua_pushglobaltable(L);
  for (lua_pushnil(L); names.size() < most_names && lua_next(L, -2) != 0; lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) names.push_back(lua_tostring(L, -2));
  for (const char* value : {"ricochet", "true", "false", "nil"}) names.push_back(value);
  lua_Debug frame;  // the local names of every function that is running
  for (int level = 0; level < most_levels && names.size() < most_names && lua_getstack(L, level, &frame); ++level)
    for (int i = 1; const char* local = lua_getlocal(L, &frame, i); ++i, lua_pop(L, 1))
      if (local[0] != '(') names.push_back(local);
  std::string meant = hint(L, name, names);
  if (name == "O" || name == "o") meant = " (did you mean the digit 0?)";
  if (name == "io") meant = " (files are below the run's folder, through ricochet.file)";
  if (meant.empty() && is_choice(name)) meant = fmt::format(" (if the text is meant, write \"{}\")", name);
  if (name == "ricochet") meant = " (begin the script with: local ricochet = require \"ricochet\")";
  throw at_line(L, fmt::format("unknown name '{}'{}", name, meant));
}

int new_global(lua_State* L) {
  const std::string name = shortened(displayed(L, 2));
  throw at_line(L, fmt::format("'{}' is not declared; write: local {} = ...", name, name));
}

// require: the library, then beside the script; never the current directory, never native code. The native part trusts
// its caller (it hands text to gnuplot, which may run anything): only the library's own require gets it.
template <bool by_library>
int require(lua_State* L) {
  Session& session = session_of(L);
  std::size_t length = 0;
  const char* given = luaL_checklstring(L, 1, &length);
  const std::string name(given, length);
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '.' || c == '-';
  });
  if (!plain || name.find("..") != std::string::npos || name.front() == '.')
    throw at_line(L,
                  fmt::format("require: '{}' is no module name; give letters, digits, _ and - with dots between them",
                              name.c_str()));
  if (!by_library && name == "ricochet.core") throw at_line(L, "require: 'ricochet.core' is for the library alone");
  lua_settop(L, 1);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  if (lua_getfield(L, -1, name.c_str()) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  std::string path = name;
  std::replace(path.begin(), path.end(), '.', '/');
  const fs::path beside = session.script.parent_path();
  for (const auto& [file, of_library] : {std::pair(session.library / (path + ".lua"), true),
                                         {session.library / path / "init.lua", true},
                                         {beside / (path + ".lua"), false}}) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) continue;
    const fs::path home = fs::weakly_canonical(file.parent_path() == session.library ? session.library
                                               : beside.empty()                      ? fs::path(".")
                                                                                     : beside,
                                               error),
                   real = fs::weakly_canonical(file, error);
    const bool below = std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first == home.end();
    if (!below && !session.options.unsafe && !of_library)
      throw at_line(
          L, fmt::format(
                 "require: {} is a link that leads out of the script's folder; copy it there (--unsafe lifts this)",
                 file.string()));
    if (std::find(session.loading.begin(), session.loading.end(), name) != session.loading.end())
      throw at_line(L, fmt::format("require: '{}' requires itself, by way of what it requires", name));
    struct Loading {
      std::vector<std::string>& names;
      ~Loading() { names.pop_back(); }
    } loading{session.loading};
    session.loading.push_back(name);
    load_file(L, file, file.string(), of_library);
    lua_call(L, 0, 1);
    if (lua_isnil(L, -1)) {
      lua_pop(L, 1);
      lua_pushboolean(L, true);
    }
    lua_pushvalue(L, -1);
    lua_setfield(L, 2, name.c_str());
    return 1;
  }
  std::vector<std::string> near{"ricochet"};
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(beside.empty() ? fs::path(".") : beside, ignored))
    if (entry.path().extension() == ".lua") near.push_back(entry.path().stem().string());
  throw at_line(L, fmt::format("require: there is no module '{}' in the library or beside the script{}", name,
                               did_you_mean(name, near)));
}

// xpcall(f, handler, ...): the handler runs after the error has unwound. Lua's own runs it inside the hook that ended
// the script, where no hook is called any more, so that a loop in it could not be ended.
int protected_call(lua_State* L) {
  luaL_checktype(L, 2, LUA_TFUNCTION);
  const int arguments = lua_gettop(L) - 2;
  luaL_checkstack(L, arguments + 4, "too many arguments");
  lua_pushvalue(L, 1);
  for (int i = 0; i < arguments; ++i) lua_pushvalue(L, 3 + i);
  const int before = lua_gettop(L) - arguments - 1;
  const bool fine = lua_pcall(L, arguments, LUA_MULTRET, 0) == LUA_OK;
  if (!fine) {
    lua_pushvalue(L, 2);
    lua_insert(L, -2);
    lua_call(L, 1, LUA_MULTRET);
  }
  lua_pushboolean(L, fine);
  lua_insert(L, before + 1);
  return lua_gettop(L) - before;
}

// setmetatable, without finalizers: Lua calls no hook in them either.
int set_metatable(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  if (!lua_isnoneornil(L, 2)) luaL_checktype(L, 2, LUA_TTABLE);
  lua_settop(L, 2);
  if (lua_istable(L, 2)) {
    lua_pushliteral(L, "__gc");
    if (lua_rawget(L, 2) != LUA_TNIL)
      return luaL_error(L, "setmetatable: __gc is not for scripts (--unsafe lifts this)");
    lua_pop(L, 1);
  }
  if (luaL_getmetafield(L, 1, "__metatable") != LUA_TNIL) return luaL_error(L, "cannot change a protected metatable");
  lua_setmetatable(L, 1);
  return 1;
}

// load(text, name, mode, environment), for text only.
int load_text(lua_State* L) {
  std::size_t length = 0;
  const char* text = luaL_checklstring(L, 1, &length);
  const bool environment = lua_gettop(L) >= 4;
  if (std::string(luaL_optstring(L, 3, "t")).find('t') == std::string::npos)
    return luaL_error(L, "load: only text is accepted, mode 't'");
  spend(L, work_a_byte_read * static_cast<double>(length));
  std::string name = luaL_optstring(L, 2, "=(load)");
  if (name.starts_with('@')) name[0] = '=';  // files are what was read from files
  if (load_counted(L, {text, length}, name) == LUA_OK) {
    if (environment) {
      lua_pushvalue(L, 4);
      lua_setupvalue(L, -2, 1);
    }
    return 1;
  }
  stop_if_used_up(L);
  lua_pushnil(L);
  lua_insert(L, -2);
  return 2;
}

void remove(lua_State* L, const char* table, std::initializer_list<const char*> names) {
  lua_getglobal(L, table);
  for (const char* name : names) {
    lua_pushnil(L);
    lua_setfield(L, -2, name);
  }
  lua_pop(L, 1);
}

}  // namespace

void open_sandbox(lua_State* L, bool unsafe) {
  if (unsafe) {
    luaL_openlibs(L);
  } else {
    const luaL_Reg opened[] = {{LUA_GNAME, luaopen_base},        {LUA_COLIBNAME, luaopen_coroutine},
                               {LUA_TABLIBNAME, luaopen_table},  {LUA_OSLIBNAME, luaopen_os},
                               {LUA_STRLIBNAME, luaopen_string}, {LUA_MATHLIBNAME, luaopen_math},
                               {LUA_UTF8LIBNAME, luaopen_utf8}};
    for (const luaL_Reg& library : opened) {
      luaL_requiref(L, library.name, library.func, 1);
      lua_pop(L, 1);
    }
    remove(L, "os", {"execute", "exit", "getenv", "remove", "rename", "setlocale", "tmpname"});
    remove(L, "string", {"dump"});
    for (const char* name : {"dofile", "loadfile", "collectgarbage"}) {
      lua_pushnil(L);
      lua_setglobal(L, name);
    }
    bound_libraries(L);
    lua_register(L, "load", load_text);
    lua_register(L, "xpcall", protected_call);
    lua_register(L, "setmetatable", set_metatable);
    lua_pushliteral(L, "");  // the methods of strings belong to everyone
    lua_getmetatable(L, -1);
    lua_pushboolean(L, false);
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 2);
  }
  lua_register(L, "print", guarded<print>);
  lua_register(L, "require", guarded<require<false>>);
  // The same numbers on every run: Lua seeds its generator from the clock otherwise.
  luaL_loadstring(L, "math.randomseed(1)");
  lua_call(L, 0, 0);
}

namespace {

constexpr const char* libraries[] = {"string", "table", "math", "os", "utf8", "coroutine"};

// A copy of the table on top of the stack.
void push_copy(lua_State* L) {
  lua_newtable(L);
  for (lua_pushnil(L); lua_next(L, -3) != 0;) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, -4);
  }
}

// Before any script runs. Methods of strings are the library's too, and beside them what scripts add to `string`.
void separate_library(lua_State* L) {
  lua_pushglobaltable(L);
  push_copy(L);
  for (const char* name : libraries) {
    lua_getfield(L, -1, name);
    push_copy(L);
    lua_remove(L, -2);
    lua_setfield(L, -2, name);
  }
  lua_pushcfunction(L, guarded<require<true>>);
  lua_setfield(L, -2, "require");
  lua_pushliteral(L, "");
  lua_getmetatable(L, -1);
  lua_getfield(L, -3, "string");
  lua_createtable(L, 0, 1);
  lua_getglobal(L, "string");
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
  lua_setfield(L, -2, "__index");
  lua_pop(L, 2);
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, guarded<unknown_global>);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
  lua_setfield(L, LUA_REGISTRYINDEX, library_environment);
  lua_pop(L, 1);
}

void close_libraries(lua_State* L) {
  for (const char* name : libraries) {
    lua_getglobal(L, name);
    lua_createtable(L, 0, 1);
    lua_pushstring(L, name);
    lua_pushcclosure(L, guarded<unknown_library_function>, 1);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
    lua_pop(L, 1);
  }
}

void close_globals(lua_State* L) {
  lua_pushglobaltable(L);
  lua_createtable(L, 0, 3);
  lua_pushcfunction(L, guarded<unknown_global>);
  lua_setfield(L, -2, "__index");
  lua_pushcfunction(L, guarded<new_global>);
  lua_setfield(L, -2, "__newindex");
  lua_pushboolean(L, false);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
}

}  // namespace

void close_sandbox(lua_State* L) {
  separate_library(L);
  close_libraries(L);
  close_globals(L);
}

}  // namespace ricochet
