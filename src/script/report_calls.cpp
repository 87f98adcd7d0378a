// ricochet.report, and the recordings of a sweep's rows.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "script/fields.hpp"
#include "script/filmed.hpp"
#include "script/objects.hpp"
#include "script/records.hpp"
#include "script/replays.hpp"
#include "script/run_files.hpp"
#include "script/run_report.hpp"
#include "store/run_names.hpp"
#include "store/sinks.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

std::string text_field(lua_State* L, const char* name) {
  std::string text;
  std::size_t length = 0;
  if (lua_getfield(L, 1, name) == LUA_TSTRING) {
    const char* bytes = lua_tolstring(L, -1, &length);
    text.assign(bytes, length);
  }
  lua_pop(L, 1);
  return text;
}

// The numbers of a field of the table on top of the stack, which is element `i` of lines.
std::vector<double> line_numbers(lua_State* L, const char* name, lua_Integer i) {
  std::vector<double> numbers;
  if (lua_getfield(L, -1, name) != LUA_TTABLE)
    throw_here(L, FieldError("lines", fmt::format("line {} has no list '{}' of numbers", i, name)));
  numbers = numbers_at(L, lua_gettop(L));
  lua_pop(L, 1);
  return numbers;
}

std::string line_text(lua_State* L, const char* name, lua_Integer i) {
  if (lua_getfield(L, -1, name) != LUA_TSTRING)
    throw_here(L, FieldError("lines", fmt::format("line {} has no text '{}'", i, name)));
  const std::string text = lua_tostring(L, -1);
  lua_pop(L, 1);
  return text;
}

void read_lines(lua_State* L, PageWish& wish) {
  each_in_field(L, 1, "lines", [&](lua_Integer i) {
    if (!lua_istable(L, -1))
      throw_here(L, FieldError("lines", fmt::format("line {} is no table {{ of, label, x, y }}", i)));
    PageLine line{line_text(L, "of", i), line_text(L, "label", i), line_numbers(L, "x", i), line_numbers(L, "y", i)};
    if (line.x.size() != line.y.size())
      throw_here(L, FieldError("lines", fmt::format("line {} has {} x and {} y", i, line.x.size(), line.y.size())));
    wish.lines.push_back(std::move(line));
  });
}

// The hashes of the scenes of rows in a field.
std::vector<std::string> row_hashes(lua_State* L, const char* field) {
  std::vector<std::string> hashes;
  each_in_field(L, 1, field, [&](lua_Integer i) {
    if (!lua_istable(L, -1) || lua_getfield(L, -1, "scene_hash") != LUA_TSTRING)
      throw_here(L, FieldError(field, fmt::format("element {} is no row of a sweep", i)));
    hashes.push_back(lua_tostring(L, -1));
    lua_pop(L, 1);
  });
  return hashes;
}

// What the report says beside what every report says; the last call holds.
int report_wish(lua_State* L) {
  check_table(L, 1, function_named("report"));
  for (const char* field : {"replay", "replays"})
    if (has_field(L, 1, "rows") && has_field(L, 1, field))
      throw_here(L, FieldError(field, "says nothing beside rows, all of which are replayed; leave one of them out"));
  PageWish wish;
  wish.title = text_field(L, "title");
  wish.notes = text_field(L, "notes");
  if (const std::string which = text_field(L, "replay"); !which.empty()) wish.which = which;
  const auto whole = [&](const char* name, int value) {
    if (lua_getfield(L, 1, name) == LUA_TNUMBER) value = static_cast<int>(lua_tointeger(L, -1));
    lua_pop(L, 1);
    return value;
  };
  wish.replays = whole("replays", wish.replays);
  wish.frames = whole("frames", wish.frames);
  each_in_field(L, 1, "questions", [&](lua_Integer) { wish.questions.push_back(lua_tostring(L, -1)); });
  each_in_field(L, 1, "plots", [&](lua_Integer) { wish.plots.push_back(lua_tostring(L, -1)); });
  wish.hashes = row_hashes(L, "rows");
  read_lines(L, wish);
  session_of(L).page = wish;
  return 0;
}

// plotted(hash, x, y, curves): what a script's plot shows of the sweep that has a row of this scene, for the report.
int plotted(lua_State* L) {
  PagePlot plot;
  const std::string hash = luaL_checkstring(L, 1);
  plot.x = luaL_checkstring(L, 2);
  each_element(L, 3, [&](lua_Integer) { plot.columns.push_back(lua_tostring(L, -1)); });
  each_element(L, 4, [&](lua_Integer i) {
    PageLine line{line_text(L, "of", i), line_text(L, "label", i), line_numbers(L, "x", i), line_numbers(L, "y", i)};
    lua_getfield(L, -1, "marks");
    line.marks = lua_toboolean(L, -1);
    lua_pop(L, 1);
    line.against = plot.x;
    plot.lines.push_back(std::move(line));
  });
  session_of(L).plotted.emplace_back(hash, std::move(plot));
  return 0;
}

