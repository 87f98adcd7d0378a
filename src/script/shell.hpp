#pragma once
// What goes to a shell, and what comes back.

#include <string>
#include <vector>

namespace ricochet {

/// A word as a shell takes it.
std::string shell_words(const std::string& word);
std::string shell_words(const std::vector<std::string>& words);

/// A program's exit status, 127 if there is none of this name; what it said, and what it complained of.
struct Answer {
  int status;
  std::string text, complaint;
};

/// Runs a program to its end. Throws FileError where there is no place for what it says.
Answer ask(const std::vector<std::string>& words);

}  // namespace ricochet
