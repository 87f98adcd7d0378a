#include "script/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>

#include "core/spelling.hpp"

namespace ricochet {
namespace {

struct Token {
  std::string text;  // a name, a punctuation mark, or "" for a string or number
  int line, column;
};

// Lua's tokens as far as tables and names are concerned: strings, long brackets and comments are skipped.
std::vector<Token> tokens_of(const std::string& s) {
  std::vector<Token> tokens;
  std::size_t i = 0;
  int line = 1;
  std::size_t line_start = 0;
  const auto step = [&] {
    if (s[i] == '\n') {
      ++line;
      line_start = i + 1;
    }
    ++i;
  };
  const auto long_bracket = [&]() -> bool {  // at "[[" or "[=*["
    std::size_t j = i + 1;
    while (j < s.size() && s[j] == '=') ++j;
    if (s[i] != '[' || j >= s.size() || s[j] != '[') return false;
    const std::string close = "]" + std::string(j - i - 1, '=') + "]";
    const std::size_t end = std::min(s.find(close, j), s.size());
    while (i < std::min(end + close.size(), s.size())) step();
    return true;
  };
  while (i < s.size()) {
    const unsigned char c = static_cast<unsigned char>(s[i]);
    const int column = static_cast<int>(i - line_start) + 1;
    if (std::isspace(c)) {
      step();
    } else if (s.compare(i, 2, "--") == 0) {
      i += 2;
      if (i < s.size() && s[i] == '[' && long_bracket()) continue;
      while (i < s.size() && s[i] != '\n') step();
    } else if (c == '"' || c == '\'') {
      tokens.push_back({"", line, column});
      step();
      while (i < s.size() && s[i] != static_cast<char>(c) && s[i] != '\n') {
        if (s[i] == '\\') step();
        if (i < s.size()) step();
      }
      if (i < s.size()) step();
    } else if (c == '[' && i + 1 < s.size() && (s[i + 1] == '[' || s[i + 1] == '=')) {
      tokens.push_back({"", line, column});
      if (!long_bracket()) step();
    } else if (std::isalpha(c) || c == '_') {
      const std::size_t start = i;
      while (i < s.size() && (std::isalnum(static_cast<unsigned char>(s[i])) || s[i] == '_')) step();
      tokens.push_back({s.substr(start, i - start), line, column});
    } else {
      tokens.push_back({std::string(1, static_cast<char>(c)), line, column});
      step();
    }
  }
  return tokens;
}

bool opens(const std::string& t) {
  return t == "{" || t == "(" || t == "[" || t == "function" || t == "if" || t == "do" || t == "repeat";
}
bool closes(const std::string& t) { return t == "}" || t == ")" || t == "]" || t == "end" || t == "until"; }

// The token of `field =` directly inside the table whose "{" is at `open`.
std::optional<std::size_t> field_in(const std::vector<Token>& tokens, std::size_t open, const std::string& field) {
  int depth = 0;
  for (std::size_t i = open; i < tokens.size(); ++i) {
    if (opens(tokens[i].text)) ++depth;
    if (closes(tokens[i].text) && --depth == 0) return std::nullopt;
    if (depth == 1 && tokens[i].text == field && i + 1 < tokens.size() && tokens[i + 1].text == "=" && i > 0 &&
        (i - 1 == open || tokens[i - 1].text == "," || tokens[i - 1].text == ";"))
      return i;
  }
  return std::nullopt;
}

}  // namespace

std::string without_outer_locals(const std::string& source) {
  const std::vector<Token> tokens = tokens_of(source);
  std::vector<std::size_t> starts{0};  // of the lines
  for (std::size_t i = 0; i < source.size(); ++i)
    if (source[i] == '\n') starts.push_back(i + 1);
  const auto offset = [&](const Token& t) {
    return starts[static_cast<std::size_t>(t.line) - 1] + static_cast<std::size_t>(t.column) - 1;
  };
  std::string text = source;
  std::vector<std::size_t> undefined;  // where names end that get no value
  int depth = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (opens(tokens[i].text)) ++depth;
    if (closes(tokens[i].text)) --depth;
    if (depth != 0 || tokens[i].text != "local") continue;
    text.replace(offset(tokens[i]), 5, 5, ' ');
    std::size_t last = i + 1;
    if (last >= tokens.size() || tokens[last].text == "function") continue;
    while (last + 2 < tokens.size() && tokens[last + 1].text == ",") last += 2;
    if (last + 1 >= tokens.size() || tokens[last + 1].text != "=")
      undefined.push_back(offset(tokens[last]) + tokens[last].text.size());
  }
  for (auto at = undefined.rbegin(); at != undefined.rend(); ++at) text.insert(*at, " = nil");
  return text;
}

