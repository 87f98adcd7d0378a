// A sweep in shards, from lua/ricochet/shards.lua: the plan that all share, and the points of one.

#include <fmt/format.h>

#include "core/hash.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/shard_merge.hpp"
#include "script/shard_plan.hpp"
#include "script/shard_store.hpp"
#include "script/sweep_read.hpp"
#include "script/sweep_store.hpp"
#include "store/files.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

// Impacts of a shard, where nobody says how many shards.
constexpr std::size_t usual_impacts = 1000;

// Ends the script; what follows in it runs when shards are merged.
[[noreturn]] void end_script(Session& session) {
  session.done = true;
  throw Error("the script was only asked for a part of its sweep");
}

void refuse_other_number(const Session& session, const ShardPlan& plan) {
  const std::size_t asked = session.options.shards;
  if (asked == 0 || asked == plan.shards) return;
  throw FileError(fmt::format("{} is of {} shards, not of {}; give --shard K/{}, or another --out",
                              run_names::plan(session.sharded).string(), plan.shards, asked, plan.shards));
}

// Pushes the points of this process's shard; the plan alone ends the script.
int push_points(lua_State* L, const ShardPlan& plan) {
  Session& session = session_of(L);
  if (session.options.part == Part::plan) end_script(session);
  const std::vector<std::size_t> points = plan.points_of(session.options.shard);
  lua_createtable(L, static_cast<int>(points.size()), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    lua_pushinteger(L, static_cast<lua_Integer>(points[i]));
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  return 1;
}

std::string canary_of_first(lua_State* L, int index, const Scene& chosen) {
  try {
    return canary_of(chosen);
  } catch (const FieldError& error) {
    throw_at(session_of(L), scene_at(L, index).site, explained(error, chosen));
  }
}

Provenance facts_of_sweep(lua_State* L, const std::string& over, const Scene& first) {
  Provenance facts = facts_of(session_of(L));
  facts["over"] = hash_text(over);
  facts["first_scene"] = first.hash();
  return facts;
}

// shard_points(name, over, first): the points of this shard, from 0, by the plan that is there; nil if there is none.
// `over`: the sweep's values as a text; `first`: the scene of the first point.
int shard_points(lua_State* L) {
  Session& session = session_of(L);
  session.sharded = session.folders.named(luaL_checkstring(L, 1));
  std::error_code error;
  if (!fs::exists(run_names::plan(session.sharded), error)) return 0;
  const ShardPlan plan = read_plan(session.sharded);
  refuse_other_number(session, plan);
  const Scene& first = scene_at(L, 3).scene;
  refuse_other(plan, facts_of_sweep(L, luaL_checkstring(L, 2), first), session.sharded);
  refuse_other(plan, {{"canary", canary_of_first(L, 3, plan.with_step(first, 0))}}, session.sharded);
  return push_points(L, plan);
}

std::vector<SweptName> swept_names(lua_State* L, int list) {
  std::vector<SweptName> names;
  each_element(L, list, [&](lua_Integer) {
    lua_getfield(L, -1, "name");
    lua_getfield(L, -2, "values");
    lua_getfield(L, -3, "changes_lattice");
    names.push_back({lua_tostring(L, -3), static_cast<std::size_t>(lua_tointeger(L, -2)), lua_toboolean(L, -1) != 0});
    lua_pop(L, 3);
  });
  return names;
}

// holds_rows(name): true if an earlier run left rows of a sweep of this name.
int holds_rows(lua_State* L) {
  lua_pushboolean(L, !run_names::stored(session_of(L).folders.named(luaL_checkstring(L, 1))).empty());
  return 1;
}

// Rows of other scenes would stand in the way of the merging, once all shards have run.
void refuse_strangers(const fs::path& folder, const std::vector<Scene>& scenes) {
  KnownRows known(hashes_of(scenes));
  std::size_t strangers = 0;
  for (const fs::path& file : run_names::stored(folder)) strangers += known.load(file);
  if (strangers > 0)
    throw FileError(fmt::format(
        "{} holds {} rows of other scenes than this sweep's, beside which its shards could not be merged; give "
        "another --out, or the script and the parameters of those",
        folder.string(), strangers));
}

// plan_shards(name, over, first, names, scenes): writes the plan, unless another process does so first. `names`: a list
// of { name =, values =, changes_lattice = }; `scenes`: of all points, if trials are to choose their steps or rows are
// there, else empty.
int plan_shards(lua_State* L) {
  Session& session = session_of(L);
  const std::string over = luaL_checkstring(L, 2);
  const Scene& first = scene_at(L, 3).scene;
  ShardPlan plan{.over = swept_names(L, 4)};
  plan.shards = session.options.shards;
  if (plan.shards == 0) plan.shards = std::max<std::size_t>(1, plan.points() / usual_impacts);
  std::vector<Scene> scenes = scenes_at(L, 5);
  const auto name = [](std::size_t i) { return fmt::format("point {}", i + 1); };
  try {
    if (!std::isnan(first.integration.accuracy)) {
      scenes = with_chosen_steps(session, scenes, printed(session, name));
      plan.steps = steps_table(scenes);
    }
  } catch (const SceneError& error) {
    throw_at_scene(L, 5, error);
  }
  refuse_strangers(session.sharded, scenes);
  plan.facts = facts_of_sweep(L, over, first);
  plan.facts["canary"] = canary_of_first(L, 3, plan.with_step(first, 0));
  // A later sweep's shards make this one's scenes again.
  if (write_plan(session.sharded, plan, session.provenance())) session.steps.write(session.steps_file());
  return 0;
}

// The scenes of a shard with the plan's steps.
std::vector<Scene> planned_scenes(const ShardPlan& plan, std::vector<Scene> scenes, const std::vector<double>& points) {
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (plan.steps.rows() == 0 && !std::isnan(scenes[i].integration.accuracy))
      throw SceneError(FieldError("accuracy",
                                  "is given at this point and not at the first, so that the plan of the "
                                  "shards has no step for it; give it at every point, or at none"),
                       i);
    scenes[i] = plan.with_step(scenes[i], static_cast<std::size_t>(points[i]));
  }
  return scenes;
}

