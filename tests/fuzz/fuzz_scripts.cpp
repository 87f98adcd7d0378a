// The script reader: any text, run with --check and a budget, ends in an error or not at all; nothing crashes, leaks or
// hangs.

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/error.hpp"
#include "script/state.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ricochet;
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
  options.budget = 100'000;
  options.out = (folder / "out").string();
  options.threads = 1;
  try {
    Session session(options, script, {});
    State state(session);
    state.run_script();
  } catch (const Error&) {  // one clear error: as it should be
  }
  if (std::filesystem::exists(folder / "out")) __builtin_trap();  // a check writes nothing
  return 0;
}