std::optional<SourcePlace> find_field(const std::string& source, int line, const std::string& function,
                                      const std::vector<std::string>& path) {
  const std::vector<Token> tokens = tokens_of(source);
  bool at_line = false;  // a call in the line itself goes before one in the next
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].line < line || tokens[i].line > line + 1 || tokens[i].text != function) continue;
    if (at_line && tokens[i].line > line) break;
    at_line = true;
    std::size_t open = i + 1;
    if (tokens[open].text == "(" && open + 1 < tokens.size()) ++open;
    if (tokens[open].text != "{") continue;
    std::optional<std::size_t> found;
    for (const std::string& name : path) {
      found = field_in(tokens, open, name);
      if (!found) break;
      open = *found + 2;
    }
    if (found) return SourcePlace{tokens[*found].line, tokens[*found].column, static_cast<int>(path.back().size())};
  }
  return std::nullopt;
}

namespace {

std::string line_of(const std::string& source, int number) {
  std::size_t start = 0;
  for (int line = 1; line < number && start != std::string::npos; ++line) {
    start = source.find('\n', start);
    if (start != std::string::npos) ++start;
  }
  return start == std::string::npos || start >= source.size() ? ""
                                                              : source.substr(start, source.find('\n', start) - start);
}

const std::vector<std::string> keywords{"and", "break",    "do",     "else", "elseif", "end",   "false",
                                        "for", "function", "if",     "in",   "local",  "nil",   "not",
                                        "or",  "repeat",   "return", "then", "true",   "until", "while"};

bool is_keyword(const std::string& word) { return std::find(keywords.begin(), keywords.end(), word) != keywords.end(); }

// Names that are somewhere followed by "=", or stand in a list of names.
std::set<std::string> declared_names(const std::vector<Token>& tokens) {
  std::set<std::string> declared;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const std::string before = i > 0 ? tokens[i - 1].text : "", after = tokens[i + 1].text;
    if (after == "=" || after == "," || before == "local" || before == "," || before == "for")
      declared.insert(tokens[i].text);
  }
  return declared;
}

// The line where the block was opened, if the message names one; from there on something may be misspelt.
int first_suspect_line(int line, const std::string& message) {
  if (const std::size_t opened = message.find("at line "); opened != std::string::npos)
    return std::atoi(message.c_str() + opened + 8);
  if (message.find("<eof> expected") != std::string::npos)
    return 1;  // an "end" too many: what it should close began anywhere
  return std::max(line - 1, 1);
}

// True for a name that may be a slip of a keyword.
bool is_like_a_keyword(const std::string& word) {
  if (word.size() < 2 || !std::isalpha(static_cast<unsigned char>(word[0])) || is_keyword(word)) return false;
  const std::vector<std::string> near = nearest_names(word, keywords);
  // The beginning of a longer word is no slip of a keyword.
  return !near.empty() && near[0].size() + 1 >= word.size() && word.size() + 2 >= near[0].size();
}

// " (did you mean 'return' for 'retrun' in line 4?)", or nothing.
std::string misspelt_keyword(const std::vector<Token>& tokens, int line, const std::string& message) {
  const int first = first_suspect_line(line, message);
  const std::set<std::string> declared = declared_names(tokens);
  const Token* suspect = nullptr;  // the last one before the error is the likeliest
  for (std::size_t i = 0; i < tokens.size() && tokens[i].line <= line; ++i) {
    if (tokens[i].line < first || declared.contains(tokens[i].text)) continue;
    if (i > 0 && (tokens[i - 1].text == "." || tokens[i - 1].text == ":")) continue;
    if (is_like_a_keyword(tokens[i].text)) suspect = &tokens[i];
  }
  if (!suspect) return "";
  std::string meant = did_you_mean(suspect->text, keywords);
  const std::string where = suspect->line == line ? "" : fmt::format(" in line {}", suspect->line);
  meant.insert(meant.size() - 2, fmt::format(" for '{}'{}", suspect->text, where));
  return meant;
}