void tell_shard_end(Session& session, const std::string& name, const RowStore& store) {
  std::size_t finished = 0;
  for (const Row& row : store.rows()) finished += row.finished();
  session.inform(fmt::format("shard {}/{} of '{}' is done: {} of {} impacts finished; {}\n", session.options.shard,
                             session.options.shards, name, finished, store.rows().size(),
                             run_names::shard(session.sharded, session.options.shard).string()));
}

void run_points(Session& session, const std::string& name, const std::vector<Scene>& scenes,
                const Parameters& parameters) {
  const SceneName scene_name = [&](std::size_t scene) { return parameters.place(scene); };
  const std::vector<std::string> hashes = hashes_of(scenes);
  check_steps(session, scenes);
  ShardStore store(session, session.options.shard, hashes, parameters);
  const std::string called = fmt::format("{}, shard {}/{}", name, session.options.shard, session.options.shards);
  SweepUse use;
  const Storing storing;
  try {
    if (!run_rows(session, store, {called, scenes, hashes, scene_name}, use)) {
      store.flush();
      throw Error(fmt::format("interrupted: {} of {} impacts of shard {}/{} are stored in {}; the same command goes on "
                              "from there",
                              store.count(), scenes.size(), session.options.shard, session.options.shards,
                              session.sharded.string()),
                  Exit::interrupted);
    }
  } catch (const SceneError&) {
    store.flush();
    throw;
  }
  store.finish();
  tell_shard_end(session, name, store);
}

// run_shard(name, names, values, scenes, points, units): runs the points of this shard, which have these values of
// `over` and these scenes, and ends the script.
int run_shard(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  const Parameters parameters = read_parameters(L, 2, 3, 6);
  try {
    const std::vector<Scene> scenes = planned_scenes(read_plan(session.sharded), scenes_at(L, 4), numbers_at(L, 5));
    run_points(session, name, scenes, parameters);
  } catch (const SceneError& error) {
    throw_at_scene(L, 4, error, fmt::format(" (at {})", parameters.place(error.scene)));
  }
  end_script(session);
}

