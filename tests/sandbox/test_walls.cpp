// The sandbox by itself: no module, no scene, no session.

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>

#include "sandbox/sandbox.hpp"

using namespace ricochet;

namespace {

std::map<std::string, std::string> sources;

Surroundings nothing_but_lua(bool unsafe) {
  return {.unsafe = unsafe,
          .library = "nowhere",
          .script = "s.lua",
          .native = "core",
          .sources = sources,
          .read =
              [](const std::filesystem::path& path) {
                std::ifstream file(path);
                return std::string(std::istreambuf_iterator<char>(file), {});
              },
          .where = [](lua_State*) { return std::string("s.lua:1"); },
          .at_line = [](lua_State*, const std::string& message) { return Error("s.lua:1: " + message); },
          .syntax_error = [](const std::string&, const std::string&, const std::string& m) { return Error(m); },
          .meaning = [](const std::string&, const std::string& nearest) { return nearest; }};
}

struct Lua {
  explicit Lua(bool unsafe = false) : sandbox(nothing_but_lua(unsafe)) { sandbox.close(); }

  /// The text's value as a text, or the error's message.
  std::string operator()(const std::string& text) {
    lua_State* L = sandbox.L;
    lua_settop(L, 0);
    if (luaL_loadstring(L, text.c_str()) == LUA_OK) lua_pcall(L, 0, 1, 0);
    return luaL_tolstring(L, -1, nullptr);
  }

  Sandbox sandbox;
};

}  // namespace

TEST_CASE("what is behind the walls is unknown to scripts") {
  Lua lua;
  for (const char* name : {"io", "debug", "package", "dofile", "loadfile", "collectgarbage"})
    CHECK(lua(std::string("return ") + name).starts_with("s.lua:1: unknown name '" + std::string(name) + "'"));
  for (const char* name : {"execute", "exit", "getenv", "remove", "rename", "setlocale", "tmpname"})
    CHECK(lua(std::string("return os.") + name).starts_with("s.lua:1: os has no '" + std::string(name) + "'"));
  CHECK(lua("return string.dump").starts_with("s.lua:1: string has no 'dump'"));
  CHECK(lua("x = 1") == "s.lua:1: 'x' is not declared; write: local x = ...");
  CHECK(lua("return require 'core'") == "s.lua:1: require: 'core' is for the library alone");
  CHECK(lua("return require '../x'").starts_with("s.lua:1: require: '../x' is no module name"));
  CHECK_THAT(lua("setmetatable({}, { __gc = print })"), Catch::Matchers::Contains("__gc is not for scripts"));
  CHECK(lua("return getmetatable('')") == "false");
  CHECK(lua("return getmetatable(_G)") == "false");
}

TEST_CASE("load takes text alone, as Lua's own does: with a name, a mode and an environment") {
  Lua lua;
  CHECK(lua("return load('return 1 + 1')()") == "2");
  CHECK(lua("return load('return x', 'name', 't', { x = 3 })()") == "3");
  CHECK_THAT(lua("return load('return x', 'name', 't', nil)()"), Catch::Matchers::Contains("upvalue '_ENV'"));
  CHECK_THAT(lua("return select(2, load('retrun 1', '@s.lua'))"), Catch::Matchers::StartsWith("s.lua:1: "));
  CHECK(lua("return (load('\\27Lua'))") == "nil");
  for (const char* refused : {"load(string.char(27), 'x', 'b')", "load(function() end)"})
    CHECK_THAT(lua(refused), Catch::Matchers::Contains("only text is accepted"));
}

TEST_CASE("strings keep their methods, whatever a script makes of string") {
  Lua lua;
  CHECK(lua("string.upper = string.lower string.twice = function(s) return s .. s end return ('Ab'):upper():twice()") ==
        "ABAB");
}

TEST_CASE("coroutines work as Lua's own, and their errors name the line that resumes them") {
  Lua lua;
  CHECK(
      lua("local f = coroutine.wrap(function(a) local b = coroutine.yield(a + 1) return a * b end) f(2) return f(5)") ==
      "10");
  CHECK(lua("local c = coroutine.create(function(...) return select('#', ...) end) return select(2, "
            "coroutine.resume(c, 1, nil, nil))") == "3");
  CHECK_THAT(lua("local f = coroutine.wrap(function() error('oops') end)\nf()"),
             Catch::Matchers::Contains("]:2: ") && Catch::Matchers::Contains("oops"));
  CHECK(lua("local closed local c = coroutine.create(function() local x <close> = setmetatable({}, { __close = "
            "function() closed = true end }) coroutine.yield() end) coroutine.resume(c) coroutine.close(c) return "
            "closed") == "true");
  CHECK_THAT(lua("return coroutine.wrap(1)"), Catch::Matchers::Contains("bad argument #1 to 'wrap'"));
  CHECK_THAT(lua("return coroutine.resume(1)"), Catch::Matchers::Contains("bad argument #1 to 'resume'"));
}

TEST_CASE("Lua's memory has a bound, which does no harm to what comes after") {
  Lua lua;
  // One string just below 2 GiB, beside what is there already: refused before it is filled.
  CHECK_THAT(lua("return ('x'):rep(2 ^ 31 - 2 | 0)"), Catch::Matchers::Contains("not enough memory"));
  CHECK(lua.sandbox.refused_at == "s.lua:1");
  CHECK(lua("return #('x'):rep(1000)") == "1000");
}

#ifndef __SANITIZE_THREAD__  // which holds signals back where nothing of its own is called
TEST_CASE("the clock stops what runs, and nothing that catches it goes on") {
  Lua lua;
  {
    const Clock clock(lua.sandbox.L, 0.5, "s.lua");
    CHECK(Clock::time_is_up().empty());
    CHECK(lua("local n = 0 for i = 1, 1000 do n = n + i end return n") == "500500");
    const char* stubborn = "while true do pcall(coroutine.wrap(function() while true do end end)) end";
    CHECK(lua(stubborn) == "interrupted");
    CHECK(lua("return 1") == "interrupted");
    CHECK(Clock::time_is_up() == "script stopped: --max-seconds 0.5 reached at s.lua:1");
  }
  stop_requested = false;
  CHECK(Lua()("return 1") == "1");
}
#endif
