#include "sandbox/sandbox.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "core/spelling.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_memory = std::size_t{2} << 30;        // bytes
constexpr const char* library_environment = "ricochet.library";  // in the registry: the library's globals

// Called from within Lua: only what allocates none of its memory.
void* allocate(void* opaque, void* block, std::size_t old_size, std::size_t size) {
  Sandbox& sandbox = *static_cast<Sandbox*>(opaque);
  const std::size_t before = block ? old_size : 0;
  if (size == 0) {
    std::free(block);
    sandbox.used -= before;
    return nullptr;
  }
  if (size > before && sandbox.used + (size - before) > most_memory) {
    sandbox.refused_at = sandbox.given.where(sandbox.L);
    return nullptr;
  }
  void* result = std::realloc(block, size);
  if (result) sandbox.used += size - before;
  return result;
}

// setmetatable, without finalizers: Lua calls no hook in them.
int set_metatable(lua_State* L) {
  if (lua_istable(L, 2)) {
    lua_pushliteral(L, "__gc");
    if (lua_rawget(L, 2) != LUA_TNIL)
      return luaL_error(L, "setmetatable: __gc is not for scripts (--unsafe lifts this)");
    lua_pop(L, 1);
  }
  return original(L);
}

// unknown(table, name, library): an error with the nearest name, not nil; of the globals if no library is named.
int unknown(lua_State* L) {
  constexpr int most_levels = 100;  // each costs as many steps as it is deep
  lua_settop(L, 3);
  const Surroundings& given = sandbox_of(L).given;
  const std::string name = luaL_tolstring(L, 2, nullptr);
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) names.push_back(lua_tostring(L, -2));
  if (const char* library = lua_tostring(L, 3))
    throw given.at_line(L, fmt::format("{} has no '{:.100}'{}", library, name, did_you_mean(name, names)));
  names.insert(names.end(), {"true", "false", "nil"});
  lua_Debug frame;  // the local names of every function that is running
  for (int level = 0; level < most_levels && lua_getstack(L, level, &frame); ++level)
    for (int i = 1; const char* local = lua_getlocal(L, &frame, i); ++i, lua_pop(L, 1))
      if (local[0] != '(') names.push_back(local);
  throw given.at_line(L, fmt::format("unknown name '{:.100}'{}", name, given.meaning(name, did_you_mean(name, names))));
}

int new_global(lua_State* L) {
  const std::string name = luaL_tolstring(L, 2, nullptr);
  throw sandbox_of(L).given.at_line(L, fmt::format("'{0:.100}' is not declared; write: local {0:.100} = ...", name));
}

struct Module {
  fs::path file;
  bool of_library;
};

Error no_such_module(lua_State* L, const std::string& name, const fs::path& beside) {
  const Surroundings& given = sandbox_of(L).given;
  std::error_code error;
  std::vector<std::string> near;
  for (const fs::path& folder : {given.library, beside})
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".lua" || fs::exists(entry.path() / "init.lua", error))
        near.push_back(entry.path().stem().string());
  return given.at_line(L, fmt::format("require: there is no module '{}' in the library or beside the script{}", name,
                                      did_you_mean(name, near)));
}

// The library, then beside the script; never the current directory.
Module find_module(lua_State* L, const std::string& name) {
  const Surroundings& given = sandbox_of(L).given;
  std::string path = name;
  std::replace(path.begin(), path.end(), '.', '/');
  const fs::path beside = given.script.parent_path();
  std::error_code error;
  for (const fs::path& file : {given.library / (path + ".lua"), given.library / path / "init.lua"})
    if (fs::is_regular_file(file, error)) return {file, true};
  const fs::path file = beside / (path + ".lua"), folder = beside.empty() ? "." : beside;
  if (!fs::is_regular_file(file, error)) throw no_such_module(L, name, folder);
  const fs::path home = fs::weakly_canonical(folder, error), real = fs::weakly_canonical(file, error);
  if (!given.unsafe && std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first != home.end())
    throw given.at_line(
        L,
        fmt::format("require: {} is a link that leads out of the script's folder; copy it there (--unsafe lifts this)",
                    file.string()));
  return {file, false};
}

// Leaves what the module's file returns on the stack.
void run_module(lua_State* L, const std::string& name, const Module& module) {
  Sandbox& sandbox = sandbox_of(L);
  if (std::find(sandbox.loading.begin(), sandbox.loading.end(), name) != sandbox.loading.end())
    throw sandbox.given.at_line(L, fmt::format("require: '{}' requires itself, by way of what it requires", name));
  struct Loading {
    std::vector<std::string>& names;
    ~Loading() { names.pop_back(); }
  } loading{sandbox.loading};
  sandbox.loading.push_back(name);
  load_file(L, module.file, module.file.string(), module.of_library);
  lua_call(L, 0, 1);
  if (!lua_isnil(L, -1)) return;
  lua_pop(L, 1);
  lua_pushboolean(L, true);
}

