// Functions and files that a reader can hold in mind.

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "house/source.hpp"

using namespace ricochet::house;

namespace {

using Words = std::vector<Word>;

struct Function {
  std::string name;
  int line, lines;
};

// Past `template <...>` and attributes.
std::size_t past_template(const Words& words, std::size_t i) {
  while (i < words.size()) {
    if (words[i].text == "template" && i + 1 < words.size())
      i = closing_angle(words, i + 1) + 1;
    else if (words[i].text == "[")
      i = closing(words, i) + 1;
    else
      break;
  }
  return i;
}

// What the brace at `open` encloses, by what stands between `head` and it.
enum class Block { scope, function, member_start, other };

Block kind_of(const Words& words, std::size_t head, std::size_t open) {
  std::size_t parameters = 0, colon = 0;
  for (std::size_t i = past_template(words, head); i < open; ++i) {
    const std::string_view word = words[i].text;
    if (word == "namespace") return Block::scope;
    if (word == "enum") return Block::other;
    if (!parameters && (word == "struct" || word == "class" || word == "union")) return Block::scope;
    if (word == "operator") i += words[i + 1].text == "(" ? 2 : 1;
    if (word == "=" && !parameters) return Block::other;
    if (word == ":" && parameters) colon = i;
    if (words[i].text != "(" && words[i].text != "[" && words[i].text != "{") continue;
    if (words[i].text == "(" && !parameters) parameters = i;
    i = closing(words, i);
  }
  if (!parameters) return Block::other;
  // In `A() : b{1} {` the brace behind a name starts a member.
  if (colon && is_name(words[open - 1].text)) return Block::member_start;
  return Block::function;
}

std::string name_of(const Words& words, std::size_t head, std::size_t open) {
  for (std::size_t i = past_template(words, head); i < open; ++i) {
    if (words[i].text == "<" && closing_angle(words, i) < open) i = closing_angle(words, i);
    if (words[i].text == "(" && i > head) return std::string(words[i - 1].text);
  }
  return "?";
}

// The functions with a body, each from its first line to its last.
std::vector<Function> functions(const File& file) {
  const Words list = words(file.text);
  std::vector<Function> found;
  std::size_t head = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string_view word = list[i].text;
    if (word == ";" || word == "}") head = i + 1;
    if (word == ":" && i > 0 && (list[i - 1].text == "public" || list[i - 1].text == "private")) head = i + 1;
    if (word != "{") continue;
    const Block kind = kind_of(list, head, i);
    if (kind == Block::scope) {
      head = i + 1;
      continue;
    }
    const std::size_t close = closing(list, i);
    if (close == list.size()) break;
    if (kind == Block::function) {
      const int line = list[head].line;
      found.push_back({name_of(list, head, i), line, list[close].line - line + 1});
      head = close + 1;
    }
    i = close;
  }
  return found;
}

int lines_of(const File& file) { return static_cast<int>(std::count(file.text.begin(), file.text.end(), '\n')); }

}  // namespace

TEST_CASE("at most five functions of the program are longer than 60 lines") {
  Findings found;
  for (const File& file : cpp_files({"src", "render"})) {
    for (const Function& f : functions(file))
      if (f.lines > 60) found.push_back(at(file, f.line, f.name + ", " + std::to_string(f.lines) + " lines"));
  }
  INFO(listed(found));
  CHECK(found.size() <= 5);
}

TEST_CASE("no file of the program is longer than 400 lines") {
  Findings found;
  for (const File& file : cpp_files({"src", "render"}))
    if (lines_of(file) > 400) found.push_back(file.name + ": " + std::to_string(lines_of(file)));
  CHECK(listed(found) == "");
}

TEST_CASE("functions are counted in all their forms, and nothing else is") {
  const std::string text = R"(#include <a>
namespace a {
template <class T>
T first(T t) {
  if (t) {
    return t;
  }
  return [] { return T{}; }();
}
const std::map<int, int> table = {
    {1, 2},
};
enum class Kind { a, b };
class B : public C<D> {
 public:
  B(int a) : a{a}, b(1), c{1, 2} {
    f();
  }
  bool operator()(int x) const { return x; }
  bool operator==(const B& b) const = default;

 private:
  std::vector<int> list{1, 2};
  static Arguments<B> fields() noexcept;
};

std::function<int(int)> last(const std::function<void(int)>& f,
                         int b = 1) {
  return {1, 2};
}
}  // namespace a
)";
  std::map<std::string, int> found;
  for (const Function& f : functions({"a.cpp", text})) found[f.name] = f.lines;
  const std::map<std::string, int> expected{{"first", 7}, {"B", 3}, {"operator", 1}, {"last", 4}};
  CHECK(found == expected);
}
