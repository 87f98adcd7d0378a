// ricochet.lesson: what it refuses, and that every number of a page is one of its impacts. (How the page behaves in a
// browser: tests/browser.)

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <regex>
#include <set>

#include "script/page.hpp"
#include "script/program.hpp"
#include "store/table.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

// A lesson of 12 impacts of a small disk, in which `changed` (Lua) may change its table `t`.
std::string lesson(
    const std::string& changed = "", const std::string& over = "angle = { 0, 10, 20, 30 }, speed = { 0.05, 0.1, 0.15 }",
    const std::string& run = "for _, row in ipairs(sweep:run()) do row.lost = 100 * (1 - row.e ^ 2) end") {
  return "local ricochet = require 'ricochet'\nlocal sweep = ricochet.sweep { name = 'grid', over = { " + over +
         R"( }, scene = function(at)
  return ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.plane {},
    launch = { speed = at.speed, angle = at.angle }, accuracy = 1e-2 } end }
)" + run +
         R"(
local t = { grid = sweep, title = "A <b> lesson", names = { "disk", "floor" }, processor_time = 1, frames = 8,
  intro = { "Between {e least=e} and {e greatest=e}." },
  sliders = { { of = "angle", label = "Angle", unit = "°" }, { of = "speed", label = "Speed", texts = { "slow", "middling", "fast" } } },
  results = { { of = "e", label = "e" }, { of = "lost", label = "Lost", unit = "%" } },
  guess = { of = "lost", question = "How much is lost?", from = -100, to = 100, step = 1 },
  graph = { x = "angle", by = "speed" },
  intuition = { wrong = "Nothing.", right = "It is {lost angle=0 speed=0.1} %." },
  questions = { { ask = "How large is e at 30 degrees?", answer = "{e angle=30 speed=0.1}, or {e:5 angle=30 speed=0.1}; it is least at {angle least=e}, {speed least=e}." } },
  teacher = { "Nothing goes wrong." } }
)" + changed +
         "\nricochet.lesson(t)\n";
}

// A text's numbers in a page: text, column and hash.
struct Number {
  std::string text, of, hash;
  double value;
};

std::string text_after(const std::string& json, std::size_t at, const std::string& name) {
  const std::string mark = "\"" + name + "\":\"";
  const std::size_t begins = json.find(mark, at) + mark.size();
  return json.substr(begins, json.find('"', begins) - begins);
}

std::vector<Number> numbers_in(const std::string& html) {
  std::vector<Number> list;
  const std::string begins = "{\"hash\":\"";
  const std::size_t end = html.find("\"sections\":[");
  for (std::size_t at = html.find(begins, html.find("\"lesson\":{")); at < end; at = html.find(begins, at + 1)) {
    const std::size_t value = html.find("\"value\":", at);
    const std::string number = html.substr(value + 8, 40);
    list.push_back({text_after(html, at, "text"), text_after(html, at, "of"), text_after(html, at, "hash"),
                    number[0] == '"' ? NAN : std::stod(number)});
  }
  return list;
}

std::size_t row_of_hash(const Table& table, const std::string& hash) {
  const auto& hashes = table.text("scene_hash")->values;
  return static_cast<std::size_t>(std::find(hashes.begin(), hashes.end(), hash) - hashes.begin());
}

std::vector<std::string> parts_between(const std::string& text, const std::string& begin, const std::string& end) {
  std::vector<std::string> parts;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    parts.push_back(text.substr(at, text.find(end, at) - at));
  }
  return parts;
}

std::vector<std::string> decimals_in(const std::string& text) {
  static const std::regex decimal("[0-9]+[.][0-9]+");
  std::vector<std::string> list;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), decimal); at != std::sregex_iterator(); ++at)
    list.push_back(at->str());
  return list;
}

std::string plain(std::string text) {
  for (std::size_t at; (at = text.find("−")) != std::string::npos;) text.replace(at, 3, "-");
  return text;
}

}  // namespace

