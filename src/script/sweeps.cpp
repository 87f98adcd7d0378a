// ricochet.sweep and its rows: scenes to rows, in parts that survive a kill.

#include <fmt/format.h>

#include <chrono>
#include <unordered_map>

#include "impact/sweep.hpp"
#include "script/fields.hpp"
#include "script/filmed.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/shard_merge.hpp"
#include "script/step_choice.hpp"
#include "script/sweep_descriptions.hpp"
#include "script/sweep_read.hpp"
#include "script/sweep_report.hpp"
#include "script/sweep_run.hpp"
#include "script/sweep_store.hpp"
#include "store/files.hpp"
#include "store/long_table.hpp"
#include "store/run_names.hpp"
#include "store/sinks.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

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
  // `went_on`: from results of a larger error, not all rows of which are asked for.
  Earlier earlier(bool resume, bool went_on) const {
    const bool begins = stage == Stage::whole || stage == Stage::first_round;
    return {resume || !begins, goes_on() || (stage == Stage::last && went_on)};
  }
};

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

void tell_end(Session& session, const Request& sweep, const Store& store, const std::string& digest,
              const SweepUse* use) {
  std::size_t finished = 0;
  const std::vector<Row>& rows = store.rows();
  SweepTold told(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    told.add_scene(i, sweep.scenes[i]);
    if (!store.done()[i]) continue;
    finished += rows[i].finished();
    told.add_row(i, sweep.scenes[i], rows[i]);
    session.count(rows[i]);
  }
  std::string text = fmt::format("{}: {} of {} impacts finished; {}\n{}", sweep.name, finished, rows.size(),
                                 run_names::readable_results(store.folder()).string(), told.steps_text());
  text += fmt::format("  digest of outcomes {}\n", digest);
  if (use) text += use_text(*use);
  session.inform(text);
  told.warn_of_limit(session, sweep.scene_name());
  if (session.options.quiet) told.warn_of_doubts(session);
}

// Before the steps are chosen it is not known which of the stored rows are the scenes'.
std::string stored_before(const Session& session, const std::string& name) {
  const fs::path folder = session.folders.named(name);
  std::error_code error;
  const bool replaced = session.options.force && !fs::exists(run_names::new_parts(folder), error);
  std::size_t rows = 0;
  for (const fs::path& file : run_names::stored(folder)) rows += replaced ? 0 : StoredTable(file).rows();
  if (rows == 0) return fmt::format("no impact of '{}' has run; the same command begins again", name);
  return fmt::format("{} rows are stored in {}; --resume goes on from there", rows, folder.string());
}

std::vector<Scene> choose_steps(Session& session, const Request& sweep) {
  const Telling telling = printed(session, sweep.scene_name());
  if (sweep.stage != Stage::whole) return with_steps_of_rounds(session, sweep.name, sweep.scenes, telling);
  return session.options.part == Part::whole ? with_chosen_steps(session, sweep.scenes, telling)
                                             : with_planned_steps(session, sweep.name, sweep.scenes, telling);
}

std::vector<Scene> with_steps(Session& session, const Request& sweep) {
  try {
    return choose_steps(session, sweep);
  } catch (const Error& error) {
    if (error.exit != Exit::interrupted) throw;
    throw with_stored(error, stored_before(session, sweep.name));
  }
}

// Scenes that are all there, by their hashes.
auto scenes_by_hash(const std::vector<Scene>& scenes, const std::vector<std::string>& hashes) {
  auto of_hash = std::make_shared<std::unordered_map<std::string, Scene>>();
  for (std::size_t i = 0; i < scenes.size(); ++i) of_hash->emplace(hashes[i], scenes[i]);
  return [of_hash](const std::string& hash) {
    const auto found = of_hash->find(hash);
    return found == of_hash->end() ? std::nullopt : std::optional<Scene>(found->second);
  };
}

// Runs what is not stored yet.
SweepUse run_rest(Session& session, Store& store, Request& sweep, const std::vector<std::string>& hashes) {
  SweepUse use;
  try {
    const Storing storing;
    if (run_rows(session, store, {sweep.name, sweep.scenes, hashes, sweep.scene_name()}, use)) return use;
    store.stop_early();
    throw Error("interrupted: " + store.left_behind(), Exit::interrupted);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}\n  {}", error.what(), store.left_behind()));
  } catch (const SceneError&) {
    store.stop_early();
    sweep.stored = "\n  " + store.left_behind();
    throw;
  }
}

