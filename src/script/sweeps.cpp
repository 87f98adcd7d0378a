// ricochet.sweep and its rows: scenes to rows, in parts that survive a kill.

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <unordered_set>

#include "impact/sweep.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/step_choice.hpp"
#include "script/sweep_report.hpp"
#include "script/sweep_store.hpp"
#include "store/run_names.hpp"

namespace ricochet {
namespace {

using Clock = std::chrono::steady_clock;

SweepOptions options_of(const Session& session) {
  SweepOptions options;
  options.threads = session.options.threads;
  if (session.options.batch > 0) options.batch = session.options.batch;
  return options;
}

void warn_of_twins(Session& session, const std::string& name, const std::vector<std::string>& hashes) {
  const std::size_t once = std::unordered_set<std::string>(hashes.begin(), hashes.end()).size();
  if (once == hashes.size()) return;
  session.warn(
      fmt::format("{}: {} of {} scenes repeat another one exactly, so they are no samples of their own; does every "
                  "name of 'over' reach the scene?",
                  name, hashes.size() - once, hashes.size()));
}

/// A sweep that runs in rounds has all its scenes so far in each, and ends with them once more.
enum class Stage { whole, first_round, round, last };

/// A sweep that a script runs.
struct Request {
  std::string name;
  Parameters parameters;
  std::vector<Scene> scenes;
  Stage stage = Stage::whole;
  std::string stored = {};  ///< what an error leaves behind

