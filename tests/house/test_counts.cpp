// The numbers of tests that tests/README.md tells, each near enough to what there is.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <regex>

#include "house/source.hpp"

using namespace ricochet::house;

namespace {

struct Test {
  std::string folder, tags;  // "hard"; "[.slow][P3]"
  bool is_hidden() const { return tags.find("[.") != std::string::npos; }
  bool has(const std::string& tag) const { return tags.find(tag) != std::string::npos; }
};

// The test cases of a file of tests/FOLDER/.
std::vector<Test> tests_of(const File& file) {
  const std::size_t from = file.name.find('/') + 1;
  const std::string folder = file.name.substr(from, file.name.find('/', from) - from);
  const std::vector<Word> list = words(file.text);
  std::vector<Test> tests;
  for (std::size_t i = 0; i + 2 < list.size(); ++i) {
    if (list[i].text != "TEST_CASE" || list[i + 1].text != "(") continue;
    std::size_t k = i + 2;
    while (list[k].text.starts_with('"')) ++k;  // its name, of several pieces maybe
    tests.push_back({folder, list[k].text == "," ? std::string(list[k + 1].text) : ""});
  }
  return tests;
}

std::vector<Test> all_tests() {
  std::vector<Test> all;
  for (const File& file : cpp_files({"tests"}))
    for (const Test& test : tests_of(file)) all.push_back(test);
  return all;
}

// A number that the page tells: what stands around it, and which tests it is of.
struct Told {
  const char* place;
  std::function<bool(const Test&)> is_of;
};

bool is_own(const Test& test) { return test.folder == "theory" || test.folder == "house" || test.folder == "hard"; }

const std::vector<Told>& told() {
  static const std::vector<Told> list{
      {"runs every test but the slow ones, about ([0-9]+),", [](const Test& t) { return !t.is_hidden(); }},
      {"release/tests/ricochet_tests`[^\n]*about ([0-9]+) tests [|]",
       [](const Test& t) { return !is_own(t) && !t.is_hidden(); }},
      {"tests/theory_tests`[^\n]*about ([0-9]+) tests;",
       [](const Test& t) { return t.folder == "theory" && !t.is_hidden(); }},
      {"tests/house_tests`[^\n]*about ([0-9]+) tests [|]", [](const Test& t) { return t.folder == "house"; }},
      {"test --hard`[^\n]*about ([0-9]+) tests [|]",
       [](const Test& t) { return t.folder == "hard" && !t.is_hidden(); }},
      {"test --hard slow`[^\n]*[|] ([0-9]+) more", [](const Test& t) { return t.folder == "hard" && t.is_hidden(); }},
      {"ricochet_tests \"\\[\\.slow\\]\"`[^\n]*[|] about ([0-9]+) tests",
       [](const Test& t) { return !is_own(t) && t.has("[.slow]"); }},
      {"test --slurm`[^\n]*[|] ([0-9]+) tests", [](const Test& t) { return t.has("[.slurm]"); }},
      {"ricochet_tests \"\\[\\.benchmark\\]\"`[^\n]*[|] ([0-9]+) benchmarks",
       [](const Test& t) { return !is_own(t) && t.has("[.benchmark]"); }}};
  return list;
}

// Few are told as they are, many to a tenth.
bool is_near(double told, double count) { return std::abs(told - count) <= (count < 10 ? 0 : 0.1 * count); }

}  // namespace

TEST_CASE("tests/README.md tells how many tests there are") {
  const std::vector<File> pages = files({"tests"}, {".md"});
  const auto page =
      std::find_if(pages.begin(), pages.end(), [](const File& file) { return file.name == "tests/README.md"; });
  REQUIRE(page != pages.end());
  const std::vector<Test> tests = all_tests();
  Findings found;
  for (const Told& number : told()) {
    const auto count = static_cast<double>(std::count_if(tests.begin(), tests.end(), number.is_of));
    std::smatch match;
    if (!std::regex_search(page->text, match, std::regex(number.place)))
      found.push_back("tests/README.md has no number at " + std::string(number.place));
    else if (!is_near(std::stod(match[1]), count))
      found.push_back("tests/README.md tells " + match[1].str() + " where there are " +
                      std::to_string(static_cast<int>(count)) + ": " + number.place);
  }
  CHECK(listed(found) == "");
}

TEST_CASE("tests are counted with their tags, whatever their names hold") {
  const std::string text =
      "TEST_CASE(\"a, \"\n    \"b (c)\", \"[.slow][P1]\") {}\nTEST_CASE(\"[.slow] in a name\") { f(\"TEST_CASE(\"); }\n"
      "// TEST_CASE(\"none\") {}\n";
  const std::vector<Test> tests = tests_of({"tests/script/test_a.cpp", text});
  REQUIRE(tests.size() == 2);
  CHECK(tests[0].folder == "script");
  CHECK(tests[0].has("[.slow]"));
  CHECK_FALSE(tests[1].is_hidden());
  CHECK(is_near(25, 24));
  CHECK_FALSE(is_near(25, 20));
  CHECK_FALSE(is_near(2, 3));
}
