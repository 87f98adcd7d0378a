// ricochet.accuracy, ricochet.relevance, ricochet.plan: what is known of methods and machine, and the runs of studies.

#include "impact/accuracy.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "impact/batch.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/processor.hpp"
#include "script/reader.hpp"

namespace ricochet {

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

// The scene by the method and step (or theta) of the table on top of the stack, the step in the scene's units.
Scene variant_of(lua_State* L, const Scene& scene) {
  Scene variant = scene;
  variant.integration.accuracy = not_given;
  lua_getfield(L, -1, "method");
  lua_getfield(L, -2, "step");
  lua_getfield(L, -3, "theta");
  variant.integration.method = lua_tostring(L, -3);
  variant.integration.step = lua_isnil(L, -2) ? not_given : lua_tonumber(L, -2) / scene.units.worth("R/c");
  variant.integration.theta = lua_isnil(L, -1) ? not_given : lua_tonumber(L, -1);
  lua_pop(L, 3);
  return variant;
}

// The scene's row; of its wall times the least counts. A step that is refused is a status.
Row least_of(lua_Integer repeats, const Solids& solids, const Scene& scene, Outcome& outcome) {
  double seconds = std::numeric_limits<double>::infinity();
  try {
    for (lua_Integer i = 0; i < repeats; ++i) {
      const auto began = std::chrono::steady_clock::now();
      outcome = run_scene(solids, scene, stop_requested);
      seconds = std::min(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    }
  } catch (const FieldError& error) {
    if (error.field != "step" && error.field != "theta") throw;
    outcome.status = Status::unstable;
    outcome.reason = error.what();
    outcome.step = scene.integration.step;
  }
  if (stop_requested) throw Error("interrupted", Exit::interrupted);
  return row_of(scene, outcome, seconds);
}

// accuracy_runs(scene, list of { method =, step = } or { method =, theta = }, repeats): a row for each, with method,
// evaluations (of the force) and seconds (the least of the repeats). Steps that are refused, and runs that do not
// finish, have their status.
int accuracy_runs(lua_State* L) {
  const SceneObject& object = scene_at(L, 1);
  const lua_Integer repeats = luaL_checkinteger(L, 3);
  lua_newtable(L);
  const int rows = lua_gettop(L);
  try {
    const BuiltSolids solids(object.scene);
    const Pinned pinned;
    each_element(L, 2, [&](lua_Integer k) {
      const Scene scene = variant_of(L, object.scene);
      Outcome outcome;
      push_row(L, least_of(repeats, solids, scene, outcome));
      lua_pushstring(L, scene.integration.method.c_str());
      lua_setfield(L, -2, "method");
      lua_pushnumber(L, outcome.steps * work_of_step(method_named(scene.integration.method), solids));
      lua_setfield(L, -2, "evaluations");
      lua_seti(L, rows, k);
    });
  } catch (const FieldError& error) {
    throw_at(session_of(L), object.site, explained(error, object.scene));
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

// refused_effects(scene): why the scene's effects cannot act on its bodies, which are of elements, rigid or free; "" if
// they can.
int refused_effects(lua_State* L) {
  const SceneObject& object = scene_at(L, 1);
  try {
    const BuiltSolids solids(object.scene);
    lua_pushstring(L, conflict_with(object.scene.effects, Solids(solids), object.scene.contact).c_str());
  } catch (const FieldError& error) {
    throw_at(session_of(L), object.site, explained(error, object.scene));
  }
  return 1;
}

// machine(): the processor's name and the number of cores.
int machine(lua_State* L) {
  lua_pushstring(L, processor_name().c_str());
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

Function accuracy_function() {
  const std::vector<Field> own{
      {"methods", "strings", "", "integrators; all unless given", any_number, "", true},
      {"steps", "numbers", "R/c", "time steps of every method; six from 0.9 of its stability limit down unless given",
       any_number, "", true},
      {"of", "strings", "", "outcomes whose errors are taken; the first is printed and drawn", any_number, "{\"e\"}"},
      {"lattices", "numbers", "",
       "factors of the number of nodes, to show the error of the lattice or mesh by; none unless given", any_number, "",
       true},
      {"lattice_samples", "integer", "", "lattices or meshes of each size", {2, 10000}, "16"},
      {"repeats", "integer", "", "runs of each step; the least wall time counts", {1, 1000}, "3"},
      {"name", "string", "", "file name without extension", any_number, "accuracy"}};
  return {
      .name = "accuracy",
      .doc =
          "What accuracy costs: runs a scene by many methods and steps against two runs of order 6 at short steps, "
          "prints errors, force evaluations, wall times, energy drifts and fitted orders, and leaves NAME.csv and "
          "work-precision plots NAME.png, NAME.svg. With `lattices` it also shows what the size of the lattice, or of "
          "the mesh of a body of elements, changes, in a panel of its own. Where the program chose the contact, its "
          "softness is told beside. Returns a table with the rows (each with its `error` by column), the `reference`, "
          "its `floor`, `softness` (false, or xi and an error by column), and `cheapest(wanted)`: the row with the "
          "fewest force evaluations within that error.",
      .fields = std::vector<Field>{scene_field()} + own,
      .returns = "table",
      .example = "ricochet.accuracy { scene = scene, methods = { \"verlet\", \"pefrl\" }, of = { \"e\", \"beta\" } }"};
}

Function relevance_function() {
  const std::vector<Field> own{
      {"effects", "effects", "", "those that may matter"},
      {"of", "strings", "", "outcomes to compare", any_number, "{\"e\", \"beta\", \"mu\"}"},
      {"samples", "integer", "", "lattices or meshes: the scene's own and others of its kind", {2, 100000}, "8"}};
  return {
      .name = "relevance",
      .doc =
          "Which effects a scene calls for: runs it with and without each on the same lattices or meshes, prints the "
          "change of outcomes with its standard error beside that of their mean over the samples, whether it is seen "
          "(by chance in one of twenty cases, by Student's t), and the cost in time. All by verlet. An effect that "
          "cannot act on these bodies, as damping of springs on elements, is left out by name. Returns a list of "
          "tables: name, cost, and by outcome change, se, sampling; or name and `left_out`, the reason.",
      .fields = std::vector<Field>{scene_field()} + own,
      .returns = "table",
      .example = "ricochet.relevance { scene = scene, effects = { ricochet.gravity { g = 1e-4 } } }"};
}

Function plan_function() {
  return {
      .name = "plan",
      .doc =
          "The error budget of a sweep (time step, size of lattice or mesh, contact, samples: which one dominates), "
          "from a pilot, and the cheapest method, step, nodes and samples that bring a wanted standard error, with the "
          "time it will take. `plan:run()` runs that sweep, into the sweep's folder, and says how long it took. The "
          "error of a lattice or mesh is extrapolated in the spacing of its nodes, and what the pilot leaves unknown "
          "of it counts as error too. Of a contact that the program chose, its softness counts: the pilot runs again "
          "with one twice as hard, and twice the mean change counts if it is told apart from the scatter of the "
          "samples. The samples are planned with a deviation that nine pilots of ten do not underrate.",
      .fields = {{"sweep", "sweep", "",
                  "with one name in `over` that counts samples, or with samples = \"by_error\": each point then takes "
                  "as many as what the other errors leave asks for"},
                 {"standard_error", "number", "",
                  "wanted at every point: root of the sum of the squares of the four errors", positive},
                 {"of", "string", "", "the outcome it is about", any_number, "e"},
                 {"samples", "string", "", "the name in `over` that counts samples", any_number, "sample"},
                 {"pilot", "integer", "", "samples of the pilot at every point and size", {2, 100000}, "8"},
                 {"sizes", "numbers", "",
                  "factors of the number of nodes that the pilot tries; 0.25, 0.5 and 1 unless given, larger ones "
                  "where a body would have fewer than 100 nodes, which no plan chooses",
                  any_number, "", true},
                 {"continuum", "boolean", "",
                  "count as error what an infinitely fine lattice or mesh would change; else only what others than the "
                  "scene's own change",
                  any_number, "false"}},
      .returns = "plan",
      .example = "ricochet.plan { sweep = sweep, standard_error = 0.01 }:run()",
      .is_adaptive = true};
}

void add_accuracy_outcomes(lua_State* L) {
  push_accuracy_outcomes(L);
  lua_setfield(L, -2, "accuracy_outcomes");
}

}  // namespace

// Written in Lua: lua/ricochet/accuracy.lua, effects.lua and plan.lua, and what each of them prints.
Group accuracy_functions() {
  return {.functions = {accuracy_function(), relevance_function(), plan_function()},
          .natives = {{"accuracy_runs", guarded<accuracy_runs>},
                      {"methods", method_list},
                      {"conflict", guarded<conflict>},
                      {"refused_effects", guarded<refused_effects>},
                      {"machine", machine}},
          .add = add_accuracy_outcomes};
}

}  // namespace ricochet
