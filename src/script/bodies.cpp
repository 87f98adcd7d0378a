// ricochet.body, ricochet.scene, ricochet.elasticity.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"
#include "core/spelling.hpp"
#include "impact/batch.hpp"
#include "lattice/elasticity.hpp"
#include "lattice/outline.hpp"
#include "script/objects.hpp"
#include "script/state.hpp"

namespace ricochet {
namespace {

Points read_points(lua_State* L, int index) {
  Points points;
  for (lua_Integer i = 1; i <= length_of(L, index); ++i) {
    lua_rawgeti(L, index, i);
    lua_rawgeti(L, -1, 1);
    lua_rawgeti(L, -2, 2);
    points.emplace_back(lua_tonumber(L, -2), lua_tonumber(L, -1));
    lua_pop(L, 3);
  }
  return points;
}

// Calls the function in the table's field at a point; leaves its value on the stack.
void call_at(lua_State* L, int function, const Vec2& p) {
  lua_pushvalue(L, function);
  lua_pushnumber(L, p.x());
  lua_pushnumber(L, p.y());
  lua_call(L, 2, 1);
}

std::string plan_key(const Points& outline, const BodyNumbers& n, const std::vector<bool>& anchored_rim) {
  std::string text = fmt::format("{} {} {} {};", n.nodes, n.placement, n.seed, n.roughness);
  for (const Vec2& p : outline) text += fmt::format("{} {};", p.x(), p.y());
  for (const bool held : anchored_rim) text += held ? '1' : '0';
  return hash_text(text);
}

template <bool ours>
int body(lua_State* L) {
  check_table(L, 1, function_named("body"), ours);
  Session& session = session_of(L);
  auto made = std::make_shared<Body>();
  try {
    read_members(L, 1, made->numbers);
    lua_getfield(L, 1, "outline");
    made->outline = read_points(L, lua_gettop(L));
    if (signed_area(made->outline) < 0) std::reverse(made->outline.begin(), made->outline.end());
    lua_getfield(L, 1, "anchored");
    const int anchored = lua_gettop(L);
    lua_getfield(L, 1, "stiffness");
    const int stiffness = lua_gettop(L);
    const auto held = [&](const Vec2& p) {
      call_at(L, anchored, p);
      const bool value = lua_toboolean(L, -1);
      lua_pop(L, 1);
      return value;
    };
    const Points rim = plan_rim(made->outline, made->numbers);
    std::vector<bool> anchored_rim;
    if (lua_isfunction(L, anchored))
      for (const Vec2& p : rim) anchored_rim.push_back(held(p));
    // Samples of a sweep share bodies: a plan is made once.
    auto& plan = session.plans[plan_key(made->outline, made->numbers, anchored_rim)];
    if (!plan) plan = std::make_shared<NodePlan>(plan_nodes(made->outline, made->numbers, anchored_rim));
    const auto planned = plan;
    session.planned_nodes += made->numbers.nodes;
    constexpr double most_planned = 2e7;  // half a GB: then the plans are made again
    if (session.planned_nodes > most_planned) {
      session.plans.clear();
      session.planned_nodes = 0;
    }
    if (lua_isfunction(L, anchored)) {
      made->anchored = anchored_rim;
      for (std::size_t i = made->anchored.size(); i < planned->points.size(); ++i)
        made->anchored.push_back(held(planned->points[i]));
      if (std::count(made->anchored.begin(), made->anchored.end(), false) == 0)
        throw FieldError("anchored", "holds every node; nothing could move");
    }
    if (lua_isfunction(L, stiffness)) {
      made->numbers.stiffness = 1;
      for (const Vec2& p : planned->points) {
        call_at(L, stiffness, p);
        const double k = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : not_given;
        if (!(k > 0 && std::isfinite(k)))
          throw FieldError("stiffness",
                           fmt::format("the function must return a positive number, gave {} at ({:.4g}, {:.4g})",
                                       shown(L, -1), p.x(), p.y()));
        lua_pop(L, 1);
        made->node_stiffness.push_back(k);
      }
    }
  } catch (const FieldError& error) {
    throw_at(session, call_site(L), error);
  }
  const std::size_t bytes =
      made->outline.size() * sizeof(Vec2) + made->anchored.size() / 8 + made->node_stiffness.size() * sizeof(double);
  push_object(L, "ricochet.body", BodyObject{made});
  lua_gc(L, LUA_GCSTEP, static_cast<int>(bytes / 1024 + 1));  // Lua does not see what its object holds
  return 1;
}

// A function of the catalogue: reads the fields of an effect.
template <std::size_t kind>
int effect(lua_State* L) {
  using E = std::variant_alternative_t<kind, Effect>;
  check_table(L, 1, function_named(E::name));
  E made;
  read_members(L, 1, made);
  push_object(L, "ricochet.effect", EffectObject{made});
  return 1;
}

int scene(lua_State* L) {
  check_table(L, 1, function_named("scene"));
  SceneObject made{{}, call_site(L)};
  lua_getfield(L, 1, "projectile");
  lua_getfield(L, 1, "target");
  made.scene.projectile = body_at(L, -2).body;
  made.scene.target = body_at(L, -1).body;
  read_members(L, 1, made.scene.integration);
  if (lua_getfield(L, 1, "launch") == LUA_TTABLE) read_members(L, lua_gettop(L), made.scene.launch);
  if (lua_getfield(L, 1, "contact") == LUA_TTABLE) read_members(L, lua_gettop(L), made.scene.contact);
  if (lua_getfield(L, 1, "effects") == LUA_TTABLE)
    for (lua_Integer i = 1; i <= length_of(L, -1); ++i) {
      lua_rawgeti(L, -1, i);
      made.scene.effects.push_back(effect_at(L, -1).effect);
      lua_pop(L, 1);
    }
  try {
    made.scene.launch.velocity();
    made.scene.integration.check();
    if (const std::string conflict = conflict_of(made.scene.effects); !conflict.empty())
      throw FieldError("effects", conflict);
    if (const std::string conflict = made.scene.conflict_with(made.scene.method()); !conflict.empty())
      throw FieldError("method", conflict);
    const auto& held = made.scene.projectile->anchored;
    if (std::find(held.begin(), held.end(), true) != held.end())
      throw FieldError("projectile", "must be free, but this body has anchored nodes");
  } catch (const FieldError& error) {
    throw_at(session_of(L), made.site, error);
  }
  if (const Method& method = made.scene.method(); !method.symplectic())
    session_of(L).warn(
        fmt::format("{} is a control: it is not symplectic, so the energy of an impact drifts for good", method.name));
  push_object(L, "ricochet.scene", std::move(made));
  if (!session_of(L).options.study.empty()) {
    const bool first = lua_getfield(L, LUA_REGISTRYINDEX, "ricochet.first_scene") == LUA_TNIL;
    lua_pop(L, 1);
    if (first) {
      lua_pushvalue(L, -1);
      lua_setfield(L, LUA_REGISTRYINDEX, "ricochet.first_scene");
    }
  }
  return 1;
}

int scene_run(lua_State* L) {
  const SceneObject& object = scene_at(L, 1);
  Scene scene = object.scene;
  Outcome outcome;
  try {
    scene = with_chosen_step(session_of(L), scene);
    const auto projectile = build_lattice(*scene.projectile), target = build_lattice(*scene.target);
    if (session_of(L).options.check)
      check_start(*projectile, *target, scene);
    else
      outcome = run_scene(*projectile, *target, scene, stop_requested);
  } catch (const FieldError& error) {
    throw_at(session_of(L), object.site, error);
  }
  if (stop_requested) throw Error("interrupted", Exit::interrupted);
  if (!session_of(L).options.check && outcome.status != Status::no_contact)
    session_of(L).print_first(fmt::format("{}:{}", object.site.file, object.site.line),
                              fmt::format("scene: {}, time step {:.4g} R/c, theta {:.4g} and at most {:.3g} (stable "
                                          "below {:.4g}); frequency bound {:.4g} c/R\n",
                                          scene.method().name, outcome.step, outcome.theta, outcome.theta_most,
                                          scene.method().stability_limit, outcome.theta / outcome.step));
  if (!session_of(L).options.check)
    session_of(L).count(outcome.status == Status::finished, name_of(outcome.status) + ": " + outcome.reason);
  push_row(L, row_of(scene, outcome, 0));
  return 1;
}

// given(body or scene): a copy of the table it was made from.
int given(lua_State* L) {
  if (!luaL_testudata(L, 1, "ricochet.body") && !luaL_testudata(L, 1, "ricochet.scene"))
    throw std::logic_error("given: neither a body nor a scene");
  lua_getiuservalue(L, 1, 1);
  lua_newtable(L);
  for (lua_pushnil(L); lua_next(L, 2) != 0;) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_settable(L, 3);
  }
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
    lua_seti(L, -2, length_of(L, -2) + 1);
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
  lua_newtable(L);
  lua_replace(L, 1);  // what it was made from: nothing that is asked for
  push_object(L, "ricochet.effect", EffectObject{effect});
  return 1;
}

// nodes(scene): of both bodies.
int nodes(lua_State* L) {
  const Scene& scene = scene_at(L, 1).scene;
  lua_pushinteger(L, scene.projectile->numbers.nodes + scene.target->numbers.nodes);
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

// A misspelt field of a table that was returned is an error, not nil.
int unknown_result(lua_State* L) {
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, 1) != 0; lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) names.push_back(lua_tostring(L, -2));
  luaL_getmetafield(L, 1, "__name");
  throw unknown_name(L, lua_tostring(L, -1), lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : shown(L, 2), names);
}

