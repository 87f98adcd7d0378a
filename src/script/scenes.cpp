// ricochet.scene, its tables and its effects.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "impact/outcome.hpp"
#include "script/displays.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/scaling.hpp"
#include "script/step_choice.hpp"
#include "script/sweep_report.hpp"
#include "script/yielding_bodies.hpp"

namespace ricochet {
namespace {

// A function of the catalogue: reads the fields of an effect.
template <class E>
int effect(lua_State* L) {
  check_table(L, 1, function_named(E::name));
  E made;
  read_members(L, 1, made);
  push_object(L, "ricochet.effect", EffectObject{made});
  return 1;
}

// Fields that contradict each other give no velocity.
void check_launch(const Launch& launch) { static_cast<void>(launch.velocity()); }

// Forces are per length across the plane, which both bodies share.
void check_thickness(const Scene& scene) {
  if (!scene.projectile->material || !scene.target->material) return;
  const double one = scene.projectile->material->thickness, other = scene.target->material->thickness;
  if (one != other)
    throw FieldError("target",
                     fmt::format("is {:g} m thick and the projectile {:g} m, but an impact in the plane is as "
                                 "thick everywhere; give both the same thickness",
                                 other, one));
}

// What else acts between surfaces acts by every segment that is near.
void check_rule(const Scene& scene) {
  if (scene.contact.sums()) return;
  for (const Effect& effect : scene.effects)
    if (std::visit([]<class E>(const E&) { return PairForceEffect<E> || PairMemory<E>; }, effect))
      throw FieldError("contact", fmt::format("rule = {} does not go with {}, which acts by all segments; take sum",
                                              scene.contact.rule, name_of(effect)));
}

// Throws FieldError for what no field is wrong in by itself.
void check_scene(const Scene& scene) {
  check_launch(scene.launch);
  check_thickness(scene);
  check_rule(scene);
  scene.integration.check();
  scene.ending.check(scene.integration);
  if (const std::string conflict = conflict_of(scene.effects); !conflict.empty()) throw FieldError("effects", conflict);
  if (const std::string conflict = scene.conflict_with(scene.method()); !conflict.empty())
    throw FieldError("method", conflict);
  if (scene.projectile->velocity != Vec2::Zero() || scene.projectile->spin != 0)
    throw FieldError("projectile",
                     "has a velocity or spin of its own, which only a target has; say them in launch instead");
  const auto& held = scene.projectile->anchored;
  if (std::find(held.begin(), held.end(), true) != held.end())
    throw FieldError("projectile", "must be free, but this body has anchored nodes");
}

// The effect on top of the stack, from the table that it was made of, in these units.
Effect read_effect(lua_State* L, const Units& units) {
  Effect effect = effect_at(L, -1).effect;
  if (!units.si) return effect;
  lua_getiuservalue(L, -1, 1);
  std::visit([&](auto& e) { read_members(L, lua_gettop(L), e, units); }, effect);
  lua_pop(L, 1);
  return effect;
}

// Whether the effect on top of the stack was given a field.
bool was_given(lua_State* L, const char* field) {
  lua_getiuservalue(L, -1, 1);
  const bool given = lua_getfield(L, -1, field) != LUA_TNIL;
  lua_pop(L, 2);
  return given;
}

bool is_si(lua_State* L) {
  lua_getfield(L, 1, "units");
  const bool si = lua_isstring(L, -1) && lua_tostring(L, -1) == std::string("SI");
  lua_pop(L, 1);
  return si;
}

// The scene of the table at index 1, whose numbers are in the units that it names.
Scene read_scene(lua_State* L) {
  Scene scene;
  lua_getfield(L, 1, "projectile");
  lua_getfield(L, 1, "target");
  if (is_si(L)) scene.units = si_units(*body_at(L, -2).body);
  scene.projectile = scaled(body_at(L, -2).body, scene.units, "projectile");
  scene.target = scaled(body_at(L, -1).body, scene.units, "target");
  read_members(L, 1, scene.integration, scene.units);
  read_inner_members(L, 1, "launch", scene.launch, scene.units);
  if (scene.units.si && std::isnan(scene.launch.speed) && std::isnan(scene.launch.normal_speed))
    throw FieldError("launch", "a scene in SI has no usual speed: give launch = { speed = ... } in m/s");
  read_inner_members(L, 1, "contact", scene.contact, scene.units);
  read_inner_members(L, 1, "ending", scene.ending, scene.units);
  each_in_field(L, 1, "effects", [&](lua_Integer) {
    Effect effect = read_effect(L, scene.units);
    auto* yielding = std::get_if<Yielding>(&effect);
    if (!yielding) return scene.effects.push_back(effect);
    if (!was_given(L, "on")) yielding->on = usually_on(*yielding, scene);
    add_yielding(*yielding, scene);
  });
  return scene;
}

// Pushes a copy of the table from which the object at `index` was made.
void push_given(lua_State* L, int index) {
  lua_getiuservalue(L, index, 1);
  const int table = lua_gettop(L);
  lua_newtable(L);
  for (lua_pushnil(L); lua_next(L, table) != 0;) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_settable(L, table + 1);
  }
  lua_remove(L, table);
}

// A study is about the first scene that a script makes; here the newest, on top of the stack.
void keep_first_scene(lua_State* L) {
  if (has_field(L, LUA_REGISTRYINDEX, "ricochet.first_scene")) return;
  lua_pushvalue(L, -1);
  lua_setfield(L, LUA_REGISTRYINDEX, "ricochet.first_scene");
}

int scene(lua_State* L) {
  check_table(L, 1, function_named("scene"));
  Session& session = session_of(L);
  SceneObject made{{}, call_site(L)};
  try {
    made.scene = read_scene(L);
    check_scene(made.scene);
  } catch (const FieldError& error) {
    throw_at(session, made.site, explained(error, made.scene));
  }
  if (const Method& method = made.scene.method(); !method.symplectic())
    session.warn(
        fmt::format("{} is a control: it is not symplectic, so the energy of an impact drifts for good", method.name));
  push_object(L, "ricochet.scene", std::move(made));
  if (!session.options.study.empty()) keep_first_scene(L);
  return 1;
}

Outcome run_one(Session& session, Scene& scene) {
  scene = with_chosen_step(session, scene);
  const BuiltSolids solids(scene);
  if (session.options.check) {
    check_start(solids, scene);
    return {};
  }
  RunProgress progress(session.options.quiet, isatty(STDERR_FILENO), launch(scene, solids).time_limit, scene.units);
  const auto pass = [&](double time) {
    progress.tell(time);
    return false;
  };
  const Observer observer{0, pass, {}};
  return run_scene(solids, scene, stop_requested, &observer, session.options.threads);
}

int scene_run(lua_State* L) {
  const SceneObject& object = scene_at(L, 1);
  Session& session = session_of(L);
  Scene scene = object.scene;
  Outcome outcome;
  const auto began = std::chrono::steady_clock::now();
  try {
    outcome = run_one(session, scene);
  } catch (const FieldError& error) {
    throw_at(session, object.site, explained(error, scene));
  }
  if (stop_requested) throw Error("interrupted", Exit::interrupted);
  const Method& method = scene.method();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - began;
  const Row row = row_of(scene, outcome, taken.count());
  SweepTold told(1);
  told.add_scene(0, scene);
  told.add_row(0, scene, row);
  if (!session.options.check && outcome.status != Status::no_contact)
    session.inform_first(
        fmt::format("{}:{}", object.site.file, object.site.line),
        fmt::format("scene: {}, time step {}, theta {:.4g} and at most {:.3g} (stable below {:.4g}); frequency bound "
                    "{}\n{}",
                    method.name, scene.units.shown(outcome.step, "R/c", 4), outcome.theta, outcome.theta_most,
                    method.stability_limit, scene.units.shown(outcome.theta / outcome.step, "c/R", 4),
                    told.of_scenes()));
  if (!session.options.check) {
    if (session.options.quiet) told.warn_of_doubts(session);
    session.count(row);
    if (session.singles.size() < Session::most_singles) session.singles.emplace_back(scene, row);
    told.warn_of_limit(session,
                       [&](std::size_t) { return fmt::format("{}:{}: scene", object.site.file, object.site.line); });
  }
  push_row(L, row);
  return 1;
}

int scene_text(lua_State* L) {
  lua_pushstring(L, scene_at(L, 1).scene.text().c_str());
  return 1;
}

int scene_hash(lua_State* L) {
  lua_pushstring(L, scene_at(L, 1).scene.hash().c_str());
  return 1;
}

// given(body or scene): a copy of the table it was made from.
int given(lua_State* L) {
  if (!is_object(L, 1, "body") && !is_object(L, 1, "scene"))
    throw std::logic_error("given: neither a body nor a scene");
  push_given(L, 1);
  return 1;
}

// catalogue(): { { name =, example = }, ... } of every kind of effect.
int catalogue(lua_State* L) {
  lua_newtable(L);
  each_effect_kind([&]<class E>(const E&) {
    lua_createtable(L, 0, 2);
    lua_pushstring(L, E::name);
    lua_setfield(L, -2, "name");
    lua_pushstring(L, E::example);
    lua_setfield(L, -2, "example");
    lua_seti(L, -2, list_length(L, -2) + 1);
  });
  return 1;
}

// effect_name(effect): that of its kind.
int effect_name(lua_State* L) {
  lua_pushstring(L, std::visit([]<class E>(const E&) { return E::name; }, effect_at(L, 1).effect));
  return 1;
}

// reseeded(effect, shift): the effect, with its seed moved on if it has one.
int reseeded(lua_State* L) {
  Effect effect = effect_at(L, 1).effect;
  const lua_Integer shift = luaL_checkinteger(L, 2);
  std::visit(
      [&](auto& e) {
        if constexpr (requires { e.seed; }) e.seed += shift;
      },
      effect);
  push_given(L, 1);
  if (has_field(L, -1, "seed")) {
    lua_getfield(L, -1, "seed");
    lua_pushinteger(L, lua_tointeger(L, -1) + shift);
    lua_setfield(L, -3, "seed");
    lua_pop(L, 1);
  }
  lua_replace(L, 1);
  push_object(L, "ricochet.effect", EffectObject{effect});
  return 1;
}

// nodes(scene): of both bodies, as far as they are computed.
int nodes(lua_State* L) {
  const Scene& scene = scene_at(L, 1).scene;
  lua_pushinteger(L, scene.projectile->moving_nodes() + scene.target->moving_nodes());
  return 1;
}

// nodes_of(body): as many as it was planned with, whether they move or not.
int nodes_of(lua_State* L) {
  lua_pushinteger(L, body_at(L, 1).body->numbers.nodes);
  return 1;
}

// strict(table, what): the table, in which names that it has not are errors.
int strict(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  const std::string what = luaL_checkstring(L, 2);
  lua_settop(L, 1);
  push_strict(L, what);
  return 1;
}

Function scene_function() {
  const std::vector<Field> parts{
      {"projectile", "body", "", "the body that flies in; free"},
      {"target", "body", "", "the body that is hit; free or anchored"},
      {"launch", "launch", "", "how the projectile comes in", any_number, "{}"},
      {"contact", "contact", "", "how the bodies repel each other", any_number, "{}"},
      {"ending", "ending", "", "when the impact is over", any_number, "{}"},
      {"units",
       "string",
       "",
       "of every number of the scene, its bodies, effects and rows: paper: R, m0, c; SI: m, kg, s, with bodies of "
       "materials",
       any_number,
       "paper",
       false,
       {"paper", "SI"}},
      {"effects", "effects", "",
       "list of what else acts, e.g. { ricochet.gravity { g = 1e-4 } }; what is not named is not computed", any_number,
       "{}"}};
  return {
      .name = "scene",
      .doc =
          "One impact: a free projectile falls on a target along -y and moves along +x, or along -x where psi1 is "
          "below 0. It is placed upstream so that its smooth outline would touch the target's at x = launch.at. Speeds "
          "are those in space: launch.speed of the projectile, body.velocity of the target, which is where it was "
          "built when the run begins; heights and gaps are between the two. `scene:run()` runs it and returns a row, "
          "`scene:bounces { }` several impacts one after another; `scene:text()` is its canonical text, `scene:hash()` "
          "that text's hash.",
      .fields = parts + fields_of<Integration>(),
      .returns = "scene",
      .example =
          "ricochet.scene { projectile = ricochet.disk {}, target = ricochet.wall { stiffness = 100 }, "
          "launch = { psi1 = 3 } }",
      .call = guarded<scene>};
}

template <class E>
Function effect_function() {
  std::string doc = std::string("An effect, for the `effects` of a scene. ") + E::doc;
  if (is_split(E{})) doc += fmt::format(" Goes with verlet only: outcomes converge at order {}.", order_beside(E{}));
  return {.name = E::name,
          .doc = doc,
          .fields = fields_of<E>(),
          .returns = "effect",
          .example = E::example,
          .call = guarded<effect<E>>};
}

void make_types(lua_State* L) {
  make_type(L, "ricochet.effect", collect_object<EffectObject>, guarded<effect_shown>);
  make_type(L, "ricochet.scene", collect_object<SceneObject>, guarded<scene_shown>,
            {{"run", guarded<scene_run>}, {"text", guarded<scene_text>}, {"hash", guarded<scene_hash>}});
}

}  // namespace

