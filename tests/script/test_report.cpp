// The page that a run leaves, what it says and what it carries. (How it looks in a browser: tests/browser.)

#include <libdeflate.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "record/film.hpp"
#include "scenes.hpp"
#include "script/filmed.hpp"
#include "script/page.hpp"
#include "script/page_sentence.hpp"
#include "script/page_text.hpp"
#include "script/program.hpp"
#include "script/replays.hpp"
#include "script/thinned.hpp"
#include "store/h5md.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

// Impacts at values of psi1, those of e below 0 not finished.
Table results(const std::vector<double>& psi1, const std::vector<double>& e) {
  Table table;
  table.numbers.push_back({{"over_psi1", "number", "", "parameter of the sweep"}, psi1});
  table.numbers.push_back({{"e", "number", "", "restitution"}, e});
  TextColumn status{{"status", "string", "", ""}, {}}, reason{{"reason", "string", "", ""}, {}};
  for (const double value : e) {
    status.values.push_back(value < 0 ? "tunnelled" : "finished");
    reason.values.push_back(value < 0 ? "a node passed" : "");
  }
  table.texts = {status, reason};
  return table;
}

std::vector<double> repeated(const std::vector<double>& values, int times) {
  std::vector<double> list;
  for (int k = 0; k < times; ++k) list.insert(list.end(), values.begin(), values.end());
  return list;
}

// A text of a replay's JSON, in base 64 and deflated, as the `size` bytes that it is of.
std::string unpacked(const std::string& json, const std::string& name, std::size_t size) {
  const std::string mark = "\"" + name + "\":\"";
  const std::size_t begins = json.find(mark) + mark.size();
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = begins; letters.find(json[i]) != std::string::npos; ++i) {
    word = word << 6 | static_cast<std::uint32_t>(letters.find(json[i]));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(word >> bits & 255));
  }
  std::string whole(size, '\0');
  std::size_t written = 0;
  libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
  const auto result =
      libdeflate_zlib_decompress(decompressor, bytes.data(), bytes.size(), whole.data(), size, &written);
  libdeflate_free_decompressor(decompressor);
  REQUIRE(result == LIBDEFLATE_SUCCESS);
  REQUIRE(written == size);
  return whole;
}

// [frame][2 node + k] as the page decodes them. [R]
std::vector<std::vector<double>> places_of(const std::string& json, std::size_t frames, std::size_t coordinates) {
  const std::size_t count = coordinates * frames;
  const std::string planes = unpacked(json, "place", 2 * count);
  std::vector<std::vector<double>> all(frames, std::vector<double>(coordinates));
  for (std::size_t k = 0; k < coordinates; ++k) {
    std::int16_t q = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      const std::size_t at = k * frames + f;
      q = static_cast<std::int16_t>(
          q + (static_cast<unsigned char>(planes[at]) | static_cast<unsigned char>(planes[count + at]) << 8));
      all[f][k] = 1e-3 * q;
    }
  }
  return all;
}

const std::string sweep = R"(-- Walls.
local ricochet = require "ricochet"
local sweep = ricochet.sweep { name = "walls", over = { sample = ricochet.range(2), psi1 = { 0, 1 } }, scene = function(at)
  return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = at.sample }, target = ricochet.plane {},
    launch = { speed = 0.1, psi1 = at.psi1 }, accuracy = 1e-2 } end }
local rows = sweep:run()
)";

}  // namespace

TEST_CASE("the sentence of a report has four forms, and never says more than the errors allow") {
  CHECK(report_sentence(Table{}) == "No impact has run yet, so there is nothing to report.");
  CHECK_THAT(report_sentence(results({0, 1}, {-1, -1})),
             Contains("None of the 2 impacts finished") && Contains("tunnelled: a node passed"));
  CHECK_THAT(
      report_sentence(results({0, 1}, {0.75, -1})),
      Contains("1 of 2 impacts finished: the coefficient of restitution is e = 0.75") && Contains("no error bar"));
  CHECK_THAT(report_sentence(results({0, 0, 1, 1}, {0.7, 0.8, 0.7, 0.8})),
             Contains("4 of 4 impacts finished. ") && Contains("between 0.7 and 0.8. So few impacts") &&
                 !Contains("±") && !Contains("highest") && !Contains("finer"));
  CHECK_THAT(report_sentence(results(repeated({0}, 4), {0.7, 0.8, 0.7, 0.8})),
             Contains("between 0.7 and 0.8, its mean is 0.75 ± 0.029") &&
                 Catch::Matchers::EndsWith(" What a finer lattice or mesh would change is not in these errors."));
  const std::vector<double> psi1 = repeated({0, 0, 1, 1}, 5);
  CHECK_THAT(report_sentence(results(psi1, repeated({0.7, 0.71, 0.9, 0.91}, 5))),
             Contains("20 of 20") && Contains("highest at Ψ₁ = 1 (0.905 ±") && Contains("lowest at Ψ₁ = 0 (0.705 ±") &&
                 Contains("finer lattice"));
  CHECK_THAT(report_sentence(results(psi1, repeated({0.5, 1.1, 0.52, 1.11}, 5))),
             Contains("cannot tell") && !Contains("highest at") && Contains("In 10 of them"));
  CHECK_THAT(report_sentence(results(repeated({0}, 12), repeated({0.9, 1.1}, 6))),
             Contains("Whether the mean is below or above 1 these impacts cannot tell"));
}

