// Files below the run's folder: ricochet.file, and gnuplot for ricochet.plot.

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "script/objects.hpp"
#include "script/state.hpp"
#include "store/files.hpp"

namespace ricochet {

namespace fs = std::filesystem;

fs::path below_folder(lua_State* L, const std::string& name) {
  const Session& session = session_of(L);
  const fs::path path(name);
  bool plain = !name.empty() && path.is_relative() && name.find('\\') == std::string::npos &&
               name.find('\0') == std::string::npos;
  for (const fs::path& part : path) plain = plain && part != ".." && part != ".";
  if (!plain)
    throw at_line(
        L, fmt::format("'{}' is no name below the run's folder; give a relative name without '..'", name.c_str()));
  // A link inside the folder must not lead out of it.
  const fs::path whole = session.own_folder() / path;
  std::error_code error;
  const fs::path real = fs::weakly_canonical(whole, error), root = fs::weakly_canonical(session.own_folder(), error);
  if (error || std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
    throw FileError(
        at_line(L, fmt::format("'{}' leads out of the run's folder {}", name, session.own_folder().string())).what());
  return whole;
}

namespace {

#if defined(__x86_64__)
constexpr std::uint32_t this_machine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t this_machine = AUDIT_ARCH_AARCH64;
#else
#error "gnuplot is confined by system calls, which are numbered here for x86-64 and ARM only"
#endif

// From here on this process starts no other: what gnuplot's `system` and backquotes would run does not run, should text
// of a script's ever reach gnuplot as a command. False if the system cannot do that. [man 2 seccomp]
bool start_no_process() {
  constexpr std::uint32_t refuse = SECCOMP_RET_ERRNO | EPERM, unknown = SECCOMP_RET_ERRNO | ENOSYS;
  const sock_filter filter[] = {
    BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, this_machine, 1, 0),
    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
    BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
#if defined(__x86_64__)
    BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1),  // the same calls by other numbers
    BPF_STMT(BPF_RET | BPF_K, refuse),
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_fork, 0, 1),
    BPF_STMT(BPF_RET | BPF_K, refuse),
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_vfork, 0, 1),
    BPF_STMT(BPF_RET | BPF_K, refuse),
#endif
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clone3, 0, 1),
    BPF_STMT(BPF_RET | BPF_K, unknown),  // its flags lie in memory; libraries then take clone
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clone, 0, 3),
    BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[0])),
    BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, CLONE_THREAD, 1, 0),
    BPF_STMT(BPF_RET | BPF_K, refuse),
    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{static_cast<unsigned short>(std::size(filter)), const_cast<sock_filter*>(filter)};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// Runs gnuplot on a file in a folder; its status as waitpid gives it. Throws FileError if it cannot be run.
int run_gnuplot(const fs::path& folder, const std::string& file, bool confined) {
  enum : char { not_there = 1, not_confined = 2 };
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) throw FileError("gnuplot cannot be started: no more pipes");
  const pid_t child = fork();
  if (child == 0) {  // only calls that are safe between fork and exec
    char failure = not_there;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // a run that its time ends leaves no gnuplot behind
    const int nothing = open("/dev/null", O_RDONLY);
    if (chdir(folder.c_str()) == 0 && nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0) {
      if (confined && !start_no_process())
        failure = not_confined;
      else
        execlp("gnuplot", "gnuplot", file.c_str(), nullptr);
    }
    [[maybe_unused]] const auto written = write(report[1], &failure, 1);
    _exit(127);
  }
  close(report[1]);
  char failure = 0;
  while (child > 0 && read(report[0], &failure, 1) < 0 && errno == EINTR) {
  }
  close(report[0]);
  if (child < 0) throw FileError("gnuplot cannot be started: no more processes");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (failure == not_there) throw FileError("gnuplot is not installed; apt-get install gnuplot-nox");
  if (failure == not_confined)
    throw FileError(
        "this system cannot keep gnuplot from starting programs (seccomp); --unsafe draws plots without that");
  return status;
}

// gnuplot(name, text): writes NAME.gp into the run's folder and lets gnuplot draw NAME.svg and NAME.png.
int gnuplot(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  const fs::path script = below_folder(L, name + ".gp");
  session.claim(session.own_folder());
  write_atomically(script, luaL_checkstring(L, 2));
  for (const char* kind : {".png", ".svg"}) {  // gnuplot would write through a link
    const fs::path picture = fs::path(script).replace_extension(kind);
    if (fs::is_symlink(picture)) fs::remove(picture);
  }
  const int status = run_gnuplot(script.parent_path(), "./" + script.filename().string(), !session.options.unsafe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw FileError(fmt::format("gnuplot could not draw {} (its message stands above)", script.string()));
  const fs::path picture = fs::path(script).replace_extension(".png");
  if (!fs::exists(picture))
    throw FileError(fmt::format("gnuplot has not drawn {}; is the gnuplot in PATH the real one?", picture.string()));
  session.print(fmt::format("plot: {}\n", picture.string()));
  return 0;
}

// Files that cannot be read or written are named at the script's line.
template <class Work>
void at_script(lua_State* L, Work work) {
  try {
    work();
  } catch (const FileError& error) {
    throw FileError(at_line(L, error.what()).what());
  }
}

int file_write(lua_State* L) {
  Session& session = session_of(L);
  std::size_t length = 0;
  const char* given = luaL_checklstring(L, 1, &length);
  const std::string name(given, length);
  const fs::path path = below_folder(L, name);
  if (is_of_the_run(name))
    throw at_line(L, fmt::format("'{}' is the name of a file that runs leave themselves; give another", name));
  const char* text = luaL_checklstring(L, 2, &length);
  if (session.options.check) return 0;
  session.claim(session.own_folder());
  at_script(L, [&] {
    make_folder(path.parent_path());
    write_atomically(path, {text, length});
  });
  return 0;
}

int file_read(lua_State* L) {
  std::size_t length = 0;
  const char* name = luaL_checklstring(L, 1, &length);
  const fs::path path = below_folder(L, {name, length});
  std::string text;
  at_script(L, [&] { text = read_file(path); });
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

}  // namespace

void add_run_files(lua_State* L) {
  const luaL_Reg list[] = {
      {"gnuplot", guarded<gnuplot>}, {"file_write", guarded<file_write>}, {"file_read", guarded<file_read>}};
  for (const luaL_Reg& f : list) {
    lua_pushcfunction(L, f.func);
    lua_setfield(L, -2, f.name);
  }
}

}  // namespace ricochet