// " (is the '{' of line 3 closed?)", or nothing.
std::string open_bracket(const std::vector<Token>& tokens, int line) {
  std::vector<const Token*> open;
  for (const Token& t : tokens) {
    if (t.line > line || (t.line == line && t.text == "end")) break;
    if (t.text == "{" || t.text == "(" || t.text == "[") open.push_back(&t);
    if ((t.text == "}" || t.text == ")" || t.text == "]") && !open.empty()) open.pop_back();
  }
  if (open.empty()) return "";
  return fmt::format(" (is the '{}' of line {} closed?)", open.back()->text, open.back()->line);
}

// What is written otherwise in other languages; or nothing.
std::string foreign_sign(const std::string& text, const std::string& message) {
  const auto near = [&](const std::string& mark) { return message.find("near '" + mark) != std::string::npos; };
  if (near("!")) return " (Lua writes ~= for 'differs from', and not for the negation)";
  if (near("&")) return " (Lua writes and, or, not)";
  for (const char* sign : {"+", "-", "*", "/"})
    if (text.find(std::string(sign) + "=") != std::string::npos)
      return fmt::format(" (Lua has no {0}=; write x = x {0} ...)", sign);
  return "";
}

// Of a name, string or bracket that stands where a comma or the end of the table should; or nothing.
std::string missing_comma(const std::string& message) {
  const std::size_t at = message.find("near '");
  const std::string word = at == std::string::npos ? "" : message.substr(at + 6, message.find('\'', at + 6) - at - 6);
  if (message.find("'}' expected") == std::string::npos || word.empty()) return "";
  if (!std::isalnum(static_cast<unsigned char>(word[0])) && word[0] != '_' && word[0] != '{') return "";
  return is_keyword(word) ? " (is a bracket missing before it?)" : " (is a comma missing before it?)";
}

// What the message for `line` leaves unsaid, or nothing.
std::string syntax_hint(const std::string& source, int line, const std::string& message) {
  const std::vector<Token> tokens = tokens_of(source);
  const std::string text = line_of(source, line);
  for (const char quote : {'"', '\''})
    if (std::count(text.begin(), text.end(), quote) % 2 == 1 && text.find("--") == std::string::npos)
      return " (is a quote missing in this line?)";
  if (const std::string meant = misspelt_keyword(tokens, line, message); !meant.empty()) return meant;
  if (message.find("']' expected near ','") != std::string::npos || message.find("near '[") != std::string::npos)
    return " (lists are written { ... })";
  if (message.find("unexpected symbol near 'end'") != std::string::npos)
    if (const std::string open = open_bracket(tokens, line); !open.empty()) return open;
  if (const std::string sign = foreign_sign(text, message); !sign.empty()) return sign;
  return missing_comma(message);
}

}  // namespace

Error syntax_error(const std::string& name, const std::string& source, const std::string& message) {
  const int line = message.starts_with(name + ":") ? std::atoi(message.c_str() + name.size() + 1) : 0;
  if (line <= 0) return Error(message);
  return Error(message + syntax_hint(source, line, message) + "\n" + excerpt(source, {line, 1, 0}));
}

std::string excerpt(const std::string& source, const SourcePlace& place) {
  const std::string text = line_of(source, place.line);
  if (text.empty()) return "";
  std::string result = fmt::format("{:5} | {}\n", place.line, text);
  if (place.length > 0) {
    // Tabs before the name are repeated, so that the carets stand below it.
    std::string indent = text.substr(0, static_cast<std::size_t>(place.column - 1));
    std::replace_if(
        indent.begin(), indent.end(), [](char c) { return c != '\t'; }, ' ');
    result += fmt::format("      | {}{}\n", indent, std::string(static_cast<std::size_t>(place.length), '^'));
  }
  return result;
}

}  // namespace ricochet