/// A round of a sweep that takes as many samples of every point as an error needs: all scenes so far, with their steps.
struct Round {
  std::string name, text;  ///< of the sweep; what decides which scenes it has
  Parameters parameters;
  std::vector<Scene> scenes = {};
  std::vector<std::string> hashes = {};
  std::vector<std::size_t> places = {};  ///< of the scenes in the plan: lattices by their number, and their points
  std::size_t lattices = 0, points = 0;  ///< at most, of a point; of the sweep

  SceneName scene_name() const {
    return [this](std::size_t scene) { return parameters.place(scene); };
  }
};

// Throws an error of a scene of a round at the place that made it.
[[noreturn]] void throw_at_round(lua_State* L, const Round& round, const SceneError& error) {
  throw_at_scene(L, 4, error, fmt::format(" (at {})", round.parameters.place(error.scene)));
}

Round round_at(lua_State* L) {
  Session& session = session_of(L);
  Round round{luaL_checkstring(L, 1), luaL_checkstring(L, 6), read_parameters(L, 2, 3, 5)};
  round.lattices = static_cast<std::size_t>(luaL_checkinteger(L, 7));
  round.points = static_cast<std::size_t>(luaL_checkinteger(L, 8));
  try {
    round.scenes = with_steps_of_rounds(session, round.name, scenes_at(L, 4), printed(session, round.scene_name()));
  } catch (const SceneError& error) {
    throw_at_round(L, round, error);
  }
  round.hashes = hashes_of(round.scenes);
  const std::vector<std::string>& names = round.parameters.names;
  const auto pair = std::find(names.begin(), names.end(), "pair") - names.begin();
  for (const double number : round.parameters.numbers[static_cast<std::size_t>(pair)])
    round.places.push_back(static_cast<std::size_t>(number) - 1);
  return round;
}

// How many of a round's rows are there: merged ones, and where they are to be merged, those of shards.
std::size_t known_of(const Session& session, const Round& round, const fs::path& folder) {
  KnownRows known(round.hashes);
  load_while_they_change(known, [&] {
    std::error_code error;
    if (session.options.part != Part::merge) {
      const fs::path results = run_names::readable_results(folder);
      return fs::exists(results, error) ? std::vector<fs::path>{results} : std::vector<fs::path>{};
    }
    std::vector<fs::path> files = run_names::stored(folder);
    for (const fs::path& file : run_names::shard_files(folder)) files.push_back(file);
    return files;
  });
  return known.count();
}

// Of a round whose shards are not all there, says so; of one that none has run yet, makes results of those before.
void merge_round(Session& session, const Round& round) {
  if (session.options.partial)
    throw Error(
        "merge --partial: samples = \"by_error\" decides by all rows how many samples to run; run the shards that are "
        "missing",
        Exit::usage);
  const fs::path folder = session.folders.named(round.name);
  std::error_code error;
  const bool has_plan = fs::exists(run_names::plan(folder), error);
  if (has_plan) refuse_other(read_plan(folder), facts_of(session), folder);
  Store store(session, round.name, round.hashes, round.parameters, {true, false});
  if (store.count() == 0 || (has_plan && read_plan(folder).facts.at("over") == hash_text(round.text)))
    refuse_missing(session, round.name, store, round.places);
  store.assemble();
  run_names::remove_shards(folder);
}

// Plans a round, unless another process does so first.
void plan_round(lua_State* L, const Round& round, std::size_t known, const Provenance& facts) {
  Session& session = session_of(L);
  ShardPlan plan{.over = {{"sample", round.lattices, true}, {"point", round.points, false}}};
  plan.shards = session.options.shards;
  if (plan.shards == 0) plan.shards = std::max<std::size_t>(1, (round.scenes.size() - known) / usual_impacts);
  refuse_strangers(session.sharded, round.scenes);
  plan.facts = facts;
  plan.facts["impacts"] = fmt::format("{}", round.scenes.size());
  if (write_plan(session.sharded, plan, session.provenance())) session.steps.write(session.steps_file());
}