TEST_CASE("a lattice struck from both sides is one unit of a report's errors") {
  Table table = results(repeated({0}, 8), {0.9, 0.5, 0.8, 0.6, 0.9, 0.5, 0.8, 0.6});
  const std::string apart = report_sentence(table);
  table.numbers.push_back({{"pair", "number", "", "parameter of the sweep"}, {1, 1, 2, 2, 3, 3, 4, 4}});
  CHECK_THAT(apart, Contains("its mean is 0.7 ± 0.06 "));
  CHECK_THAT(report_sentence(table), Contains("its mean is 0.7 ± 0 ") || Contains("its mean is 0.7 ± 1e-"));
}

TEST_CASE("text of others is shown as it is and executed never") {
  CHECK(html_text("a<b>&\"</script><!--") == "a&lt;b&gt;&amp;&quot;&lt;/script&gt;&lt;!--");
  CHECK(json_text("</script>\"\\\n<!--") == "\"\\u003c/script>\\\"\\\\\\n\\u003c!--\"");
  CHECK(shown_utf8(std::string("a\0b\x01\xff\xc3", 6)) == "a␀b␁\xEF\xBF\xBD\xEF\xBF\xBD");
  CHECK(shown_utf8("ä Ψ₁ 𝛼\t\n") == "ä Ψ₁ 𝛼\t\n");
  CHECK(shown_utf8("\xed\xa0\x80") == "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // half of a surrogate pair
  Page page{.title = "</title><script>alert(1)</script>"};
  page.sections.push_back({"s", results({0, 1}, {0.5, NAN}), {{"script", "</pre><script>x</script>"}}});
  const std::string html = html_of(page);
  CHECK(html.find("<script>alert") == std::string::npos);
  CHECK(html.find("<script>x") == std::string::npos);
  CHECK(html == html_of(page));
  for (const char* address : {"src=\"http", "href=\"http", "src='http", "@import", "url("})
    CHECK(html.find(address) == std::string::npos);
}

TEST_CASE("a page takes the replays that its budget holds, and finds them again") {
  const std::string hash(32, 'a'), other(32, 'b');
  const std::string small = "{\"hash\":\"" + hash + "\"}";
  const std::string large = "{\"hash\":\"" + other + "\",\"place\":\"" + std::string(most_page_bytes, 'x') + "\"}";
  Page page{.title = "t"};
  page.sections.push_back({"s", results({0}, {0.5}), {}, {small, large}});
  const std::string html = html_of(page);
  CHECK(html.size() < most_page_bytes);
  CHECK(replays_in(html) == std::map<std::string, std::string>{{hash, small}});
  CHECK_THAT(html, Contains("1 replay was left out"));
}

TEST_CASE("typical rows are the middle ones of the points, extremes the lowest and highest e") {
  const Table table = results({0, 0, 0, 1, 1, 1}, {0.5, 0.6, 0.9, 0.8, 0.7, -1});
  CHECK(rows_to_replay(table, "typical", 2) == std::vector<std::size_t>{1, 4});
  CHECK(rows_to_replay(table, "typical", 6) == std::vector<std::size_t>{1, 4, 0, 2});
  CHECK(rows_to_replay(table, "extremes", 6) == std::vector<std::size_t>{0, 2});
  CHECK(rows_to_replay(table, "typical", 1).size() == 1);
  CHECK(rows_to_replay(results({0}, {-1}), "typical", 6).empty());
}

TEST_CASE("a page carries the frames that a trajectory file keeps: places to half of 1e-3 R") {
  for (const int seed : {1, 2, 3}) {
    const Scene scene = small_scene(seed, seed - 1);
    const BuiltSolids solids(scene);
    const std::atomic<bool> stop = false;
    const Course course = follow_course(solids, scene, stop);
    const Viewing viewing{.until = course.outcome.time, .step = course.step, .frames = 40};
    const std::string json = replay_json(scene, viewing);
    Trajectory trajectory(frame_mesh(scene, solids));
    film_scene(solids, scene, equal_times(viewing.from, viewing.until, viewing.frames, viewing.step), stop,
               [&](const Frame& frame) { trajectory.add(frame); });
    const Workplace place;
    write_h5md(place.path / "trajectory.h5", trajectory, {});
    const Trajectory stored = read_trajectory(place.path / "trajectory.h5");
    const std::vector<Frame>& frames = stored.frames();
    REQUIRE(frames.size() == 40);
    CHECK(json.find("\"frames\":40,\"grid\":0.001,") != std::string::npos);
    CHECK(json.find(scene.hash()) != std::string::npos);
    const std::vector<std::vector<double>> shown = places_of(json, frames.size(), frames[0].position.size());
    double worst = 0;
    for (std::size_t f = 0; f < frames.size(); ++f)
      for (std::size_t k = 0; k < shown[f].size(); ++k)
        worst = std::max(worst, std::abs(shown[f][k] - static_cast<double>(frames[f].position[k])));
    CHECK(worst <= 0.5e-3 * (1 + 1e-6));
    CHECK(json == replay_json(scene, viewing));
  }
}

TEST_CASE("a thinned replay has some moments of the whole one, in all that it carries") {
  const Scene scene = small_scene();
  const std::string whole = replay_json(scene, {.until = 6, .step = 0.01, .frames = 31});
  const std::string thin = thinned(whole, 7);
  CHECK(thinned(whole, 31) == whole);
  CHECK(thinned(whole, 500) == whole);
  const auto count = [](const std::string& json, const std::string& name) {
    return std::stoul(json.substr(json.find("\"" + name + "\":") + name.size() + 3));
  };
  CHECK(count(thin, "frames") == 7);
  const std::size_t nodes = count(whole, "nodes");
  const auto of_whole = places_of(whole, 31, 2 * nodes), of_thin = places_of(thin, 7, 2 * nodes);
  for (std::size_t f = 0; f < 7; ++f) CHECK(of_thin[f] == of_whole[5 * f]);
  CHECK(unpacked(thin, "colour", nodes * 7).size() == nodes * 7);
  const auto times = [](const std::string& json) {
    const std::size_t begins = json.find("\"time\":[") + 8;
    return json.substr(begins, json.find(']', begins) - begins);
  };
  CHECK(std::ranges::count(times(thin), ',') == 6);
  CHECK(times(thin).substr(0, times(thin).find(',')) == times(whole).substr(0, times(whole).find(',')));
  CHECK(times(thin).substr(times(thin).rfind(',')) == times(whole).substr(times(whole).rfind(',')));
  std::string damaged = whole;
  damaged[damaged.find("\"place\":\"") + 40] = '*';
  CHECK_THROWS_WITH(thinned(damaged, 7), Contains("a replay of the earlier report is damaged"));
}

namespace {

struct Touch {
  double first = NAN, last = NAN, most = 0;
};

// Where the force is more than a thousandth of the greatest.
Touch touch_of(const std::vector<double>& times, const std::vector<double>& force) {
  Touch touch;
  for (const double f : force) touch.most = std::max(touch.most, std::abs(f));
  for (std::size_t k = 0; k < force.size(); ++k)
    if (std::abs(force[k]) > 1e-3 * touch.most) {
      if (std::isnan(touch.first)) touch.first = times[k];
      touch.last = times[k];
    }
  return touch;
}

// The list of this name in a part of a replay's JSON.
std::vector<double> list_in(const std::string& json, const std::string& part, const std::string& name) {
  const std::size_t at = json.find("\"" + part + "\":{"),
                    begins = json.find("\"" + name + "\":[", at) + name.size() + 4;
  std::istringstream text(json.substr(begins, json.find(']', begins) - begins));
  std::vector<double> numbers;
  for (std::string number; std::getline(text, number, ',');) numbers.push_back(std::stod(number));
  return numbers;
}

}  // namespace

TEST_CASE("a replay tells the forces between its frames, too: peaks and touches are where the impact has them") {
  double worst = 1;  // of the greatest force, the share that frames alone would tell
  for (const int seed : {1, 2, 3, 4}) {
    const Scene scene = small_scene(seed);
    const BuiltSolids solids(scene);
    const std::atomic<bool> stop = false;
    const Course course = follow_course(solids, scene, stop);
    const Viewing viewing{.until = course.outcome.time, .step = course.step, .frames = 12};
    const std::string json = replay_json(scene, viewing);
    std::vector<double> times, force;  // at each step
    const Sampling every_step{equal_times(0, viewing.until, 1 << 20, course.step), [&](const Sample& sample) {
                                times.push_back(sample.time);
                                force.push_back(sample.force.y());
                              }};
    REQUIRE(film_scene(
        solids, scene, {0, viewing.until}, stop, [](const Frame&) {}, every_step));
    const std::vector<double> told_times = list_in(json, "forces", "time"), frames = list_in(json, "series", "time");
    const Touch all = touch_of(times, force), told = touch_of(told_times, list_in(json, "forces", "force_n"));
    CHECK(frames.size() == 12);
    CHECK(told_times.size() == list_in(json, "forces", "force_t").size());
    CHECK(told_times.front() == frames.front());
    CHECK(told_times.back() == frames.back());
    const double spacing = (viewing.until - viewing.from) / 11;
    for (const auto& [known, shown] : {std::pair{all.first, told.first}, std::pair{all.last, told.last}})
      CHECK(std::abs(shown - known) < spacing / 8 + course.step);
    CHECK(told.most > 0.95 * all.most);
    worst = std::min(worst, touch_of(frames, list_in(json, "series", "force_n")).most / all.most);
  }
  CHECK(worst < 0.95);
}

TEST_CASE("a replay of a mirrored row moves as the row tells it") {
  const Viewing viewing{.from = -1, .until = 4, .step = 0.01, .frames = 24};
  const auto first_x = [&](const Scene& of) {
    const std::string json = replay_json(of, viewing), mark = "\"x\":[";
    return std::stod(json.substr(json.find(mark) + mark.size()));
  };
  const Scene mirrored = small_scene().struck_from_other_side();
  Scene other = mirrored;
  other.mirrored = false;
  CHECK(first_x(small_scene()) < 0);  // it comes from the left
  CHECK(first_x(other) > 0);
  CHECK(first_x(mirrored) == -first_x(other));
}

TEST_CASE("a sweep records rows' own scenes: their hashes and numbers are the rows'") {
  const Workplace place;
  const Ended run = place.script(sweep + R"(
for _, chosen in ipairs { { rows = { 1, rows[4] } }, { replay = "extremes", frames = 30 } } do
  local ok, made = pcall(function() return sweep:record(chosen) end)
  if not ok then print(made) break end
  for _, one in ipairs(made) do
    local found = false
    for _, row in ipairs(rows) do
      found = found or row.scene_hash == one.scene_hash and row.e == one.e and row.vt == one.vt and row.steps == one.steps
    end
    assert(found)
  end
  print(#made)
end
)");
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK_THAT(run.out, Contains("\n2\n"));
  const Ended early = place.script(
      "local ricochet = require \"ricochet\"\nricochet.sweep { name = \"w\", over = { sample = { 1 } }, scene = "
      "function() end }:record { replay = \"typical\" }",
      "--new");
  CHECK(early.status == 1);
  CHECK_THAT(early.err, Contains("call sweep:run() first"));
}

TEST_CASE("a run leaves a report with replays of its rows, unless told not to") {
  const Workplace place;
  const Ended run = place.script(sweep + "ricochet.report { title = \"Two walls\", replays = 3, frames = 30 }\n");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const std::string html = place.read("out/s/report.html");
  CHECK_THAT(html, Contains("<h1>Two walls</h1>") && Contains("4 of 4 impacts finished"));
  const auto replays = replays_in(html);
  CHECK(replays.size() == 3);
  const std::string csv = place.read("out/walls/results.csv");
  for (const auto& [hash, replay] : replays) {
    CHECK(csv.find(hash) != std::string::npos);
    CHECK(replay.find("\"frames\":30,") != std::string::npos);
  }
  CHECK(place.shell("ricochet report out --title Again --replays 2").status == 0);
  const std::string again = place.read("out/report.html");
  CHECK_THAT(again, Contains("<h1>Again</h1>"));
  CHECK(replays_in(again).size() == 2);
  CHECK(place.shell("ricochet report out --frames 5 --out few.html").status == 0);
  for (const auto& [hash, replay] : replays_in(place.read("few.html")))
    CHECK(replay.find("\"frames\":5,") != std::string::npos);
  CHECK(place.shell("ricochet report nowhere").status == 4);
  const Workplace bare;
  CHECK(bare.script(sweep, "--no-report").status == 0);
  CHECK(!fs::exists(bare.path / "out/s"));
}

TEST_CASE("a report shows what the script has plotted, and replays the rows that it names") {
  const Workplace place;
  const Ended run = place.script(sweep + R"lua(
ricochet.plot { rows = rows, x = "psi1", y = { "contact_time" }, name = "times",
  theory = { contact_time = { { name = "a guess", f = function(x) return 5 + x end } } },
  published = { contact_time = { { name = "somebody", points = { { 0, 4 }, { 2, 6 } } } } } }
ricochet.report { rows = { rows[2] }, frames = 10 }
print("hash: " .. rows[2].scene_hash)
)lua",
                                 "--quiet");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const std::string html = place.read("out/s/report.html");
  CHECK_THAT(
      html,
      Contains(R"("plots":[{"x":"psi1","columns":["contact_time"],"lines":[)") &&
          Contains(R"({"of":"contact_time","label":"somebody","marks":true,"against":"psi1","x":[0,2],"y":[4,6]})") &&
          Contains(R"("label":"a guess","marks":false,"against":"psi1")"));
  const auto replays = replays_in(html);
  REQUIRE(replays.size() == 1);
  CHECK_THAT(run.out, Contains("hash: " + replays.begin()->first));
  CHECK_THAT(place.script(sweep + "ricochet.report { rows = { 3 } }\n", "--quiet --force").first_line(),
             Contains("element 1 is no row of a sweep"));
  for (const std::string both : {"replays = 2", "replay = 'extremes'"})
    CHECK_THAT(
        place.script(sweep + "ricochet.report { rows = { rows[1] }, " + both + " }\n", "--quiet --force").first_line(),
        Contains("report: '" + both.substr(0, both.find(' ')) +
                 "': says nothing beside rows, all of which are replayed; leave one of them out"));
}

TEST_CASE("every row that a report names is replayed, however many they are") {
  const Workplace place;
  const Ended run = place.script(R"lua(local ricochet = require "ricochet"
local sweep = ricochet.sweep { name = "drops", over = { speed = ricochet.range(0.05, 0.13, 0.01) }, scene = function(at)
  return ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.plane {},
    launch = { speed = at.speed } } end }
local rows = sweep:run()
assert(#rows == 9)
ricochet.report { rows = rows, frames = 4 })lua",
                                 "--quiet");
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK(replays_in(place.read("out/s/report.html")).size() == 9);
}