TEST_CASE("a lesson is one file with the replay of each of its settings, and the numbers of its texts are the rows'") {
  const Workplace here;
  const Ended run = here.script(lesson());
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK_THAT(run.out, Contains("lesson: out/s/lesson.html (12 settings"));
  const std::string html = here.read("out/s/lesson.html");
  CHECK_THAT(html, Contains("<h1>A &lt;b&gt; lesson</h1>"));
  for (const char* address : {"src=\"http", "href=\"http", "@import", "url("})
    CHECK(html.find(address) == std::string::npos);
  const Table table = read_table(here.path / "out/grid/results.h5");
  const auto replays = replays_in(html);
  CHECK(replays.size() == 12);
  for (const std::string& hash : table.text("scene_hash")->values) CHECK(replays.count(hash) == 1);

  const std::vector<Number> numbers = numbers_in(html);
  REQUIRE(numbers.size() == 7);
  const std::vector<double>& e = table.number("e")->values;
  for (const Number& number : numbers) {
    const std::size_t row = row_of_hash(table, number.hash);
    INFO(number.of << " " << number.text);
    REQUIRE(row < 12);
    const NumberColumn* column = table.number(number.of);
    const double known = number.of == "lost" ? 100 * (1 - e[row] * e[row]) : column ? column->values[row] : NAN;
    CHECK(number.value == known);
    if (number.of == "e") CHECK(std::abs(std::stod(plain(number.text)) - known) <= 0.00501);
  }
  // The intuition's number is of its setting, the answer's second to five digits, values of sliders as sliders have
  // them.
  const std::size_t meant = row_of_hash(table, numbers[2].hash);
  CHECK(table.number("angle")->values[meant] == 0);
  CHECK(table.number("speed")->values[meant] == 0.1);
  CHECK(std::abs(std::stod(plain(numbers[4].text)) - numbers[4].value) < 0.51e-4);
  CHECK(numbers[4].text.size() == 7);
  CHECK(std::set<std::string>{"slow", "middling", "fast"}.count(numbers[6].text) == 1);
  CHECK(e[row_of_hash(table, numbers[0].hash)] == *std::min_element(e.begin(), e.end()));
  CHECK(e[row_of_hash(table, numbers[1].hash)] == *std::max_element(e.begin(), e.end()));
}

TEST_CASE("a lesson holds what the run printed and warned of") {
  const Workplace here;
  const Ended run = here.script("print 'a word of the script'\n" + lesson("require 'ricochet'.scene { method = 'rk4', "
                                                                          "projectile = require 'ricochet'.disk {}, "
                                                                          "target = require 'ricochet'.plane {} }"));
  INFO(run.err);
  REQUIRE(run.status == 0);
  const std::string html = here.read("out/s/lesson.html"), log = text_after(html, 0, "log");
  CHECK_THAT(log,
             Contains("a word of the script") && Contains("warning: rk4 is a control") && Contains("12 of 12 impacts"));
  CHECK_THAT(html, Contains("id=\"careful\"") && Contains("What to be careful with"));
}

