#pragma once
// The program's source as the tests of its form read it: files, and C++ in words.

#include <string>
#include <string_view>
#include <vector>

namespace ricochet::house {

/// "src/core/turn.hpp:12: what is wrong", one each.
using Findings = std::vector<std::string>;
std::string listed(const Findings& findings);

struct File {
  std::string name;  // from the root of the project
  std::string text;
};

/// The files below these folders of the project whose names end so, in order of name.
std::vector<File> files(const std::vector<std::string>& folders, const std::vector<std::string>& endings);
/// The C++ files below these folders.
std::vector<File> cpp_files(const std::vector<std::string>& folders = {"src", "render", "tests"});

struct Word {
  std::string_view text;
  int line;
  bool after_space;
};

/// C++ in words, without comments, preprocessor lines and space; a quoted text is one word.
std::vector<Word> words(std::string_view source);

/// The bracket that closes the one at `open`; words.size() if none does.
std::size_t closing(const std::vector<Word>& words, std::size_t open);
/// The '>' that closes the '<' at `open`, if these enclose the arguments of a template; words.size() otherwise.
std::size_t closing_angle(const std::vector<Word>& words, std::size_t open);

bool is_name(std::string_view word);
std::string at(const File& file, int line, const std::string& finding);

}  // namespace ricochet::house
