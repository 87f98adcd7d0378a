// Steps for a wanted accuracy, and the runs of ricochet.accuracy.

#include "impact/accuracy.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "impact/batch.hpp"
#include "script/objects.hpp"
#include "script/state.hpp"

namespace ricochet {

std::vector<Scene> with_chosen_steps(Session& session, const std::vector<Scene>& scenes) {
  return with_chosen_steps(scenes, session.options.threads, stop_requested,
                           [&](const std::string& line) { session.print(line + "\n"); });
}

std::vector<Scene> with_quietly_chosen_steps(Session& session, const std::vector<Scene>& scenes) {
  return with_chosen_steps(scenes, session.options.threads, stop_requested,
                           [&](const std::string& line) { session.log(line + "\n"); });
}

Scene with_chosen_step(Session& session, const Scene& scene) {
  if (session.options.check || std::isnan(scene.integration.accuracy)) return scene;
  auto& chosen = session.chosen[scene.hash()];
  if (!chosen) chosen = std::make_shared<const Scene>(with_chosen_steps(session, {scene}).front());
  return *chosen;
}

namespace {

/// Keeps the thread on the core it is on, so that wall times of one study are those of one core.
class Pinned {
 public:
  Pinned() {
    CPU_ZERO(&before_);
    known_ = sched_getaffinity(0, sizeof before_, &before_) == 0;
    cpu_set_t here;
    CPU_ZERO(&here);
    const int core = sched_getcpu();
    if (!known_ || core < 0) return;
    CPU_SET(core, &here);
    sched_setaffinity(0, sizeof here, &here);
  }
  ~Pinned() {
    if (known_) sched_setaffinity(0, sizeof before_, &before_);
  }
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;

 private:
  cpu_set_t before_;
  bool known_ = false;
};

// accuracy_runs(scene, list of { method =, step = } or { method =, theta = }, repeats): a row for each, with method,
// evaluations (of the force) and seconds (the least of the repeats). Steps that are refused, and runs that do not
// finish, have their status.
int accuracy_runs(lua_State* L) {
  Session& session = session_of(L);
  const SceneObject& object = scene_at(L, 1);
  const lua_Integer repeats = luaL_checkinteger(L, 3);
  BuiltSolids solids;
  try {
    solids = BuiltSolids(object.scene);
  } catch (const FieldError& error) {
    throw_at(session, object.site, error);
  }
  const Pinned pinned;
  lua_newtable(L);
  const int rows = lua_gettop(L);
  const lua_Integer count = length_of(L, 2);
  for (lua_Integer k = 1; k <= count; ++k) {
    lua_rawgeti(L, 2, k);
    Scene scene = object.scene;
    scene.integration.accuracy = not_given;
    lua_getfield(L, -1, "method");
    lua_getfield(L, -2, "step");
    lua_getfield(L, -3, "theta");
    scene.integration.method = lua_tostring(L, -3);
    const Method& method = method_named(scene.integration.method);
    scene.integration.step = lua_isnil(L, -2) ? not_given : lua_tonumber(L, -2);
    scene.integration.theta = lua_isnil(L, -1) ? not_given : lua_tonumber(L, -1);
    Outcome outcome;
    double seconds = std::numeric_limits<double>::infinity();
    try {
      for (lua_Integer i = 0; i < repeats; ++i) {
        const auto began = std::chrono::steady_clock::now();
        outcome = run_scene(solids, scene, stop_requested);
        seconds = std::min(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
      }
    } catch (const FieldError& error) {
      if (error.field != "step" && error.field != "theta") throw_at(session, object.site, error);
      outcome.status = Status::unstable;
      outcome.reason = error.what();
      outcome.step = scene.integration.step;
    }
    if (stop_requested) throw Error("interrupted", Exit::interrupted);
    lua_pop(L, 4);
    push_row(L, row_of(scene, outcome, seconds));
    lua_pushstring(L, method.name.c_str());
    lua_setfield(L, -2, "method");
    lua_pushnumber(L, outcome.steps * work_of_step(method, solids));
    lua_setfield(L, -2, "evaluations");
    lua_seti(L, rows, k);
  }
  return 1;
}

// methods(): { { name =, order =, outcome_order =, evaluations =, stability_limit =, source = }, ... }.
int method_list(lua_State* L) {
  lua_newtable(L);
  lua_Integer n = 0;
  for (const Method& m : methods()) {
    lua_createtable(L, 0, 7);
    lua_pushstring(L, m.name.c_str());
    lua_setfield(L, -2, "name");
    lua_pushinteger(L, m.order);
    lua_setfield(L, -2, "order");
    lua_pushinteger(L, m.outcome_order);
    lua_setfield(L, -2, "outcome_order");
    lua_pushinteger(L, m.evaluations());
    lua_setfield(L, -2, "evaluations");
    lua_pushnumber(L, m.stability_limit);
    lua_setfield(L, -2, "stability_limit");
    lua_pushnumber(L, m.usual);
    lua_setfield(L, -2, "usual");
    lua_pushstring(L, m.source.c_str());
    lua_setfield(L, -2, "source");
    lua_seti(L, -2, ++n);
  }
  return 1;
}

// conflict(scene, method): why the scene's effects do not allow it; "" if they do.
int conflict(lua_State* L) {
  lua_pushstring(L, scene_at(L, 1).scene.conflict_with(method_named(luaL_checkstring(L, 2))).c_str());
  return 1;
}

// machine(): the processor's name and the number of cores.
int machine(lua_State* L) {
  std::string name = "unknown processor";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      name = line.substr(line.find(':') + 2);
      break;
    }
  lua_pushstring(L, name.c_str());
  lua_pushinteger(L, std::thread::hardware_concurrency());
  return 2;
}

// accuracy_outcomes: name -> true for every outcome whose error from the time step can be estimated.
void push_accuracy_outcomes(lua_State* L) {
  lua_newtable(L);
  for (const auto& member : Integration::fields())
    if (member.field.name == "accuracy_of")
      for (const std::string& name : member.field.choices) {
        lua_pushboolean(L, true);
        lua_setfield(L, -2, name.c_str());
      }
}

}  // namespace

void add_accuracy(lua_State* L) {
  const luaL_Reg list[] = {{"accuracy_runs", guarded<accuracy_runs>},
                           {"methods", method_list},
                           {"conflict", guarded<conflict>},
                           {"machine", machine}};
  for (const luaL_Reg& f : list) {
    lua_pushcfunction(L, f.func);
    lua_setfield(L, -2, f.name);
  }
  push_accuracy_outcomes(L);
  lua_setfield(L, -2, "accuracy_outcomes");
}

}  // namespace ricochet
