#include "script/terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace ricochet {
namespace {

int lost = 0;  // the error of the first text of put() that was lost

// 0, or why not all was written.
int write_whole(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written > 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0) {
      return EIO;
    } else if (errno == EAGAIN) {  // the terminal or pipe was made not to wait
      pollfd ready{descriptor, POLLOUT, 0};
      poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace

void put(std::string_view text) {
  if (lost != 0) return;
  int error = std::fflush(stdout) == 0 ? 0 : errno;  // of io.write, with --unsafe
  if (error == 0) error = write_whole(STDOUT_FILENO, text);
  if (error != 0) lost = error;
}

void say(std::string_view text) { write_whole(STDERR_FILENO, text); }

std::string complaint(std::string message) {
  constexpr std::size_t most = 20000;
  message.resize(message.find_last_not_of('\n') + 1);
  if (message.size() > most)
    message = message.substr(0, most) + fmt::format("... ({} bytes more)", message.size() - most);
  return "error: " + message + "\n";
}

std::string output_lost() {
  if (lost == 0 && std::fflush(stdout) != 0) lost = errno;
  return lost == 0 || lost == EPIPE ? "" : std::strerror(lost);
}

void open_standard_descriptors() {
  // Opened the wrong way round: what is written there fails as if it still were closed.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
      open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace ricochet
