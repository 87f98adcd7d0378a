// Loaded before the system's library (LD_PRELOAD): calls that fail as a broken machine's would, as $FAULT asks.
// FAULT=write   what goes to a regular file or a pipe is never taken: write() returns 0
// FAULT=flock   locks are granted to everyone, as on some network file systems
// FAULT=enolck, enosys, eopnotsupp   locks are refused so: NFS without its daemon, Lustre mounted without them
// FAULT=open    files and folders whose path contains $FAULT_PATH cannot be opened: an error of the disk
// FAULT=twin    when a file is to be renamed to a path that contains $FAULT_PATH, another process has done so before
// FAULT=sin     a mathematics library that gives NaN
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace {

bool asked(const char* fault) {
  const char* wanted = std::getenv("FAULT");
  return wanted && std::strcmp(wanted, fault) == 0;
}

bool refused(const char* path) {
  const char* part = std::getenv("FAULT_PATH");
  if (!asked("open") || !part || !std::strstr(path, part)) return false;
  errno = EIO;
  return true;
}

template <typename Call>
Call next(const char* name) {
  return reinterpret_cast<Call>(dlsym(RTLD_NEXT, name));
}

double sine(const char* name, double x) {
  return asked("sin") ? std::numeric_limits<double>::quiet_NaN() : next<double (*)(double)>(name)(x);
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t count) {
  if (descriptor != STDERR_FILENO && asked("write")) return 0;
  return syscall(SYS_write, descriptor, bytes, count);
}

int flock(int descriptor, int operation) noexcept {
  if (asked("flock")) return 0;
  errno = asked("enolck") ? ENOLCK : asked("enosys") ? ENOSYS : asked("eopnotsupp") ? EOPNOTSUPP : 0;
  return errno != 0 ? -1 : static_cast<int>(syscall(SYS_flock, descriptor, operation));
}

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return refused(path) ? -1 : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int open64(const char* path, int flags, ...) __attribute__((alias("open")));  // offsets have 64 bits

int rename(const char* from, const char* to) noexcept {
  const char* part = std::getenv("FAULT_PATH");
  if (asked("twin") && part && std::strstr(to, part)) syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to);
  return static_cast<int>(syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to));
}

std::FILE* fopen(const char* path, const char* mode) {
  return refused(path) ? nullptr : next<std::FILE* (*)(const char*, const char*)>("fopen")(path, mode);
}

std::FILE* fopen64(const char* path, const char* mode) {
  return refused(path) ? nullptr : next<std::FILE* (*)(const char*, const char*)>("fopen64")(path, mode);
}

double sin(double x) noexcept { return sine("sin", x); }
double cos(double x) noexcept { return sine("cos", x); }
void sincos(double x, double* s, double* c) noexcept {
  *s = sine("sin", x);
  *c = sine("cos", x);
}

}  // extern "C"