Group scene_functions() {
  Group group;
  group.functions = {
      scene_function(),
      {.name = "launch", .doc = "The `launch` table of a scene.", .fields = fields_of<Launch>(), .is_table = true},
      {.name = "contact",
       .doc = "The `contact` table of a scene: V0 exp(-xi d), summed over the rim segments within reach of each rim "
              "node.",
       .fields = fields_of<ExponentialRepulsion>(),
       .is_table = true},
      {.name = "ending",
       .doc = "The `ending` table of a scene: when its impact is over, and its row is made.",
       .fields = fields_of<EndRule>(),
       .is_table = true}};
  group.functions.push_back(
      {.name = "refined",
       .doc = "The scene with `factor` times as many nodes in both bodies: outlines, masses and stiffness stay. A step "
              "that was given is left to the program again.",
       .returns = "scene",
       .example = "ricochet.refined(scene, 4):run()",
       .arguments = {{"scene", "scene"}, {"factor", "number"}}});
  each_effect_kind([&]<class E>(const E&) { group.functions.push_back(effect_function<E>()); });
  group.natives = {{"given", guarded<given>},   {"strict", strict}, {"catalogue", catalogue},
                   {"reseeded", reseeded},      {"nodes", nodes},   {"nodes_of", nodes_of},
                   {"effect_name", effect_name}};
  group.add = make_types;
  return group;
}

}  // namespace ricochet
