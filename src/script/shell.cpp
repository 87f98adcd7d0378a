#include "script/shell.hpp"

#include <sys/wait.h>

#include <cstdio>
#include <memory>
#include <string_view>

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

Answer ask(const std::vector<std::string>& words) {
  std::FILE* pipe = popen((shell_words(words) + " 2>&1 </dev/null").c_str(), "r");
  if (!pipe) return {127, ""};
  std::string text;
  char part[4096];
  for (std::size_t count = 0; (count = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, count);
  const int status = pclose(pipe);
  while (text.ends_with('\n')) text.pop_back();
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, text};
}

}  // namespace ricochet
