// One statement a line: no `a = 1, b = 2;`, no comma that does something in a condition.

#include <catch2/catch.hpp>
#include <set>

#include "house/source.hpp"

using namespace ricochet::house;

namespace {

using Words = std::vector<Word>;

// Whether what starts here declares: `const double a`, `std::vector<int> b`, `Lane& c`.
bool declares(const Words& words, std::size_t i) {
  static const std::set<std::string_view> leading{
      "const", "auto",   "int",   "double", "float",    "bool",   "char",    "unsigned", "long",   "short",    "static",
      "void",  "struct", "class", "enum",   "template", "extern", "typedef", "using",    "inline", "constexpr"};
  if (leading.count(words[i].text)) return true;
  while (i < words.size()) {
    if (words[i].text == "::") ++i;
    if (i >= words.size() || !is_name(words[i].text)) return false;
    ++i;
    if (i < words.size() && words[i].text == "<") i = closing_angle(words, i) + 1;
    if (i >= words.size() || words[i].text != "::") break;
  }
  while (i < words.size() && (words[i].text == "&" || words[i].text == "*" || words[i].text == "&&")) ++i;
  return i < words.size() && is_name(words[i].text);
}

// The first comma outside all brackets between `from` and the end of the statement; words.size() if there is none.
std::size_t loose_comma(const Words& words, std::size_t from) {
  std::size_t comma = words.size();
  for (std::size_t i = from; i < words.size(); ++i) {
    const std::string_view word = words[i].text;
    if (word == ";") return comma;
    if (word == ")" || word == "]" || word == "}") break;
    if (word == "," && comma == words.size()) comma = i;
    if (word == "<" && !words[i].after_space && is_name(words[i - 1].text)) {
      const std::size_t close = closing_angle(words, i);
      if (close != words.size()) i = close;
    }
    if (word == "(" || word == "[" || word == "{") {
      const bool body = word == "{";
      i = closing(words, i);
      // Behind the body of a function or a block another statement starts; behind a list this one goes on.
      static const std::set<std::string_view> goes_on{",", ";", ".", "(", "[",  "?", ":",
                                                      "+", "-", "*", "/", "->", "=="};
      if (body && (i + 1 >= words.size() || !goes_on.count(words[i + 1].text))) break;
    }
  }
  return words.size();
}

// Where statements may start: behind ; { } else do, behind the head of if, for, while and switch, behind a label.
std::vector<std::size_t> statements(const Words& words) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::string_view word = words[i].text;
    if (word == ";" || word == "{" || word == "}" || word == "else" || word == "do") starts.push_back(i + 1);
    if (word == ":" && (words[i - 1].text == "default" || words[i - 2].text == "case" || words[i - 2].text == "::"))
      starts.push_back(i + 1);
    if (word != "if" && word != "for" && word != "while" && word != "switch") continue;
    const std::size_t open = words[i + 1].text == "constexpr" ? i + 2 : i + 1;
    const std::size_t close = closing(words, open);
    if (close + 1 < words.size()) starts.push_back(close + 1);
  }
  return starts;
}

Findings comma_statements(const File& file) {
  const Words list = words(file.text);
  std::set<int> lines;
  for (const std::size_t start : statements(list)) {
    const std::string_view first = list[start].text;
    static const std::set<std::string_view> none{"if",   "for",     "while",  "switch",  "else",     "do",
                                                 "case", "default", "public", "private", "protected"};
    if (none.count(first) || (!is_name(first) && first != "++" && first != "--" && first != "*" && first != "("))
      continue;
    const bool returns = first == "return" || first == "throw";
    const std::size_t comma = loose_comma(list, start);
    if (comma != list.size() && (returns || !declares(list, start))) lines.insert(list[comma].line);
  }
  Findings found;
  for (const int line : lines) found.push_back(at(file, line, "two statements joined by a comma; give each its line"));
  return found;
}

std::size_t count(const std::string& text) { return comma_statements({"bad.cpp", text}).size(); }

}  // namespace

TEST_CASE("no statement hangs on another by a comma") {
  Findings found;
  for (const File& file : cpp_files())
    for (const std::string& one : comma_statements(file)) found.push_back(one);
  CHECK(listed(found) == "");
}

TEST_CASE("a comma between statements is found wherever it stands, and one that lists things is not") {
  CHECK(count("void f() { a = 1, b = 2; }") == 1);
  CHECK(count("void f() { if (x) a = 1, b = 2; }") == 1);
  CHECK(count("void f() { if (x) a = 1; else b = 1, c = 2; }") == 1);
  CHECK(count("void f() { for (;;) ++i, --j; }") == 1);
  CHECK(count("void f() { return a(), b; }") == 1);
  CHECK(count("void f() { std::swap(a, b), c.d(1); }") == 1);
  CHECK(count("void f() { x += by * vx[i], y += by * vy[i]; }") == 1);
  CHECK(count("void f() { switch (x) { case 1: a = 1, b = 2; } }") == 1);
  CHECK(count("void f() { g([&] { a = 1, b = 2; }); }") == 1);
  CHECK(count("void f() { push(A{1, 2}), b = 1; }") == 1);
  CHECK(count("void f() {\n  // a = 1, b = 2;\n  g(\"a, b;\");\n  h(R\"(a = 1, b = 2;)\");\n}") == 0);
  CHECK(count("int a, b; const std::map<int, int> c, d; Lane<4>& e = f, g; std::vector<double> h{1, 2}, k;") == 0);
  CHECK(
      count("void f(int a, int b) { g(a, b); const auto [x, y] = h<int, 2>(a); for (i = 0; i < n; ++i, ++j) k(); }") ==
      0);
  CHECK(count("class A {\n public:\n  A();\n\n private:\n  int b, c;\n};") == 0);
  CHECK(count("A::A(int a) : b(a), c{1, 2}, d(a) { e(); }\nenum class B { c, d };\nC g{1, 2};") == 0);
}
