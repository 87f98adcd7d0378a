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
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

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

// What the child reports: nothing, or why it is no gnuplot.
struct Failure {
  bool confining;
  int error;
};

// In the child, between fork and exec: only calls that are safe there. Comes back if gnuplot cannot be run.
Failure become_gnuplot(const char* folder, const char* file, char* const* environment, bool confined) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // a run that its time ends leaves no gnuplot behind
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || chdir(folder) != 0) return {false, errno};
  if (confined && !start_no_process()) return {true, errno};
  char name[] = "gnuplot";
  char* const words[] = {name, const_cast<char*>(file), nullptr};
  execvpe(name, words, environment);
  return {false, errno};
}

// This process's, but texts are UTF-8 whatever the user's language: gnuplot warns of "degree sign" otherwise.
std::vector<std::string> environment_of_gnuplot() {
  std::vector<std::string> list;
  for (char** variable = environ; *variable; ++variable)
    if (!std::string_view(*variable).starts_with("LC_ALL=")) list.emplace_back(*variable);
  list.emplace_back("LC_ALL=C.UTF-8");
  return list;
}

FileError cannot_start(int error) {
  if (error == ENOENT) return FileError("gnuplot is not installed; apt-get install gnuplot-nox");
  return FileError(std::string("gnuplot cannot be started: ") + std::strerror(error) +
                   (error == EMFILE || error == ENFILE ? "; raise the limit (ulimit -n)" : ""));
}

}  // namespace

int run_gnuplot(const std::filesystem::path& folder, const std::string& file, bool confined) {
  const std::string place = folder.string();
  std::vector<std::string> variables = environment_of_gnuplot();
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) throw cannot_start(errno);
  const pid_t child = fork();
  const int no_child = errno;
  if (child == 0) {
    const Failure failure = become_gnuplot(place.c_str(), file.c_str(), environment.data(), confined);
    [[maybe_unused]] const auto written = write(report[1], &failure, sizeof failure);
    _exit(127);
  }
  close(report[1]);
  Failure failure{false, 0};
  while (child > 0 && read(report[0], &failure, sizeof failure) < 0 && errno == EINTR) {
  }
  close(report[0]);
  if (child < 0) throw cannot_start(no_child);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (failure.confining)
    throw FileError(
        "this system cannot keep gnuplot from starting programs (seccomp); --unsafe draws plots without that");
  if (failure.error != 0) throw cannot_start(failure.error);
  return status;
}

}  // namespace ricochet