  SceneName scene_name() const {
    return [this](std::size_t scene) { return parameters.place(scene); };
  }
  bool goes_on() const { return stage == Stage::first_round || stage == Stage::round; }
  Earlier earlier(bool resume) const {
    const bool begins = stage == Stage::whole || stage == Stage::first_round;
    return {resume || !begins, goes_on()};
  }
};

// Returns what it made of the machine.
SweepUse run_and_store(Session& session, Store& store, const Request& sweep, const std::vector<std::string>& hashes) {
  const std::vector<Scene>& scenes = sweep.scenes;
  std::vector<bool> todo(scenes.size());
  std::map<std::string, std::size_t> first;  // a scene that occurs twice runs once
  for (std::size_t i = 0; i < scenes.size(); ++i) todo[i] = !store.done()[i] && first.emplace(hashes[i], i).second;
  warn_of_twins(session, sweep.name, hashes);
  const Storing storing;
  Progress progress(session, sweep.name, scenes.size(), store.count());
  SweepUse use;
  const auto keep = [&](const std::vector<Result>& results) {
    std::vector<std::pair<std::size_t, Row>> batch;
    std::size_t failed = 0;
    for (const Result& result : results) {
      batch.emplace_back(result.index, row_of(scenes[result.index], result.outcome, result.seconds));
      failed += result.outcome.status != Status::finished;
    }
    const std::size_t before = store.count();
    store.add(batch);
    progress.add(store.count() - before, failed);
  };
  if (!run_chosen(scenes, todo, options_of(session), stop_requested, keep, printed(session, sweep.scene_name()),
                  &use)) {
    store.stop_early();
    throw Error("interrupted: " + store.left_behind(), Exit::interrupted);
  }
  return use;
}

// Each name's values at all points: of numbers, or of texts.
Parameters read_parameters(lua_State* L, int names, int points, int units) {
  Parameters p;
  each_element(L, names, [&](lua_Integer) { p.names.push_back(lua_tostring(L, -1)); });
  p.numbers.resize(p.names.size());
  p.texts.resize(p.names.size());
  for (std::size_t k = 0; k < p.names.size(); ++k)
    each_element(L, points, [&](lua_Integer) {
      const int type = lua_getfield(L, -1, p.names[k].c_str());
      if (type == LUA_TNUMBER)
        p.numbers[k].push_back(lua_tonumber(L, -1));
      else
        p.texts[k].push_back(type == LUA_TBOOLEAN ? (lua_toboolean(L, -1) ? "true" : "false") : lua_tostring(L, -1));
      lua_pop(L, 1);
    });
  p.units.resize(p.names.size());
  for (std::size_t k = 0; lua_istable(L, units) && k < p.names.size(); ++k) {
    if (lua_getfield(L, units, p.names[k].c_str()) == LUA_TSTRING) p.units[k] = lua_tostring(L, -1);
    lua_pop(L, 1);
  }
  return p;
}

std::vector<Scene> scenes_at(lua_State* L, int list) {
  std::vector<Scene> scenes;
  each_element(L, list, [&](lua_Integer) { scenes.push_back(scene_at(L, -1).scene); });
  return scenes;
}

// Throws the error of a scene of the list at the place that made it; `where`: more about it.
[[noreturn]] void throw_at_scene(lua_State* L, int list, const SceneError& error, const std::string& where = "") {
  lua_rawgeti(L, list, static_cast<lua_Integer>(error.scene) + 1);
  const SceneObject& object = scene_at(L, -1);
  throw_at(session_of(L), object.site, FieldError(error.field, object.scene.units.explained(error.what()) + where));
}

// struck_from_other_side(scene): the same bodies, whose row tells the impact as seen in a mirror.
int struck_from_other_side(lua_State* L) {
  SceneObject& object = scene_at(L, 1);
  SceneObject other{object.scene.struck_from_other_side(), object.site};
  lua_getiuservalue(L, 1, 1);
  lua_replace(L, 1);
  push_object(L, "ricochet.scene", std::move(other));
  return 1;
}

// with_chosen_step(scene, error): the scene, whose step trials have chosen: where it fails by it, it takes a shorter
// one.
int with_chosen_step(lua_State* L) {
  scene_at(L, 1).scene.error_step = luaL_checknumber(L, 2);
  lua_settop(L, 1);
  return 1;
}

// pilot(scenes): a row for each, and the wall seconds that all of them took on the run's threads, steps chosen for an
// accuracy and lattices planned before. Nothing is stored.
int pilot(lua_State* L) {
  Session& session = session_of(L);
  std::vector<Scene> scenes = scenes_at(L, 1);
  std::vector<Row> rows(scenes.size());
  double seconds = 0;
  const Telling telling = logged(session, [](std::size_t i) { return fmt::format("scene {} of the pilot", i + 1); });
  try {
    scenes = with_chosen_steps(session, scenes, telling);
    const auto began = Clock::now();
    const auto keep = [&](const std::vector<Result>& results) {
      for (const Result& result : results)
        rows[result.index] = row_of(scenes[result.index], result.outcome, result.seconds);
    };
    const bool whole =
        run_chosen(scenes, std::vector<bool>(scenes.size(), true), options_of(session), stop_requested, keep, telling);
    seconds = std::chrono::duration<double>(Clock::now() - began).count();
    if (!whole) throw Error("interrupted", Exit::interrupted);
  } catch (const SceneError& error) {
    throw_at_scene(L, 1, error);
  }
  lua_createtable(L, static_cast<int>(rows.size()), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    push_row(L, rows[i]);
    lua_pushstring(L, scenes[i].method().name.c_str());
    lua_setfield(L, -2, "method");
    lua_seti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_pushnumber(L, seconds);
  return 2;
}

// With --check: rows of nothing.
std::vector<Row> check_only(Session& session, const Request& sweep) {
  check_scenes(sweep.scenes, std::vector<bool>(sweep.scenes.size(), true), options_of(session), stop_requested);
  std::vector<Row> rows;
  for (const Scene& scene : sweep.scenes) rows.push_back(row_of(scene, Outcome{}, 0));
  session.inform(fmt::format("{}: {} scenes are sound\n", sweep.name, sweep.scenes.size()));
  return rows;
}

// A step that some lattice refuses is refused before anything is written.
void check_steps(const Session& session, const std::vector<Scene>& scenes) {
  std::vector<bool> by_step(scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Integration& given = scenes[i].integration;
    const bool found_to_start = scenes[i].step_is_chosen();
    by_step[i] = !found_to_start && (i == 0 || !std::isnan(given.step) || !std::isnan(given.theta));
  }
  check_scenes(scenes, by_step, options_of(session), stop_requested);
}

void tell_end(Session& session, const Request& sweep, const Store& store, const SweepUse* use) {
  const std::vector<Row>& rows = store.rows();
  std::size_t finished = 0;
  for (const Row& row : rows) finished += row.finished();
  std::string text = fmt::format("{}: {} of {} impacts finished; {}\n{}", sweep.name, finished, rows.size(),
                                 run_names::readable_results(store.folder()).string(), steps_text(sweep.scenes, rows));
  if (use)
    text += fmt::format("  {:.3g} s on {} thread{}, {:.2g} % of their time idle, {:.2g} % of the lanes' steps idle\n",
                        use->seconds, use->threads, use->threads == 1 ? "" : "s", 100 * use->idle_threads,
                        100 * use->idle_lanes);
  for (const Row& row : rows) session.count(row);
  session.inform(text);
  warn_of_limit(session, sweep.scenes, rows, sweep.scene_name());
  if (session.options.quiet) warn_of_doubts(session, rows);
}

std::vector<Row> run(Session& session, Request& sweep) {
  const Telling telling = printed(session, sweep.scene_name());
  sweep.scenes = sweep.stage == Stage::whole ? with_chosen_steps(session, sweep.scenes, telling)
                                             : with_steps_of_rounds(session, sweep.name, sweep.scenes, telling);
  std::vector<std::string> hashes;
  for (const Scene& scene : sweep.scenes) hashes.push_back(scene.hash());
  check_steps(session, sweep.scenes);
  Store store(session, sweep.name, hashes, sweep.parameters, sweep.earlier(session.options.resume));
  const std::size_t before = store.count();
  SweepUse use;
  try {
    use = run_and_store(session, store, sweep, hashes);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}\n  {}", error.what(), store.left_behind()));
  } catch (const SceneError&) {
    store.stop_early();
    sweep.stored = "\n  " + store.left_behind();
    throw;
  }
  if (sweep.goes_on()) return store.rows();
  store.assemble();
  tell_end(session, sweep, store, store.count() > before ? &use : nullptr);
  session.swept.push_back({sweep.name, store.folder(), sweep.scenes});
  return store.rows();
}

// Pushes the rows of a sweep, with its own values over an outcome of the same name.
void push_rows(lua_State* L, const std::vector<Row>& rows, const std::vector<std::string>& names, int points) {
  lua_createtable(L, static_cast<int>(rows.size()), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    push_row(L, rows[i]);
    lua_rawgeti(L, points, static_cast<lua_Integer>(i) + 1);
    for (const std::string& name : names) {
      lua_getfield(L, -1, name.c_str());
      lua_setfield(L, -3, name.c_str());
    }
    lua_pop(L, 1);
    lua_seti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
}

Stage stage_named(const std::string& name, bool first) {
  if (name == "round") return first ? Stage::first_round : Stage::round;
  return name == "last" ? Stage::last : Stage::whole;
}

// run_sweep(name, names, points, scenes, stage, units): the rows, in the order of the scenes. Of a sweep in rounds,
// `stage` is "round" or "last", and the scenes are all so far. `units` of parameters, by name.
int run_sweep_from_lua(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  const std::string stage = luaL_optstring(L, 5, "whole");
  const bool first = stage != "last" && !(stage == "round" && session.rounds.contains(name));
  if (first && !session.first_sweep_named(name))
    throw at_this_call(
        L,
        fmt::format("a sweep called '{}' has run already and its results would be replaced; give this one another name",
                    name));
  Request sweep{name, read_parameters(L, 2, 3, 6), scenes_at(L, 4), stage_named(stage, first)};
  if (stage == "round") session.rounds[name];
  std::vector<Row> rows;
  try {
    rows = session.options.check ? check_only(session, sweep) : run(session, sweep);
  } catch (const SceneError& error) {
    throw_at_scene(L, 4, error, fmt::format(" (at {}){}", sweep.parameters.place(error.scene), sweep.stored));
  }
  if (sweep.stage == Stage::last) session.rounds.erase(name);
  push_rows(L, rows, sweep.parameters.names, 3);
  return 1;
}

// clock(): wall seconds since some moment.
int clock_seconds(lua_State* L) {
  lua_pushnumber(L, std::chrono::duration<double>(Clock::now().time_since_epoch()).count());
  return 1;
}

// columns([system]): name -> unit of every outcome, for labels and for checking names.
int columns(lua_State* L) {
  const Units units = Units::named(luaL_optstring(L, 1, "paper"));
  lua_newtable(L);
  for (const auto& [field, value] : Outcome::fields()) {
    lua_pushstring(L, units.name(field.unit).c_str());
    lua_setfield(L, -2, field.name.c_str());
  }
  return 1;
}

Function sweep_function() {
  return {.name = "sweep",
          .doc =
              "Scenes over every combination of some values. `sweep:run()` runs them on all cores, leaves "
              "results.h5 and results.csv in the run's folder and "
              "returns the rows. A sample that did not finish is counted and never averaged in.",
          .fields =
              {{"name", "string", "", "names the folder of its results"},
               {"over", "table", "", "name = list of values, each a number, string or boolean"},
               {"units", "table", "", "name = unit of a value of 'over', for axes: { gap = \"R\" }", any_number, "{}"},
               {"scene", "function", "", "function (at) that returns the scene at the values at.name"},
               {"samples",
                "string",
                "",
                "by_error: as many samples of every point as a wanted error of `of` takes, in rounds; the scene's "
                "function gets their running number as at.sample, from 1",
                any_number,
                "",
                true,
                {"by_error"}},
               {"standard_error", "number", "", "with samples: wanted of the mean at every point", positive, "", true},
               {"relative_error", "number", "", "the same, over the mean", positive, "", true},
               {"of", "string", "", "with samples: the outcome that it is about", any_number, "e"},
               {"most", "integer", "", "with samples: of a point, at most", {8, 1e6}, "10000"},
               {"pilot", "integer", "", "with samples: of every point in the first round", {8, 1e6}, "8"},
               {"mirrored", "boolean", "",
                "with samples: strike lattices from both sides; where that pays, unless given", any_number, "", true}},
          .returns = "sweep",
          .example =
              "ricochet.sweep { name = \"angles\", over = { psi1 = {0, 1} }, scene = function(at) return "
              "scene_at(at.psi1) end }"};
}

// lua/ricochet/rows.lua
std::vector<Function> rows_functions() {
  return {
      {.name = "rows:summary",
       .doc = "Mean, standard deviation, standard error and count of columns of finished rows, grouped. `:print()` "
              "prints it as a table, and says what else varied.",
       .fields = {{"by", "string or strings", "", "column to group by, or several: a line each combination"},
                  {"of", "strings", "", "columns to average; undefined values are left out"}},
       .returns = "summary",
       .example = "rows:summary { by = \"psi1\", of = { \"e\", \"mu\" } }:print()"},
      {.name = "rows:power_law",
       .doc =
           "The exponent of a power law y = factor x^exponent by least squares of the logarithms of finished "
           "rows: a table of `exponent`, `factor`, `count`, the exponent's standard error `se` and its `freedom`, and "
           "`low` and `high`, between which it is with 95 % by Student's t. Impacts of one lattice are not "
           "independent: the error is that of a jackknife over the values of `unit`. Rows of one unit, or a fit that "
           "hangs on one, leave it undefined (nan), and `reason` says why.",
       .fields = {{"x", "string", "", "column of numbers above 0"},
                  {"y", "string", "", "column of numbers above 0; rows where it is undefined are left out"},
                  {"unit", "string", "",
                   "column whose equal values share a lattice; sample if the rows have it, else seed", any_number, "",
                   true}},
       .returns = "table",
       .example = "local law = rows:power_law { x = \"speed\", y = \"e\" }"},
      {.name = "rows:paired",
       .doc = "By how much a column changes between two values of another, over the lattices that both have, whose own "
              "scatter falls out: a table of `change`, its standard error `se`, `low` and `high` (95 %, Student's t), "
              "`is_seen`, `units` and `gain`: how many times more independent lattices would be needed.",
       .fields = {{"by", "string", "", "column of the two values"},
                  {"of", "string", "", "column to compare"},
                  {"at", "numbers", "", "the two values"},
                  {"unit", "string", "", "as in rows:power_law", any_number, "", true}},
       .returns = "table",
       .example = "rows:paired { by = \"psi1\", of = \"e\", at = { 0, 1 } }"},
      {.name = "rows:where",
       .doc = "The rows whose columns have the given values.",
       .returns = "rows",
       .example = "rows:where { psi1 = 1 }:summary { by = \"sample\", of = { \"e\" } }:print()"}};
}

Function range_function() {
  return {.name = "range",
          .doc = "The list first, first + step ... last; range(n) is 1 ... n.",
          .returns = "table",
          .example = "ricochet.range(3) -- {1, 2, 3}",
          .arguments = {{"first", "number"},
                        {"last", "number", "", "", any_number, "", true},
                        {"step", "number", "", "", any_number, "", true}}};
}

}  // namespace

Group sweep_functions() {
  return {
      .functions = std::vector<Function>{sweep_function()} + rows_functions() + std::vector<Function>{range_function()},
      .natives = {{"run_sweep", guarded<run_sweep_from_lua>},
                  {"columns", columns},
                  {"pilot", guarded<pilot>},
                  {"with_chosen_step", guarded<with_chosen_step>},
                  {"struck_from_other_side", guarded<struck_from_other_side>},
                  {"clock", clock_seconds}}};
}

}  // namespace ricochet
