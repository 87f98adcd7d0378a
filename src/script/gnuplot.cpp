#include "script/gnuplot.hpp"

#include <fcntl.h>
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
#include <iterator>

#include "core/error.hpp"

namespace ricochet {
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

enum Failure : char { none = 0, not_there, not_confined };

// In the child, between fork and exec: only calls that are safe there. Comes back if gnuplot cannot be run.
Failure become_gnuplot(const std::filesystem::path& folder, const std::string& file, bool confined) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // a run that its time ends leaves no gnuplot behind
  const int nothing = open("/dev/null", O_RDONLY);
  if (chdir(folder.c_str()) != 0 || nothing < 0 || dup2(nothing, STDIN_FILENO) < 0) return not_there;
  if (confined && !start_no_process()) return not_confined;
  execlp("gnuplot", "gnuplot", file.c_str(), nullptr);
  return not_there;
}

}  // namespace

int run_gnuplot(const std::filesystem::path& folder, const std::string& file, bool confined) {
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) throw FileError("gnuplot cannot be started: no more pipes");
  const pid_t child = fork();
  if (child == 0) {
    const char failure = become_gnuplot(folder, file, confined);
    [[maybe_unused]] const auto written = write(report[1], &failure, 1);
    _exit(127);
  }
  close(report[1]);
  char failure = none;
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

}  // namespace ricochet
