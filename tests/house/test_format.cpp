// Every file stands as .clang-format says, and within the width.

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "house/source.hpp"

using namespace ricochet::house;

namespace {

const std::string root = RICOCHET_SOURCE;

std::string output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  char piece[4096];
  while (const std::size_t got = fread(piece, 1, sizeof piece, pipe)) text.append(piece, got);
  pclose(pipe);
  return text;
}

// What clang-format would change in these files: one line each.
Findings misformatted(const std::string& paths) {
  REQUIRE_THAT(output_of("clang-format --version"), Catch::Contains("version 14."));  // others format otherwise
  const std::string said = output_of("clang-format --style=file:'" + root + "/.clang-format' --dry-run " + paths);
  Findings found;
  for (std::size_t at = 0; (at = said.find("warning:", at)) != std::string::npos; ++at) {
    const std::size_t start = said.rfind('\n', at) + 1;
    found.push_back(said.substr(start, said.find('\n', at) - start));
  }
  return found;
}

constexpr int width = 120;

// Characters, not bytes.
int length(std::string_view line) {
  int count = 0;
  for (const char c : line) count += (c & 0xC0) != 0x80;
  return count;
}

Findings over_width(const File& file) {
  // A test may quote a script as its user wrote it.
  std::vector<bool> quoted;
  if (file.name.starts_with("tests/"))
    for (const Word& word : words(file.text)) {
      if (!word.text.starts_with("R\"")) continue;
      const auto last = word.line + std::count(word.text.begin(), word.text.end(), '\n');
      quoted.resize(std::max(quoted.size(), static_cast<std::size_t>(last) + 1));
      for (auto line = word.line; line <= last; ++line) quoted[static_cast<std::size_t>(line)] = true;
    }
  Findings found;
  std::size_t number = 1;
  for (std::size_t start = 0; start < file.text.size(); ++number) {
    const std::size_t end = std::min(file.text.find('\n', start), file.text.size());
    const int columns = length(std::string_view(file.text).substr(start, end - start));
    if (columns > width && !(number < quoted.size() && quoted[number]))
      found.push_back(at(file, static_cast<int>(number), std::to_string(columns) + " columns, over 120"));
    start = end + 1;
  }
  return found;
}

}  // namespace

TEST_CASE("every C++ file is formatted as .clang-format says (clang-format -i mends it)") {
  std::string paths;
  for (const File& file : cpp_files()) paths += " '" + root + "/" + file.name + "'";
  CHECK(listed(misformatted(paths)) == "");
}

TEST_CASE("a file that is not formatted is found") {
  const auto path = std::filesystem::temp_directory_path() / ("ricochet_format_" + std::to_string(getpid()) + ".cpp");
  std::ofstream(path) << "int   f( ){return 1 ;}\n";
  CHECK(misformatted(path.string()).size() > 0);
  std::ofstream(path) << "int f() { return 1; }\n";
  CHECK(misformatted(path.string()) == Findings{});
  std::filesystem::remove(path);
}

TEST_CASE("no line is longer than 120 columns") {
  std::vector<File> all = cpp_files();
  for (const File& file : files({"lua", "scripts", "examples"}, {".lua"}))
    if (file.name != "lua/ricochet.d.lua") all.push_back(file);  // `ricochet reference --stubs` wrote it
  Findings found;
  for (const File& file : all)
    for (const std::string& one : over_width(file)) found.push_back(one);
  CHECK(listed(found) == "");
}

TEST_CASE("a line of 121 columns is found, but not within a quoted script") {
  const std::string fits(120, 'x'), over(121, 'x');
  std::string umlauts;
  for (int i = 0; i < 120; ++i) umlauts += "\u00fc";
  CHECK(over_width({"src/a.cpp", fits + "\n" + umlauts + "\n"}) == Findings{});
  CHECK(over_width({"src/a.cpp", fits + "\n" + over}) == Findings{"src/a.cpp:2: 121 columns, over 120"});
  CHECK(over_width({"tests/a.cpp", "a(R\"(\n" + over + "\n)\");\n"}) == Findings{});
  CHECK(over_width({"src/a.cpp", "a(R\"(\n" + over + "\n)\");\n"}).size() == 1);
}