// strict(table, what): the table, in which names that it has not are errors.
int strict(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  const std::string what = luaL_checkstring(L, 2);
  lua_settop(L, 1);
  push_strict(L, what);
  return 1;
}

int elasticity(lua_State* L) {
  check_table(L, 1, function_named("elasticity"));
  lua_getfield(L, 1, "body");
  const Body& band = *body_at(L, -1).body;
  if (std::find(band.anchored.begin(), band.anchored.end(), true) != band.anchored.end())
    throw_at(session_of(L), call_site(L), FieldError("body", "must have no anchored nodes"));
  Elasticity result{};
  try {
    result = stretch_band(*build_lattice(band), band.numbers.stiffness);
  } catch (const Error& error) {
    throw_at(session_of(L), call_site(L), FieldError("body", error.what()));
  }
  lua_createtable(L, 0, 2);
  lua_pushnumber(L, result.young_modulus);
  lua_setfield(L, -2, "E");
  lua_pushnumber(L, result.poisson_ratio);
  lua_setfield(L, -2, "nu");
  push_strict(L, "the table of moduli");
  return 1;
}

// "ricochet.body: no field 'x'": an object takes no new fields and has only its methods.
int unknown_method(lua_State* L) {
  luaL_getmetafield(L, 1, "methods");
  lua_pushvalue(L, 2);
  if (lua_rawget(L, -2) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) names.push_back(lua_tostring(L, -2));
  luaL_getmetafield(L, 1, "__name");
  const std::string name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : shown(L, 2), type = lua_tostring(L, -1);
  throw unknown_name(L, "a " + type.substr(type.find('.') + 1), name, names);
}

