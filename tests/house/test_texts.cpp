// Texts of several lines break where a line is full, not in the middle of it.

#include <algorithm>
#include <catch2/catch.hpp>

#include "house/source.hpp"

using namespace ricochet::house;

namespace {

constexpr std::size_t width = 120;
constexpr std::size_t least = 40;  // what is longer may end early, before a word that goes with the next

struct Piece {
  std::size_t indent;
  std::string_view text;  // in its quotes, which may be all of the line but what follows it
  bool ends_line;
};

// The text that a line begins with, none if it begins otherwise.
Piece piece_of(std::string_view line) {
  const std::size_t from = line.find_first_not_of(' ');
  if (from == std::string_view::npos || line[from] != '"') return {0, {}, false};
  const Word text = words(line.substr(from)).front();
  return {from, text.text, from + text.text.size() == line.size()};
}

// Whether the first word of what follows has its place in this line, which ends with a space and is short.
bool breaks_early(const Piece& piece, const Piece& next) {
  if (!piece.ends_line || next.text.empty() || piece.text.size() > least || !piece.text.ends_with(" \"")) return false;
  const std::string_view rest = next.text.substr(1, next.text.size() - 2);
  const std::size_t word = std::min(rest.find(' ') + 1, rest.size());
  return piece.indent + piece.text.size() + (word == 0 ? rest.size() : word) <= width;
}

Findings early_breaks(const File& file) {
  Findings found;
  Piece before{0, {}, false}, piece = before;
  std::size_t from = 0;
  for (int line = 1; from < file.text.size(); ++line) {
    const std::size_t end = std::min(file.text.find('\n', from), file.text.size());
    const Piece next = piece_of(std::string_view(file.text).substr(from, end - from));
    if (!before.text.empty() && breaks_early(piece, next))
      found.push_back(at(file, line - 1, "a text breaks before its line is full; join it with the next"));
    before = piece;
    piece = next;
    from = end + 1;
  }
  return found;
}

std::size_t count(const std::string& text) { return early_breaks({"bad.cpp", text}).size(); }

}  // namespace

TEST_CASE("no text breaks before its line is full") {
  Findings found;
  for (const File& file : cpp_files())
    for (const std::string& one : early_breaks(file)) found.push_back(one);
  CHECK(listed(found) == "");
}

TEST_CASE("a word that stands alone within a text is found, and a line of its own or the last one is not") {
  CHECK(count("a =\n    \"long as it may be \"\n    \"nearest \"\n    \"values\";\n") == 1);
  CHECK(count("a =\n    \"long as it may be \"\n    \"values\";\n") == 0);
  CHECK(count("a =\n    \"long as it may be \"\n    \"a line\\n\"\n    \"values\";\n") == 0);
  CHECK(count("a =\n    \"one \",\n    \"two \",\n    \"three\";\n") == 0);
  CHECK(count("a =\n    \"long \"\n    \"nearest \"\n    \"" + std::string(110, 'w') + "\";\n") == 0);
}