// The rows that a call means, by the hashes of their scenes: those of the list at index 2, or chosen as it says.
std::vector<std::string> wanted_hashes(lua_State* L, const Swept& swept) {
  std::vector<std::string> hashes;
  if (lua_istable(L, 2)) {
    each_element(L, 2, [&](lua_Integer) { hashes.push_back(lua_tostring(L, -1)); });
    return hashes;
  }
  const Table table = table_of_results(run_names::readable_results(swept.folder));
  const TextColumn* column = table.text("scene_hash");
  for (const std::size_t row : rows_to_replay(table, lua_tostring(L, 2), 6)) hashes.push_back(column->values[row]);
  return hashes;
}

FilmedScene filmed_row(lua_State* L, const Swept& swept, const std::string& hash) {
  const std::optional<Scene> scene = swept.scene_of(hash);
  if (!scene)
    throw at_this_call(L, fmt::format("the sweep {} has no row of scene {}; give rows of its own", swept.name, hash));
  return {*scene, call_site(L), BuiltSolids(*scene)};
}

// Writes NAME_HASH.h5 and its companions.
void record_row(lua_State* L, const Swept& swept, std::vector<FilmedScene>& scenes, int frames) {
  const std::string name = fmt::format("{}_{}", swept.name, scenes[0].scene.hash().substr(0, 8));
  const fs::path path = claimed_files(L, "rows", name, trajectory_sinks());
  follow(L, scenes);
  store_recording(L, scenes, path, {.frames = frames, .from = 0});
}

// record_rows(name, hashes or how, frames): records rows of a sweep that has run; a list of what their impacts gave.
int record_rows(lua_State* L) {
  Session& session = session_of(L);
  const int frames = static_cast<int>(luaL_checkinteger(L, 3));
  lua_newtable(L);
  const int list = lua_gettop(L);
  if (session.options.check) return 1;
  const Swept* swept = swept_named(session, luaL_checkstring(L, 1));
  if (!swept) throw at_this_call(L, "this sweep has not run; call sweep:run() first");
  lua_Integer count = 0;
  for (const std::string& hash : wanted_hashes(L, *swept)) {
    std::vector<FilmedScene> scenes{filmed_row(L, *swept, hash)};
    record_row(L, *swept, scenes, frames);
    push_row(L, row_of(scenes[0].scene, scenes[0].course.outcome, 0));
    lua_seti(L, list, ++count);
  }
  lua_settop(L, list);
  return 1;
}

Function report_function() {
  return {
      .name = "report",
      .doc =
          "Adds to report.html, the page that every run leaves in its folder: a title, notes, questions to think "
          "about, lines of theory over the plots, which columns are plotted and which impacts replayed. What "
          "ricochet.plot draws of a sweep, lines of theory and published points too, stands in the report of "
          "itself. The last call holds.",
      .fields = {{"title", "string", "", "of the page; the first line of the script, if a comment", any_number, "",
                  true},
                 {"notes", "string", "", "a paragraph below the title", any_number, "", true},
                 {"questions", "strings", "", "listed below the notes", any_number, "", true},
                 {"plots", "strings", "",
                  "columns to plot; unless given, what ricochet.plot has drawn, and e, mu and beta", any_number, "",
                  true},
                 {"rows", "table", "", "rows to replay, all of them and however long it takes, instead of typical ones",
                  any_number, "", true},
                 {"lines", "table", "", "theory as a list of { of = column, label =, x = list, y = list }", any_number,
                  "", true},
                 {"replay", "string", "", "which impacts", any_number, "typical", false, {"typical", "extremes"}},
                 {"replays",
                  "integer",
                  "",
                  "how many, all sweeps together; 0: none; of rows that are chosen, not named",
                  {0, 100},
                  "6"},
                 {"frames", "integer", "", "of each replay; fewer of bodies with many nodes", {2, 2000}, "120"}},
      .returns = "nothing",
      .example = "ricochet.report { title = \"Soft walls\", notes = \"Which wall gives e > 1?\" }",
      .call = guarded<report_wish>};
}

// lua/ricochet/sweep.lua
Function record_function() {
  return {.name = "sweep:record",
          .doc =
              "Records rows' own scenes, with the method and step that the sweep's `accuracy` chose, as "
              "SWEEP_HASH.h5 and .xdmf in the run's folder, in the manner of ricochet.record. Returns a list of what "
              "their impacts gave: rows equal to the sweep's.",
          .fields = {{"rows", "table", "", "rows of the sweep, or their numbers", any_number, "", true},
                     {"replay",
                      "string",
                      "",
                      "instead: up to six that show what is typical, or the lowest and highest e",
                      any_number,
                      "",
                      true,
                      {"typical", "extremes"}},
                     {"frames", "integer", "", "of each", {2, 1e6}, "120"}},
          .returns = "table",
          .example = "sweep:record { replay = \"extremes\" }"};
}

}  // namespace

Group report_functions() {
  return {.functions = {record_function(), report_function()},
          .natives = {{"record_rows", guarded<record_rows>}, {"plotted", guarded<plotted>}}};
}

}  // namespace ricochet