TEST_CASE("what a lesson cannot be made of is told in one clear line") {
  const Workplace here;
  const auto mistake = [&](const std::string& text) {
    const Ended ended = here.script(text, "--force --quiet --no-report");
    CHECK(ended.status == 1);
    CHECK(!fs::exists(here.path / "out/s/lesson.html"));
    return ended.err;
  };
  const auto changed = [&](const std::string& change) { return mistake(lesson(change)); };
  CHECK_THAT(mistake(lesson("", "angle = { 0, 10 }, speed = { 0.05, 0.1, 0.15 }")),
             Contains("lesson: the grid has 6 settings; a lesson has at least 12"));
  CHECK_THAT(mistake(lesson("", "angle = { 0, 10, 20, 30 }, speed = { 0.05, 0.1, 0.15 }", "")),
             Contains("lesson: the grid has not run; call run() of the sweep first"));
  CHECK_THAT(mistake(lesson("",
                            "ricochet.zip { angle = ricochet.range(0, 33, 3), speed = ricochet.range(0.05, 0.16, "
                            "0.01) }")),
             Contains("lesson: a lesson takes every value with every other: no zip or latin_hypercube in 'over'"));
  CHECK_THAT(
      mistake(lesson("t.sliders[2].of = 'tried'", "angle = { 0, 10, 20, 30 }, tried = { 1, 2, 3 }, speed = { 0.1 }")),
      Contains("sliders[2]: the page's link says something else by 'tried'; take another name in 'over'"));
  CHECK_THAT(mistake(lesson("", "angle = { 0, 0, 20, 30 }, speed = { 0.05, 0.1, 0.15 }")),
             Contains("are the same impact; leave out what changes nothing"));
  CHECK_THAT(changed("t.grid = 3"), Contains("lesson: 'grid' must be a sweep (from ricochet.sweep), is 3"));
  CHECK_THAT(changed("t.intuition = nil"), Contains("'intuition' is missing: a wrong idea that many people have"));
  CHECK_THAT(changed("t.teachers = t.teacher"), Contains("unknown field 'teachers' (did you mean 'teacher'?)"));
  CHECK_THAT(changed("t.sliders[2].lable = 'x'"),
             Contains("lesson: sliders[2]: unknown field 'lable' (did you mean 'label'?)"));
  CHECK_THAT(changed("t.sliders[2] = 'speed'"),
             Contains("'sliders' must be a list of tables; element 2 is a string ('speed')"));
  CHECK_THAT(changed("t.sliders[2].of = 'sped'"),
             Contains("sliders[2]: the grid varies no 'sped' (did you mean 'speed'?)"));
  CHECK_THAT(changed("t.sliders[2].texts = { 'slow' }"), Contains("sliders[2]: 1 texts for the 3 values of speed"));
  CHECK_THAT(changed("t.sliders[2] = nil"), Contains("'speed' varies and has no slider"));
  CHECK_THAT(changed("t.results[1].of = 'ee'"), Contains("the rows have no column 'ee' (did you mean 'e'?)"));
  CHECK_THAT(changed("t.results[1].of = 'status'"), Contains("results[1]: the column 'status' holds no numbers"));
  CHECK_THAT(changed("t.guess.of = 'mu'"), Contains("'of' is 'mu', which is not among the results"));
  CHECK_THAT(changed("t.guess.to = -200"), Contains("'from' must be below 'to'"));
  CHECK_THAT(changed("t.guess.to = 0"),
             Contains("'lost' is") && Contains("at angle = 0, speed = 0.05, outside of -100 to 0"));
  CHECK_THAT(changed("t.results[2].of = 'beta' t.guess.of = 'beta'"),
             Contains("'beta' is undefined at angle = 0, speed = 0.05, and cannot be guessed"));
  CHECK_THAT(changed("t.graph.x = 'hight'"), Contains("'x' is 'hight', and no slider is of that name"));
  CHECK_THAT(changed("t.graph.by = 'angle'"), Contains("'by' and 'x' are the same slider"));
  CHECK_THAT(changed("t.graph.log = true"), Contains("a logarithmic axis needs a slider of numbers above 0"));
  CHECK_THAT(changed("t.names = { 'disk' }"), Contains("takes two: { what flies, what it meets }"));
  CHECK_THAT(changed("t.intro[1] = '{e}'"), Contains("{e}: 12 settings are there, the first two at angle = 0, speed = "
                                                     "0.05 and angle = 0, speed = 0.1; say which"));
  CHECK_THAT(changed("t.intro[1] = '{e angle=5}'"), Contains("{e angle=5}: no setting has angle = 5"));
  CHECK_THAT(changed("t.intro[1] = '{f angle=0 speed=0.1}'"), Contains("the rows have no column 'f'"));
  CHECK_THAT(changed("t.intro[1] = '{e angle}'"), Contains("{e angle}: write a column and the values of the sliders"));
  CHECK_THAT(changed("t.intro[1] = '{beta angle=0 speed=0.1}'"), Contains("undefined at angle = 0, speed = 0.1"));
  CHECK_THAT(changed("t.intro[1] = 'e is {e angle=0'"), Contains("'{' is not closed: {e angle=0"));
  CHECK_THAT(changed("t.name = 'report'"), Contains("'report.html' is the name of a file that runs leave themselves"));
}

