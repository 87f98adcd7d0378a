// ricochet.lesson: the impacts of a grid as one page for a class (lua/ricochet/lesson.lua puts its words together).

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "impact/parallel.hpp"
#include "script/filmed.hpp"
#include "script/objects.hpp"
#include "script/page.hpp"
#include "script/page_sources.hpp"
#include "script/page_text.hpp"
#include "script/replays.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

/// What a lesson may weigh: it is sent by post and messenger, to telephones too.
constexpr std::size_t most_lesson_bytes = 6'000'000;

std::string json_at(lua_State* L, int index);

std::string list_json(lua_State* L, int index) {
  std::string list;
  each_element(L, index, [&](lua_Integer i) { list += (i > 1 ? "," : "") + json_at(L, -1); });
  return "[" + list + "]";
}

// Names in order, so that equal tables are equal texts.
std::string object_json(lua_State* L, int index) {
  std::vector<std::string> names = names_in(L, index);
  std::sort(names.begin(), names.end());
  std::string list;
  for (const std::string& name : names) {
    lua_getfield(L, index, name.c_str());
    list += (list.empty() ? "" : ",") + json_text(name) + ":" + json_at(L, -1);
    lua_pop(L, 1);
  }
  return "{" + list + "}";
}

// A value of plain tables, in which one without names is a list.
std::string json_at(lua_State* L, int index) {
  index = lua_absindex(L, index);
  std::size_t length = 0;
  switch (lua_type(L, index)) {
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) ? "true" : "false";
    case LUA_TNUMBER:
      return json_number(lua_tonumber(L, index));
    case LUA_TSTRING: {
      const char* text = lua_tolstring(L, index, &length);
      return json_text({text, length});
    }
    case LUA_TTABLE:
      return names_in(L, index).empty() ? list_json(L, index) : object_json(L, index);
    default:
      return "null";
  }
}

// A flight in and a flight out, so that a pupil sees the body come and go: shares of the time that the impact takes.
constexpr double flight_in = 0.3, flight_out = 0.4;

struct Shown {
  Scene scene;
  Viewing viewing;
  std::string json{};
};

// Every row's impact once more, to be seen.
std::vector<std::string> replays_of_all(lua_State* L, const Table& table, const Swept& swept, int frames) {
  std::vector<Shown> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::optional<Scene> made = swept.scene_of(table.text("scene_hash")->values[row]);
    if (!made)
      throw at_this_call(L, "the function 'scene' returned another scene than before; it must depend on `at` alone");
    const Scene& scene = *made;
    Viewing viewing = viewing_of(table, row, scene, frames);
    viewing.from = -flight_in * viewing.until;
    viewing.until *= 1 + flight_out;
    rows.push_back({scene, viewing});
  }
  try {
    in_parallel(rows, session_of(L).options.threads,
                [](Shown& row) { row.json = replay_json(row.scene, row.viewing); });
  } catch (const FieldError& error) {
    throw at_this_call(L, std::string("an impact of the grid cannot be shown: ") + error.what());
  }
  if (stop_requested) throw Error("interrupted before the lesson; the results are stored", Exit::interrupted);
  std::vector<std::string> replays;
  for (Shown& row : rows) {
    if (row.json.empty())
      throw at_this_call(
          L, fmt::format("the bodies of the grid have too many nodes to be shown in {} frames; give fewer of either",
                         frames));
    replays.push_back(std::move(row.json));
  }
  return replays;
}

std::string page_of_lesson(const std::string& title, const std::string& words, const PageSection& section,
                           const std::string& log) {
  using namespace page_source;
  PageParts parts{.frame = page_source::lesson_html,
                  .kind = "lesson",
                  .styles = {uplot_uPlot_min_css, page_css, lesson_css},
                  .code = {uplot_uPlot_iife_js, decode_js, words_js, replay_js, player_js, lesson_graph_js, lesson_js},
                  .title = title,
                  .data = fmt::format("{{\"title\":{},\"log\":{},\"lesson\":{},\"sections\":[{}]}}", json_text(title),
                                      json_text(log), words, section_json(section, "")),
                  .script = script_in(section)};
  for (const std::string& replay : section.replays) parts.replays += replay_element(replay);
  return assembled(parts);
}

// write_lesson(sweep, file, title, words, frames): words are what the page's script reads as pageData.lesson.
int write_lesson(lua_State* L) {
  Session& session = session_of(L);
  const Swept* swept = swept_named(session, luaL_checkstring(L, 1));
  if (!swept) throw at_this_call(L, "the grid has not run; call run() of the sweep first");
  const fs::path path = claimed_path(L, "name", luaL_checkstring(L, 2) + std::string(".html"));
  const fs::path results = run_names::readable_results(swept->folder);
  PageSection section{swept->name, read_table(results), read_provenance(results)};
  section.replays = replays_of_all(L, section.table, *swept, static_cast<int>(luaL_checkinteger(L, 5)));
  const std::string html = page_of_lesson(luaL_checkstring(L, 3), json_at(L, 4), section, shown_log(session.logged()));
  if (html.size() > most_lesson_bytes)
    throw at_this_call(
        L, fmt::format("the page would have {:.1f} MB, and a lesson has at most {:.0f}; give fewer frames, nodes "
                       "or settings",
                       static_cast<double>(html.size()) / 1e6, static_cast<double>(most_lesson_bytes) / 1e6));
  write_atomically(path, html);
  session.inform(fmt::format("lesson: {} ({} settings, {:.1f} MB)\n", path.string(), section.table.rows(),
                             static_cast<double>(html.size()) / 1e6));
  return 0;
}

