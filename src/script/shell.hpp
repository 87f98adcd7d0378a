#pragma once
// What goes to a shell, and what comes back.

#include <string>
#include <vector>

namespace ricochet {

/// A word as a shell takes it.
std::string shell_words(const std::string& word);
std::string shell_words(const std::vector<std::string>& words);

/// A program's exit status, 127 if there is none of this name, and what it said.
struct Answer {
  int status;
  std::string text;
};

/// Runs a program to its end.
Answer ask(const std::vector<std::string>& words);

}  // namespace ricochet