TEST_CASE("a setting is meant by what its numbers are worth, however they came about, and by words of any kind") {
  const Workplace here;
  const std::string over =
      "angle = { 0, 10 * 1.1, 20 + 0.1 + 0.2 }, speed = { 0.1 * 3 - 0.2, 0.15 }, deep = { true, false }";
  std::string text = lesson(R"(t.sliders[2] = { of = "speed", label = "Speed" }
t.sliders[3] = { of = "deep", label = "Deep" }
t.graph.by = nil
t.intuition.right = "{e angle=11 speed=0.1 deep=true}"
t.questions[1].answer = "{e angle=20.3 speed=0.15 deep=false} and {e angle=2.03e1 speed='0.1' deep='true'}")",
                            over);
  const std::string nodes = "nodes = 60";
  text.replace(text.find(nodes), nodes.size(), "nodes = at.deep and 60 or 70");
  const Ended run = here.script(text, "--quiet --no-report");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const Table table = read_table(here.path / "out/grid/results.h5");
  const std::vector<Number> numbers = numbers_in(here.read("out/s/lesson.html"));
  const auto at = [&](std::size_t i, const char* name) {
    return table.number(name)->values[row_of_hash(table, numbers[i].hash)];
  };
  REQUIRE(numbers.size() == 5);
  CHECK((at(2, "angle") == Approx(11) && at(2, "speed") == Approx(0.1)));
  CHECK((at(3, "angle") == Approx(20.3) && at(3, "speed") == Approx(0.15)));
  CHECK((at(4, "angle") == Approx(20.3) && at(4, "speed") == Approx(0.1)));
}

TEST_CASE("a setting that did not finish, and a page that is too large, make no lesson") {
  const Workplace here;
  std::string unfinished = lesson();
  unfinished.replace(unfinished.find("accuracy = 1e-2"), 15, "time_limit = at.angle == 20 and 0.01 or nil");
  CHECK_THAT(here.script(unfinished, "--quiet --no-report").first_line(),
             Contains("the impact at angle = 20, speed = 0.05 ended out_of_time: ") &&
                 Contains("each setting of a lesson must finish"));
  CHECK_THAT(here.script(lesson("t.intro[1] = ('x'):rep(6000000)"), "--quiet --no-report --force").first_line(),
             Contains("the page would have 6.") &&
                 Contains("MB, and a lesson has at most 6; give fewer frames, nodes or settings"));
  CHECK(here.script(lesson(), "--check").status == 0);
}

TEST_CASE("the project's lessons run short, and no answer has a typed decimal number but of a setting") {
  const Workplace here;
  const std::string folder = std::string(RICOCHET_SOURCE) + "/examples/lessons/";
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".lua") continue;
    ++count;
    const std::string name = entry.path().stem();
    const std::string small = name.starts_with("03") ? "fine=5" : name.starts_with("05") ? "side=20" : "nodes=60";
    const Ended run = here.run("--quiet --no-report '" + entry.path().string() + "' frames=3 " + small);
    INFO(name << "\n" << run.err);
    REQUIRE(run.status == 0);
    const std::string html = here.read("out/" + name + "/lesson.html");
    CHECK(numbers_in(html).size() >= 10);
    std::set<std::string> settings;
    for (const std::string& texts : parts_between(html, "\"texts\":[", "]"))
      for (const std::string& number : decimals_in(texts)) settings.insert(number);
    const std::vector<std::string> answers = parts_between(html, "{\"answer\":[", "],\"ask\":");
    CHECK(answers.size() == 5);
    for (const std::string& answer : answers)
      for (const std::string& number : decimals_in(std::regex_replace(answer, std::regex("[{][^}]*[}]"), ""))) {
        INFO(name << ": " << number << " in " << answer);
        CHECK(settings.count(number) == 1);
      }
  }
  CHECK(count == 6);
}
