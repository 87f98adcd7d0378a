// A sweep in shards, from lua/ricochet/shards.lua: the plan that all share, and the points of one.

#include <fmt/format.h>

#include "script/chunk_steps.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/shard_merge.hpp"
#include "script/shard_plan.hpp"
#include "script/shard_work.hpp"
#include "script/sweep_read.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

namespace {

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
  } catch (const Error& error) {
    if (error.exit != Exit::interrupted) throw;
    throw with_stored(error,
                      fmt::format("no shard of '{}' has begun, and there is no plan yet; the same command begins again",
                                  luaL_checkstring(L, 1)));
  }
  lua_settop(L, 0);
  session.forget_plans();
  return 0;
}

// plan_look(points, scenes): of a folder with rows, some of the scenes that these may be of.
int plan_look(lua_State* L) {
  Session& session = session_of(L);
  const std::vector<double> points = numbers_at(L, 1);
  std::vector<Scene> scenes = scenes_at(L, 2);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (session.planned_steps) session.planned_steps->give(scenes[i], static_cast<std::size_t>(points[i]));
    session.planned_scenes.push_back(HashKey::of(scenes[i].hash()));
  }
  lua_settop(L, 0);
  session.forget_plans();
  return 0;
}

// plan_shards(name, over, first, names): writes the plan, with the steps of plan_steps(), unless another process does
// so first. `names`: a list of { name =, values =, changes_lattice = }.
int plan_shards(lua_State* L) {
  Session& session = session_of(L);
  const std::string over = luaL_checkstring(L, 2);
  const Scene& first = scene_at(L, 3).scene;
  ShardPlan plan{.over = swept_names(L, 4)};
  plan.shards = session.options.shards;
  if (plan.shards == 0) plan.shards = std::max<std::size_t>(1, plan.points() / usual_impacts);
  if (session.planned_steps) plan.steps = session.planned_steps->table();
  refuse_strangers(session.sharded, session.planned_scenes);
  plan.facts = facts_of_sweep(L, over, first);
  plan.facts["canary"] = canary_of_first(L, 3, plan.with_step(first, 0));
  // A later sweep's shards make this one's scenes again.
  if (write_plan(session.sharded, plan, session.provenance())) session.steps.write(session.steps_file());
  return 0;
}

// The scenes of a shard with the plan's steps.
std::vector<Scene> planned_scenes(const ShardPlan& plan, std::vector<Scene> scenes, const std::vector<double>& points) {
  for (std::size_t i = 0; i < scenes.size(); ++i) try {
      scenes[i] = plan.with_planned_step(scenes[i], static_cast<std::size_t>(points[i]));
    } catch (const FieldError& error) {
      throw SceneError(error, i);
    }
  return scenes;
}

// run_shard(name, names, values, scenes, points, units): runs the points of this shard, which have these values of
// `over` and these scenes, and ends the script.
int run_shard(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = luaL_checkstring(L, 1);
  const Parameters parameters = read_parameters(L, 2, 3, 6);
  try {
    const std::vector<Scene> scenes = planned_scenes(read_plan(session.sharded), scenes_at(L, 4), numbers_at(L, 5));
    run_shard_scenes(session, name, scenes, parameters);
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
                      {"plan_steps", guarded<plan_steps>},
                      {"plan_look", guarded<plan_look>},
                      {"plan_shards", guarded<plan_shards>},
                      {"run_shard", guarded<run_shard>}}};
}

}  // namespace ricochet