constexpr const char* numbers_of_rows =
    " In curly braces a text may hold numbers of the rows: {e angle=60 wall='soft mat'} is e there, to the digits of "
    "its result, {e:2 angle=60} to two; {angle greatest=e} is the angle where e is greatest, and least=e where least";

Function lesson_function() {
  return {
      .name = "lesson",
      .doc =
          "Makes NAME.html of a sweep that has run, a page for a class: sliders over the sweep's settings, a guess "
          "before each result, the replay of each setting's own impact, a graph that fills as the pupil tries, "
          "questions with folded answers. One file of at most 6 MB without network, beside the report.",
      .fields = {{"grid", "sweep", "", "that has run, over one to three names: at least 12 settings, each finished"},
                 {"title", "string", "", "of the page"},
                 {"intro", "strings", "", std::string("paragraphs below the title.") + numbers_of_rows},
                 {"names", "strings", "", "what projectile and target are called", any_number,
                  "{ \"body\", \"target\" }"},
                 {"sliders", "slider[]", "", "one for each name of the sweep that varies"},
                 {"results", "result[]", "", "what is told of an impact after the guess"},
                 {"guess", "guess", "", "what is to be guessed"},
                 {"graph", "graph", "", "what the guessed result is drawn against"},
                 {"intuition", "intuition", "",
                  "a wrong idea that many people have, shown once five settings were tried"},
                 {"questions", "question[]", "", "with answers that are folded away"},
                 {"teacher", "strings", "", "paragraphs for the teacher: how to use it, what goes wrong"},
                 {"minutes", "number", "min", "that it takes in class", positive, "10"},
                 {"processor_time", "number", "s", "stated: of one core, by the whole script", positive},
                 {"frames", "integer", "", "of each replay", {2, 400}, "60"},
                 {"name", "string", "", "of the file", any_number, "lesson"}},
      .returns = "nothing",
      .example =
          "ricochet.lesson { grid = sweep, title = \"Drop and bounce\", sliders = { { of = \"height\", label = "
          "\"Height\", unit = \"m\" } }, ... }"};
}

Function slider_table() {
  return {.name = "slider",
          .doc = "An element of a lesson's `sliders`: how a name of the sweep's `over` is called.",
          .fields = {{"of", "string", "", "the name"},
                     {"label", "string", "", "what people call it"},
                     {"unit", "string", "", "behind its values", any_number, "", true},
                     {"texts", "strings", "", "one for each value, instead of the values themselves", any_number, "",
                      true}},
          .is_table = true};
}

Function result_table() {
  return {
      .name = "result",
      .doc = "An element of a lesson's `results`: a column of the rows, or one that the script has put into each row.",
      .fields = {{"of", "string", "", "the column"},
                 {"label", "string", "", "what people call it"},
                 {"unit", "string", "", "behind its numbers", any_number, "", true},
                 {"digits",
                  "integer",
                  "",
                  "that are shown of its greatest number; the others have as many decimals",
                  {1, 8},
                  "3"}},
      .is_table = true};
}

Function guess_table() {
  return {.name = "guess",
          .doc = "The `guess` of a lesson: a slider for the expected result. No impact may lie outside its range.",
          .fields = {{"of", "string", "", "the result"},
                     {"question", "string", "", "above the slider"},
                     {"from", "number", "", "its least value"},
                     {"to", "number", "", "its greatest value"},
                     {"step", "number", "", "between two values", positive}},
          .is_table = true};
}

Function graph_table() {
  return {
      .name = "graph",
      .doc = "The `graph` of a lesson: the guessed result of what was tried, against a slider or the number of tries.",
      .fields = {{"x", "string", "",
                  "the name of a slider; or tries, which draws the mean of the tries with its standard error, too"},
                 {"by", "string", "", "a slider whose values are told apart by colour and shape", any_number, "", true},
                 {"log", "boolean", "", "along x", any_number, "false"}},
      .is_table = true};
}

Function intuition_table() {
  return {.name = "intuition",
          .doc = "The `intuition` of a lesson.",
          .fields = {{"wrong", "string", "", "the wrong idea"},
                     {"right", "string", "", std::string("how it is.") + numbers_of_rows}},
          .is_table = true};
}

Function question_table() {
  return {.name = "question",
          .doc = "An element of a lesson's `questions`.",
          .fields = {{"ask", "string", "", "the question"},
                     {"answer", "string", "", std::string("folded away.") + numbers_of_rows}},
          .is_table = true};
}

}  // namespace

Group lesson_functions() {
  return {.functions = {lesson_function(), slider_table(), result_table(), guess_table(), graph_table(),
                        intuition_table(), question_table()},
          .natives = {{"write_lesson", guarded<write_lesson>}}};
}

}  // namespace ricochet
