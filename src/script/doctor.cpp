#include "script/doctor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "script/processor.hpp"
#include "script/session.hpp"
#include "script/state.hpp"
#include "script/terminal.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// e of `impact` below. A change of physics changes it, as it does the hashes of tests/impact/test_same_bits.cpp.
constexpr const char* golden_e = "0x1.07548b62f2ecep+0";

constexpr const char* impact = R"(
local ricochet = require "ricochet"
local scene = ricochet.scene { projectile = ricochet.disk { nodes = 60, placement = "triangular" },
  target = ricochet.wall { nodes = 150, width = 4, depth = 1.5, stiffness = 400, placement = "triangular" },
  launch = { psi1 = 1 } }
)";

struct Trial {
  const char* what;
  bool needed;
  const char* script;  // raises an error if it does not work
};

constexpr Trial trials[] = {
    {"Lua and its library", true, "local ricochet = require 'ricochet'"},
    {"an impact", true, "assert(scene:run().status == 'finished', 'it does not finish')"},
    {"its bits", true,
     "local e = string.format('%a', scene:run().e)\n"
     "assert(e == golden, 'e is ' .. e .. ' and should be ' .. golden .. '; rows of this machine differ from those of "
     "others in their last digits: please report the processor')"},
    {"a sweep, its rows stored (HDF5, CSV)", true,
     "local rows = ricochet.sweep { name = 'rows', over = { sample = { 1 } }, scene = function(at) return scene end "
     "}:run()\nassert(#rows == 1, 'a row is missing')"},
    {"pictures (OSMesa, font)", false, "ricochet.still { scene = scene, out = 'still', size = { 64, 48 } }"},
    {"plots (gnuplot)", false,
     "ricochet.plot { x = 'a', y = { 'b' }, name = 'plot', theory = { b = { { 1, 1 }, { 2, 3 } } } }"},
    {"films (ffmpeg)", false, "ricochet.animate { scene = scene, frames = 2, film = 'film.mp4', size = { 64, 48 } }"},
};

// Errors of the trial's own text are told without its place.
std::string without_place(std::string message) {
  if (message.starts_with("repl:")) message.erase(0, message.find(": ") + 2);
  return message.substr(0, message.find('\n'));
}

std::string trouble_with(const Trial& trial, const fs::path& folder, const std::string& golden) {
  RunOptions options;
  options.out = folder.string();
  options.quiet = options.fresh = true;
  try {
    Session session(options, "doctor", {});
    State state(session);
    state.run_text(fmt::format("local golden = '{}'\n{}{}", golden, impact, trial.script));
  } catch (const std::exception& error) {
    return without_place(error.what());
  }
  return "";
}

// Two runs never write into one folder.
std::string trouble_with_locks(const fs::path& folder) {
  try {
    const FolderLock held(folder);
    try {
      const FolderLock again(folder);
    } catch (const FileError&) {
      return "";
    }
  } catch (const std::exception& error) {
    return error.what();
  }
  return fmt::format("{} cannot be locked; do not let two runs write there at a time", folder.string());
}

std::string trouble_with_disk(const fs::path& folder) {
  constexpr double enough = 1e8;  // bytes
  try {
    make_folder(folder);
    write_atomically(folder / "note", "x");
    if (read_file(folder / "note") != "x") return "what is written does not come back";
    const auto free = static_cast<double>(fs::space(folder).available);
    return free < enough ? fmt::format("only {:.0f} MB are free; long sweeps and films need more", free / 1e6) : "";
  } catch (const std::exception& error) {
    return as_error(error).what();
  }
}

}  // namespace

std::vector<Finding> examined(const std::string& out, const std::string& golden) {
  const fs::path folder = fs::path(out) / fmt::format("ricochet-doctor-{}", getpid());
  std::vector<Finding> findings{{fmt::format("writing into {}", out), trouble_with_disk(folder), true}};
  if (!findings[0].trouble.empty()) return findings;
  findings.push_back({"locks on folders", trouble_with_locks(folder), false});
  for (const Trial& trial : trials) findings.push_back({trial.what, trouble_with(trial, folder, golden), trial.needed});
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  fs::remove(out, ignored);  // if nothing else is in it
  return findings;
}

bool examine() {
  putf("{}\nprocessor: {}\n", version_text(), processor_name());
  bool able = true;
  for (const Finding& finding : examined(RunOptions{}.out, golden_e)) {
    putf("{:<8} {}{}\n", finding.trouble.empty() ? "works" : "FAILS", finding.what,
         finding.trouble.empty() ? "" : ": " + finding.trouble);
    able = able && (finding.trouble.empty() || !finding.needed);
  }
  return able;
}

}  // namespace ricochet