void make_type(lua_State* L, const char* type, lua_CFunction collector, std::initializer_list<luaL_Reg> methods) {
  luaL_newmetatable(L, type);
  lua_pushcfunction(L, collector);
  lua_setfield(L, -2, "__gc");
  lua_pushboolean(L, false);
  lua_setfield(L, -2, "__metatable");
  lua_pushcfunction(L, guarded<unknown_method>);
  lua_setfield(L, -2, "__index");
  lua_newtable(L);
  for (const luaL_Reg& method : methods) {
    lua_pushcfunction(L, method.func);
    lua_setfield(L, -2, method.name);
  }
  lua_setfield(L, -2, "methods");
  lua_pop(L, 1);
}

}  // namespace

void push_strict(lua_State* L, const std::string& what) {
  lua_createtable(L, 0, 2);
  lua_pushstring(L, what.c_str());
  lua_setfield(L, -2, "__name");
  lua_pushcfunction(L, guarded<unknown_result>);
  lua_setfield(L, -2, "__index");
  lua_pushboolean(L, false);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, -2);
}

void add_bodies(lua_State* L) {
  make_type(L, "ricochet.body", collect_object<BodyObject>, {});
  make_type(L, "ricochet.effect", collect_object<EffectObject>, {});
  make_type(L, "ricochet.scene", collect_object<SceneObject>,
            {{"run", guarded<scene_run>}, {"text", guarded<scene_text>}, {"hash", guarded<scene_hash>}});
  const luaL_Reg list[] = {{"body", guarded<body<false>>}, {"own_body", guarded<body<true>>},
                           {"scene", guarded<scene>},      {"elasticity", guarded<elasticity>},
                           {"given", guarded<given>},      {"strict", strict},
                           {"catalogue", catalogue},       {"effect_name", effect_name},
                           {"reseeded", reseeded},         {"nodes", nodes}};
  for (const luaL_Reg& f : list) {
    lua_pushcfunction(L, f.func);
    lua_setfield(L, -2, f.name);
  }
  lua_newtable(L);  // core.effects: name -> function
  [&]<std::size_t... kind>(std::index_sequence<kind...>) {
    ((lua_pushcfunction(L, guarded<effect<kind>>), lua_setfield(L, -2, std::variant_alternative_t<kind, Effect>::name)),
     ...);
  }
  (std::make_index_sequence<effect_kinds>{});
  lua_setfield(L, -2, "effects");
}

}  // namespace ricochet