// require, as scripts or as the library have it.
template <bool by_library>
int require(lua_State* L) {
  const Surroundings& given = sandbox_of(L).given;
  std::size_t length = 0;
  const char* text = luaL_checklstring(L, 1, &length);
  const std::string name(text, length);
  const bool plain = std::all_of(name.begin(), name.end(),
                                 [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.' || c == '-'; });
  if (!plain || name.empty() || name.find("..") != std::string::npos || name.front() == '.')
    throw given.at_line(L, fmt::format("require: '{}' is no module name; give letters, digits, _ and - with dots "
                                       "between them",
                                       text));
  if (!by_library && name == given.native)
    throw given.at_line(L, fmt::format("require: '{}' is for the library alone", name));
  lua_settop(L, 1);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  if (lua_getfield(L, -1, text) != LUA_TNIL) return 1;
  run_module(L, name, find_module(L, name));
  lua_pushvalue(L, -1);
  lua_setfield(L, 2, text);
  return 1;
}

void open_libraries(lua_State* L, bool unsafe) {
  if (unsafe) return luaL_openlibs(L);
  for (const luaL_Reg& library : {luaL_Reg{LUA_GNAME, luaopen_base},
                                  {LUA_COLIBNAME, luaopen_coroutine},
                                  {LUA_TABLIBNAME, luaopen_table},
                                  {LUA_OSLIBNAME, luaopen_os},
                                  {LUA_STRLIBNAME, luaopen_string},
                                  {LUA_MATHLIBNAME, luaopen_math},
                                  {LUA_UTF8LIBNAME, luaopen_utf8}})
    luaL_requiref(L, library.name, library.func, 1);
  lua_settop(L, 0);
  lua_getglobal(L, "setmetatable");
  lua_pushcclosure(L, set_metatable, 1);
  lua_setglobal(L, "setmetatable");
}

constexpr const char* walls = R"lua(
local safe, unknown, new_global, require_by_library = ...
local setmetatable, type, error, gsub, find, load_any = setmetatable, type, error, string.gsub, string.find, load
local libraries = { "string", "table", "math", "os", "utf8", "coroutine" }
local function copy(t)
  local result = {}
  for k, v in pairs(t) do result[k] = v end
  return result
end

math.randomseed(1)  -- the same numbers on every run: Lua seeds its generator from the clock otherwise
if safe then
  for _, f in ipairs { "execute", "exit", "getenv", "remove", "rename", "setlocale", "tmpname" } do os[f] = nil end
  string.dump, dofile, loadfile, collectgarbage = nil
  function load(text, name, mode, ...)
    if type(text) ~= "string" or mode and not find(mode, "t") then error("load: only text is accepted, mode 't'", 2) end
    local own_name = gsub(name or "=(load)", "^@", "=")  -- files are what was read from files
    return load_any(text, own_name, "t", ...)
  end
end

-- Functions of the library's own, before any script runs. Methods of strings are the library's too, and with them what
-- scripts add to `string`.
local library, methods = copy(_G), getmetatable("")
for _, name in ipairs(libraries) do library[name] = copy(_G[name]) end
library.require = require_by_library
methods.__index = setmetatable(library.string, { __index = string })
if safe then methods.__metatable = false end
setmetatable(library, { __index = unknown })

for _, name in ipairs(libraries) do
  setmetatable(_G[name], { __index = function(t, k) return unknown(t, k, name) end })
end
setmetatable(_G, { __index = unknown, __newindex = new_global, __metatable = false })
return library
)lua";

}  // namespace

Sandbox::Sandbox(Surroundings surroundings) : given(std::move(surroundings)), L(lua_newstate(allocate, this)) {
  if (!L) throw Error("no memory for Lua");
  open_libraries(L, given.unsafe);
  open_coroutines(L);
  lua_register(L, "require", guarded<require<false>>);
}

Sandbox::~Sandbox() { lua_close(L); }

void Sandbox::close() {
  luaL_loadbufferx(L, walls, std::char_traits<char>::length(walls), "=walls", "t");
  lua_pushboolean(L, !given.unsafe);
  for (const lua_CFunction f : {guarded<unknown>, guarded<new_global>, guarded<require<true>>}) lua_pushcfunction(L, f);
  lua_call(L, 4, 1);
  lua_setfield(L, LUA_REGISTRYINDEX, library_environment);
}

void load_file(lua_State* L, const fs::path& path, const std::string& name, bool of_library) {
  const Surroundings& given = sandbox_of(L).given;
  std::string text = given.read(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // a byte order mark, which some editors write
  if (text.starts_with("#!")) text.insert(0, "--");        // a first line for the shell
  given.sources[name] = text;
  if (luaL_loadbufferx(L, text.data(), text.size(), ("@" + name).c_str(), "t") != LUA_OK) {
    if (text.starts_with("\x1bLua")) throw Error(name + ": bytecode is not accepted; give the script's text");
    throw given.syntax_error(name, text, lua_tostring(L, -1));
  }
  if (!of_library) return;
  lua_getfield(L, LUA_REGISTRYINDEX, library_environment);
  lua_setupvalue(L, -2, 1);
}

Sandbox& sandbox_of(lua_State* L) {
  void* sandbox = nullptr;
  lua_getallocf(L, &sandbox);
  return *static_cast<Sandbox*>(sandbox);
}

}  // namespace ricochet
