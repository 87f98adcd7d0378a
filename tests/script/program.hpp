#pragma once
// Runs the program as a user does.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace ricochet::test {

namespace fs = std::filesystem;

struct Ended {
  int status;
  std::string out, err;
  std::string first_line() const { return err.substr(0, err.find('\n')); }
};

/// A folder of its own, removed at the end.
class Workplace {
 public:
  Workplace() {
    static std::atomic<int> count = 0;
    path = fs::temp_directory_path() / ("ricochet_test_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    fs::create_directories(path);
  }
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((path / name).parent_path());
    std::ofstream(path / name) << text;
  }
  std::string read(const fs::path& name) const {
    std::ifstream file(path / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// Runs a shell command here; `ricochet` is the program.
  Ended shell(const std::string& command) const {
    const std::string whole = "cd '" + path.string() + "' && ricochet() { '" + RICOCHET_PROGRAM + "' \"$@\"; } && { " +
                              command + "\n} >out.txt 2>err.txt </dev/null";
    const int status = std::system(whole.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read("out.txt"), read("err.txt")};
  }
  Ended run(const std::string& arguments) const { return shell("ricochet run " + arguments); }
  /// Runs a script's text, called s.lua.
  Ended script(const std::string& text, const std::string& arguments = "") const {
    write("s.lua", text);
    return run("s.lua " + arguments);
  }

  fs::path path;
};

/// Starts the program here in the background, silent; its process.
inline pid_t start(const Workplace& here, const std::vector<std::string>& arguments) {
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(here.path.c_str()) != 0) _exit(99);
  const int null = open("/dev/null", O_WRONLY);
  dup2(null, 1);
  dup2(null, 2);
  std::vector<char*> words{const_cast<char*>(RICOCHET_PROGRAM)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(RICOCHET_PROGRAM, words.data());
  _exit(99);
}

/// The exit status of a process that was started, or minus the signal that ended it.
inline int ended(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// The line of the output that begins with "bits: "; nothing of a run that failed.
inline std::string bits_of(const Ended& run) {
  const std::size_t from = run.status == 0 ? run.out.find("bits: ") : std::string::npos;
  return from == std::string::npos ? "" : run.out.substr(from, run.out.find('\n', from) - from);
}

/// Before a command: the machine is broken in a way that tests/script/faults.cpp knows.
inline std::string with_fault(const std::string& fault, const std::string& path = "") {
  return "export LD_PRELOAD='" RICOCHET_FAULTS "' FAULT=" + fault + " FAULT_PATH='" + path + "'; ";
}

/// Sanitizers want to be loaded before all others.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool machine_can_be_broken = false;
#else
inline constexpr bool machine_can_be_broken = true;
#endif

/// Runs a script that has the module as `ricochet`, in a folder of its own.
inline Ended script_with_module(const std::string& text) {
  const Workplace here;
  return here.script("local ricochet = require \"ricochet\"\n" + text);
}

/// A sweep of small scenes: 4 samples, 3 angles, some tenths of a second.
inline const char* small_sweep = R"(local ricochet = require "ricochet"
local p = ricochet.parameters { samples = { 4, int = true, min = 1, doc = "lattices" } }
local rows = ricochet.sweep {
  name = "s",
  over = { sample = ricochet.range(p.samples), psi1 = { 0, 1, 4 } },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = 60, roughness = 0.03, seed = at.sample },
      target = ricochet.wall { width = 4, depth = 1.5, nodes = 150, stiffness = 400, roughness = 0.03, seed = at.sample },
      launch = { psi1 = at.psi1 },
    }
  end,
}:run()
rows:summary { by = "psi1", of = { "e", "mu" } }:print()
)";

}  // namespace ricochet::test
