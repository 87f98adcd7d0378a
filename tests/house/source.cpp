#include "house/source.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace ricochet::house {

namespace fs = std::filesystem;

std::string listed(const Findings& findings) {
  std::string text;
  for (const std::string& one : findings) text += "\n" + one;
  return text;
}

std::vector<File> files(const std::vector<std::string>& folders, const std::vector<std::string>& endings) {
  const fs::path root = RICOCHET_SOURCE;
  std::vector<File> found;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (std::find(endings.begin(), endings.end(), entry.path().extension()) == endings.end()) continue;
      std::ifstream stream(entry.path());
      found.push_back({fs::relative(entry.path(), root).string(), {std::istreambuf_iterator<char>(stream), {}}});
    }
  std::sort(found.begin(), found.end(), [](const File& a, const File& b) { return a.name < b.name; });
  return found;
}

std::vector<File> cpp_files(const std::vector<std::string>& folders) {
  return files(folders, {".cpp", ".hpp", ".inl"});
}

namespace {

bool part_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// Just past the end of the quoted text that starts here.
std::size_t quoted(std::string_view s, std::size_t from) {
  std::size_t i = from + 1;
  while (i < s.size() && s[i] != s[from]) i += s[i] == '\\' ? 2 : 1;
  return std::min(i + 1, s.size());
}

// R"mark( ... )mark"
std::size_t raw_string(std::string_view s, std::size_t from) {
  const std::size_t open = s.find('(', from);
  const std::string end = ")" + std::string(s.substr(from + 2, open - from - 2)) + "\"";
  const std::size_t close = s.find(end, open);
  return close == std::string_view::npos ? s.size() : close + end.size();
}

// Past a line, and past those that it goes on in behind a backslash.
std::size_t whole_line(std::string_view s, std::size_t from) {
  std::size_t end = s.find('\n', from);
  while (end != std::string_view::npos && s[end - 1] == '\\') end = s.find('\n', end + 1);
  return std::min(end, s.size());
}

// Numbers with their separators and exponents: 1'000, 1e-3.
std::size_t number(std::string_view s, std::size_t i) {
  while (i < s.size() && (part_of_name(s[i]) || s[i] == '.' || s[i] == '\'' ||
                          ((s[i] == '-' || s[i] == '+') && (s[i - 1] == 'e' || s[i - 1] == 'E'))))
    ++i;
  return i;
}

std::size_t sign(std::string_view s, std::size_t i) {
  static const std::string_view longer[] = {"<<=", "<=>", "::", "->", "++", "--", "<<", "==", "!=", "<=", ">=",
                                            "+=",  "-=",  "*=", "/=", "%=", "&=", "|=", "^=", "&&", "||"};
  for (const std::string_view one : longer)
    if (s.substr(i, one.size()) == one) return i + one.size();
  return i + 1;
}

// Just past what starts here: white space, a comment, a preprocessor line, or a word.
std::size_t end_of(std::string_view s, std::size_t i) {
  const std::string_view two = s.substr(i, 2);
  if (s[i] == '#') return whole_line(s, i);
  if (two == "//") return std::min(s.find('\n', i), s.size());
  if (two == "/*") return std::min(s.find("*/", i), s.size() - 2) + 2;
  if (two == "R\"") return raw_string(s, i);
  if (s[i] == '"' || s[i] == '\'') return quoted(s, i);
  if (std::isdigit(static_cast<unsigned char>(s[i]))) return number(s, i);
  if (!part_of_name(s[i])) return sign(s, i);
  std::size_t end = i;
  while (end < s.size() && part_of_name(s[end])) ++end;
  return end;
}

}  // namespace

std::vector<Word> words(std::string_view source) {
  std::vector<Word> result;
  int line = 1;
  bool after_space = true;
  for (std::size_t i = 0, end = 0; i < source.size(); i = end) {
    end = end_of(source, i);
    const std::string_view text = source.substr(i, end - i);
    const bool skipped = std::isspace(static_cast<unsigned char>(text[0])) || text[0] == '#' ||
                         text.starts_with("//") || text.starts_with("/*");
    if (!skipped) result.push_back({text, line, after_space});
    after_space = skipped;
    line += static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  }
  return result;
}

std::size_t closing(const std::vector<Word>& words, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < words.size(); ++i) {
    const std::string_view word = words[i].text;
    if (word == "(" || word == "[" || word == "{") ++depth;
    if (word == ")" || word == "]" || word == "}") --depth;
    if (depth == 0) return i;
  }
  return words.size();
}

std::size_t closing_angle(const std::vector<Word>& words, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < words.size(); ++i) {
    const std::string_view word = words[i].text;
    if (word == "(" || word == "[") {
      i = closing(words, i);
      continue;
    }
    if (word == "<") ++depth;
    if (word == ">" && --depth == 0) return i;
    if (word == ";" || word == "{" || word == "}" || word == ")" || word == "]") break;
  }
  return words.size();
}

bool is_name(std::string_view word) {
  return !word.empty() && part_of_name(word[0]) && !std::isdigit(static_cast<unsigned char>(word[0]));
}

std::string at(const File& file, int line, const std::string& finding) {
  return file.name + ":" + std::to_string(line) + ": " + finding;
}

}  // namespace ricochet::house