TEST_CASE("a script of single scenes leaves a report, whatever else it leaves") {
  const Workplace place;
  const Ended run = place.script(R"lua(local ricochet = require "ricochet"
print(ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.plane {} }:run().e))lua");
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK(replays_in(place.read("out/s/report.html")).size() == 1);
  CHECK(place.run("s.lua").status == 0);  // there is nothing to be lost
}

TEST_CASE("a report of an interrupted run that goes on is made at its end") {
  const Workplace place;
  CHECK(place.script(sweep, "--no-report").status == 0);
  CHECK(place.script(sweep, "--resume").status == 0);
  CHECK(replays_in(place.read("out/s/report.html")).size() >= 2);
}

TEST_CASE("a page of a hundred thousand rows is small enough to send, with a column of which nothing is known") {
  constexpr std::size_t many = 100'000;
  std::vector<double> psi1(many), e(many);
  for (std::size_t i = 0; i < many; ++i) {
    psi1[i] = static_cast<double>(i % 10);
    e[i] = 0.8 + 0.01 * psi1[i] + 1e-3 * static_cast<double>(i * 7919 % 100);
  }
  Table table = results(psi1, e);
  table.numbers.push_back({{"mu", "number", "", "impulse ratio"}, std::vector<double>(many, not_given)});
  Page page;
  page.title = "Many";
  page.sections = {{"many", table, {}}};
  const std::string html = html_of(page);
  CHECK(html.size() < most_page_bytes);
  CHECK_THAT(html, Contains("100000 of 100000 impacts finished"));
  // For a look in a browser: RICOCHET_PAGE=/tmp/many.html.
  if (const char* file = std::getenv("RICOCHET_PAGE")) std::ofstream(file) << html;
}

TEST_CASE("the library of plots is the one of its checksums") {
  const Workplace place;
  const Ended checked =
      place.shell(std::string("cd '") + RICOCHET_SOURCE + "/render/report/uplot' && sha256sum -c checksums.sha256");
  INFO(checked.out << checked.err);
  CHECK(checked.status == 0);
}