std::vector<Row> run(Session& session, Request& sweep) {
  sweep.scenes = with_steps(session, sweep);
  const std::vector<std::string> hashes = hashes_of(sweep.scenes);
  const bool merges = session.options.part == Part::merge;
  if (session.options.part == Part::shard || session.options.part == Part::plan)
    return merged_rows(session, sweep.name, hashes);
  if (!merges) check_steps(session, sweep.scenes);
  const fs::path larger = run_names::earlier(session.folders.named(sweep.name));
  std::error_code error;
  Store store(session, sweep.name, hashes, sweep.parameters,
              sweep.earlier(session.options.resume, merges && fs::exists(larger, error)));
  const std::size_t before = store.count();
  SweepUse use;
  if (merges)
    refuse_missing(session, sweep.name, store.done());
  else
    use = run_rest(session, store, sweep, hashes);
  if (sweep.goes_on()) return store.rows();
  const std::string digest = store.assemble();
  if (merges && sweep.stage == Stage::last) {
    if (store.strangers() > 0)
      session.inform(fmt::format("{}: {} rows of the earlier, larger error are not asked for by this one, and go\n",
                                 sweep.name, store.strangers()));
    remove_file(larger);
  }
  tell_end(session, sweep, store, digest, store.count() > before ? &use : nullptr);
  session.swept.push_back({sweep.name, store.folder(), scenes_by_hash(sweep.scenes, hashes)});
  return store.count() < hashes.size() ? with_missing(store, sweep.scenes) : store.rows();
}

// Sets `name` of the row below the top to the sweep's value, which the point at the top has. What the row had of that
// name is outcome_NAME from then on, and the sweep's value is over_NAME, too, as in files.
void set_parameter(lua_State* L, const std::string& name) {
  const auto set = [&](const std::string& as) {
    lua_getfield(L, -1, name.c_str());
    lua_setfield(L, -3, as.c_str());
  };
  lua_pushstring(L, name.c_str());
  if (lua_rawget(L, -3) == LUA_TNIL) {
    lua_pop(L, 1);
  } else {
    lua_setfield(L, -3, ("outcome_" + name).c_str());
    set("over_" + name);
  }
  set(name);
}

// Pushes the rows of a sweep, with its own values over an outcome of the same name.
void push_rows(lua_State* L, const std::vector<Row>& rows, const std::vector<std::string>& names, int points) {
  lua_createtable(L, static_cast<int>(rows.size()), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    push_row(L, rows[i]);
    lua_rawgeti(L, points, static_cast<lua_Integer>(i) + 1);
    for (const std::string& name : names) set_parameter(L, name);
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
  if (first && !session.first_sweep_named(name)) throw at_this_call(L, ran_already(name));
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

// save_rows(name, columns, rows): a list of { name =, unit = } of rows, as files of every format.
int save_rows(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  Table table;
  each_element(L, 2, [&](lua_Integer) {
    lua_getfield(L, -1, "name");
    lua_getfield(L, -2, "unit");
    const Field field{lua_tostring(L, -2), "", lua_tostring(L, -1)};
    lua_pop(L, 2);
    NumberColumn numbers{field, {}};
    TextColumn texts{field, {}};
    for (lua_Integer i = 1; i <= luaL_len(L, 3); ++i) {  // of a long sweep they are read as they are asked for
      lua_geti(L, 3, i);
      lua_getfield(L, -1, field.name.c_str());
      numbers.values.push_back(lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : not_given);
      texts.values.push_back(luaL_tolstring(L, -1, nullptr));
      if (lua_type(L, -2) != LUA_TNUMBER) numbers.field.type = "string";
      lua_pop(L, 3);
    }
    numbers.field.type.empty() ? table.numbers.push_back(numbers) : table.texts.push_back(texts);
  });
  if (session.options.check) return 0;
  const fs::path path = claimed_files(L, "name", name, rows_sinks());
  write_everywhere(fs::path(path).replace_extension(), table, session.provenance());
  session.inform(fmt::format("rows: {} in {}\n", table.rows(), path.string()));
  return 0;
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

}  // namespace

Group sweep_functions() {
  return {.functions = sweep_descriptions(),
          .natives = {{"run_sweep", guarded<run_sweep_from_lua>},
                      {"columns", columns},
                      {"save_rows", guarded<save_rows>},
                      {"pilot", guarded<pilot>},
                      {"with_chosen_step", guarded<with_chosen_step>},
                      {"struck_from_other_side", guarded<struck_from_other_side>},
                      {"clock", clock_seconds}}};
}

}  // namespace ricochet
