#include "script/shell.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string_view>

#include "core/error.hpp"

namespace ricochet {

std::string shell_words(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string shell_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + shell_words(word);
  return text;
}

namespace {

/// A file of no name for what a program says.
class Said {
 public:
  Said() : file_(std::tmpfile()) {
    if (!file_) throw FileError("no temporary file can be made in /tmp; free some space there");
  }
  Said(const Said&) = delete;
  Said& operator=(const Said&) = delete;
  ~Said() { std::fclose(file_); }

  int descriptor() const { return fileno(file_); }
  /// Without line ends at its end.
  std::string text() const {
    std::rewind(file_);
    std::string text;
    char part[4096];
    for (std::size_t count = 0; (count = std::fread(part, 1, sizeof part, file_)) > 0;) text.append(part, count);
    while (text.ends_with('\n')) text.pop_back();
    return text;
  }

 private:
  std::FILE* file_;
};

// Its exit status as a shell has it.
int status_of(const std::vector<std::string>& words, const Said& out, const Said& err) {
  std::vector<char*> list;
  for (const std::string& word : words) list.push_back(const_cast<char*>(word.c_str()));
  list.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.descriptor(), STDERR_FILENO);
  pid_t process = 0;
  const int error = posix_spawnp(&process, list[0], &actions, nullptr, list.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return 127;
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Answer ask(const std::vector<std::string>& words) {
  const Said out, err;
  const int status = status_of(words, out, err);
  return {status, out.text(), err.text()};
}

}  // namespace ricochet
