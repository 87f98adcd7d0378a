// The script reader: any text, run with --check and so many instructions, ends in an error or not at all; nothing
// crashes, leaks or hangs.

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/error.hpp"
#include "script/state.hpp"

namespace {

constexpr int looked_after = 1000;
int instructions_left = 0;  // of all coroutines

void count(lua_State* L, lua_Debug*) {
  if ((instructions_left -= looked_after) > 0) return;
  lua_sethook(L, count, LUA_MASKCOUNT, 1);
  luaL_error(L, "too many instructions");
}

// Lua's own functions may take as long as they like over one call. What is looked for here is ours.
bool may_wait_for_lua(std::string_view text) {
  for (const char* word : {"xpcall", "close", "rep(", "find", "match", "gsub", "pack", "utf8", "move", "insert",
                           "remove", "concat", "sort"})
    if (text.find(word) != std::string_view::npos) return true;
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ricochet;
  if (may_wait_for_lua({reinterpret_cast<const char*>(data), size})) return 0;
  static const std::filesystem::path folder = [] {
    std::filesystem::path made = std::filesystem::temp_directory_path() / ("ricochet_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
  const std::filesystem::path script = folder / "s.lua";
  {
    std::ofstream file(script, std::ios::binary);
    // Most texts are to come past the first line.
    if (size > 0 && data[0] % 4 != 0) file << "local ricochet = require \"ricochet\"\n";
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  RunOptions options;
  options.check = true;
  options.quiet = true;
  options.out = (folder / "out").string();
  options.threads = 1;
  try {
    Session session(options, script, {});
    State state(session);
    instructions_left = 100'000;
    lua_sethook(state.lua(), count, LUA_MASKCOUNT, looked_after);
    state.run_script();
  } catch (const Error&) {  // one clear error: as it should be
  }
  if (std::filesystem::exists(folder / "out")) __builtin_trap();  // a check writes nothing
  return 0;
}
