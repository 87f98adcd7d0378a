// A sweep in shards, from lua/ricochet/shards.lua: the plan that all share, and the points of one.

#include <fmt/format.h>

#include "core/hash.hpp"
#include "script/chunk_steps.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/shard_plan.hpp"
#include "script/shard_store.hpp"
#include "script/sweep_read.hpp"
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

// plan_steps(name, count, points, scenes): trials choose the steps of some of a sweep's points, for the plan; all of
// them come in such calls, one after the other.
int plan_steps(lua_State* L) {
  Session& session = session_of(L);
  const std::vector<double> listed = numbers_at(L, 3);
  const std::vector<std::size_t> points(listed.begin(), listed.end());
  if (!session.planned_steps)
    session.planned_steps = std::make_shared<ChunkSteps>(static_cast<std::size_t>(lua_tointeger(L, 2)));
  const auto name = [&](std::size_t i) { return fmt::format("point {}", points[i] + 1); };
  std::vector<Scene> scenes = scenes_at(L, 4);
  try {
    session.planned_steps->choose(session, points, scenes, printed(session, name));
  } catch (const SceneError& error) {
    throw_at_scene(L, 4, error);
  }
  return 0;
}

// plan_shards(name, over, first, names): writes the plan, with the steps of plan_steps(), unless another process does
// so first. `names`: a list of { name =, values =, changes_lattice = }.
int plan_shards(lua_State* L) {
  Session& session = session_of(L);
  const std::string over = luaL_checkstring(L, 2);
  ShardPlan plan{.over = swept_names(L, 4)};
  plan.shards = session.options.shards;
  if (plan.shards == 0) plan.shards = std::max<std::size_t>(1, plan.points() / usual_impacts);
  if (session.planned_steps) plan.steps = session.planned_steps->table();
  const Scene& first = scene_at(L, 3).scene;
  plan.facts = facts_of_sweep(L, over, first);
  plan.facts["canary"] = canary_of_first(L, 3, plan.with_step(first, 0));
  write_plan(session.sharded, plan, session.provenance());
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
                const SceneName& scene_name) {
  std::vector<std::string> hashes;
  for (const Scene& scene : scenes) hashes.push_back(scene.hash());
  check_steps(session, scenes);
  ShardStore store(session, session.sharded, session.options.shard, hashes);
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
  const SceneName scene_name = [&](std::size_t scene) { return parameters.place(scene); };
  try {
    const std::vector<Scene> scenes = planned_scenes(read_plan(session.sharded), scenes_at(L, 4), numbers_at(L, 5));
    run_points(session, name, scenes, scene_name);
  } catch (const SceneError& error) {
    throw_at_scene(L, 4, error, fmt::format(" (at {})", parameters.place(error.scene)));
  }
  end_script(session);
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
  bool merged = fs::exists(results, error) && !fs::exists(run_names::plan(folder), error);
  if (merged) {
    Provenance theirs = read_provenance(results);
    const Provenance own = session.provenance();
    merged = theirs["script_hash"] == own.at("script_hash") &&
             theirs["arguments"] == (own.contains("arguments") ? own.at("arguments") : "");
  }
  lua_pushboolean(L, merged);
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
                      {"shard_points", guarded<shard_points>},
                      {"plan_steps", guarded<plan_steps>},
                      {"plan_shards", guarded<plan_shards>},
                      {"run_shard", guarded<run_shard>}}};
}

}  // namespace ricochet