// Runs what of a round is this process's shard.
void run_round(lua_State* L, const Round& round, const ShardPlan& plan) {
  Session& session = session_of(L);
  std::vector<std::size_t> own;
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < round.scenes.size(); ++i) {
    if (plan.shard_of(round.places[i]) != session.options.shard) continue;
    own.push_back(i);
    scenes.push_back(round.scenes[i]);
  }
  try {
    run_points(session, round.name, scenes, round.parameters.of(own));
  } catch (const SceneError& error) {
    throw_at_round(L, round, SceneError(error, own[error.scene]));
  }
}

// round_is_there(name, names, points, scenes, units, text, lattices, count): true if all rows of a round are there;
// false where it was merged and no shard has run it yet. Else plans the round or runs this process's shard of it, and
// ends the script. `text`: what decides which scenes it has; `lattices`, `count`: at most, of a point; of points.
int round_is_there(lua_State* L) {
  Session& session = session_of(L);
  const Round round = round_at(L);
  const fs::path folder = session.folders.named(round.name);
  const std::size_t known = known_of(session, round, folder);
  lua_pushboolean(L, known == round.hashes.size());
  if (known == round.hashes.size()) return 1;
  if (session.options.part == Part::merge) {
    merge_round(session, round);
    return 1;
  }
  session.sharded = folder;
  lua_rawgeti(L, 4, 1);
  Provenance facts = facts_of_sweep(L, round.text, round.scenes.front());
  facts["canary"] = canary_of_first(L, -1, round.scenes.front());
  std::error_code error;
  if (!fs::exists(run_names::plan(folder), error)) plan_round(L, round, known, facts);
  const ShardPlan plan = read_plan(folder);
  refuse_other_number(session, plan);
  refuse_other(plan, facts, folder);
  if (session.options.part == Part::shard) run_round(L, round, plan);
  end_script(session);
}

// end_round(name, round): ends the merging of a round after which another one is needed.
int end_round(lua_State* L) {
  const Session& session = session_of(L);
  throw Error(fmt::format("round {} of '{}' is to be run: its wanted error is not reached; ricochet submit does so, or "
                          "run its shards: {}",
                          luaL_checkinteger(L, 2), luaL_checkstring(L, 1), command_of(session, "run", "--shard K/N")),
              Exit::numerical);
}

// part(): "whole", "plan", "shard" or "merge": what of its sweeps this process does.
int part(lua_State* L) {
  static constexpr const char* names[] = {"whole", "plan", "shard", "merge"};
  lua_pushstring(L, names[static_cast<int>(session_of(L).options.part)]);
  return 1;
}

// is_merged(name): true if the sweep's shards were merged, of this script with these arguments: a later one is meant.
int is_merged(lua_State* L) {
  const Session& session = session_of(L);
  const fs::path folder = session.folders.named(luaL_checkstring(L, 1)), results = run_names::readable_results(folder);
  std::error_code error;
  const bool whole = fs::exists(results, error) && !fs::exists(run_names::plan(folder), error);
  lua_pushboolean(L, whole && is_of_results(facts_of(session), read_provenance(results)));
  return 1;
}

// lattice(scene): what scenes that share a lattice have in common; whether the scene asks for an accuracy; its hash.
int lattice(lua_State* L) {
  const Scene& scene = scene_at(L, 1).scene;
  lua_pushstring(L, scene.group().c_str());
  lua_pushboolean(L, !std::isnan(scene.integration.accuracy));
  lua_pushstring(L, scene.hash().c_str());
  return 3;
}

}  // namespace

Group shard_functions() {
  return {.natives = {{"part", part},
                      {"is_merged", guarded<is_merged>},
                      {"lattice", guarded<lattice>},
                      {"holds_rows", guarded<holds_rows>},
                      {"shard_points", guarded<shard_points>},
                      {"plan_shards", guarded<plan_shards>},
                      {"round_is_there", guarded<round_is_there>},
                      {"end_round", guarded<end_round>},
                      {"run_shard", guarded<run_shard>}}};
}

}  // namespace ricochet
