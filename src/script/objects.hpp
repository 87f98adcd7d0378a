#pragma once
// Values that Lua holds: bodies, effects and scenes, each with the place in the script that made it, and rows.

#include <lua.hpp>
#include <memory>

#include "impact/scene.hpp"
#include "record/row.hpp"
#include "script/report.hpp"

namespace ricochet {

struct BodyObject {
  std::shared_ptr<const Body> body;
};

struct MaterialObject {
  Material material;
};

struct EffectObject {
  Effect effect;
};

struct SceneObject {
  Scene scene;
  CallSite site;
};

/// Puts an object into a new userdata of type "ricochet.<name>"; its user value is the table at index 1, from which it
/// was made and which no script can reach, so that the same can be made with other numbers (core.given).
template <class Object>
void push_object(lua_State* L, const char* type, Object object) {
  new (lua_newuserdatauv(L, sizeof(Object), 1)) Object(std::move(object));
  luaL_setmetatable(L, type);
  lua_pushvalue(L, 1);
  lua_setiuservalue(L, -2, 1);
}

template <class Object>
int collect_object(lua_State* L) {
  static_cast<Object*>(lua_touserdata(L, 1))->~Object();
  return 0;
}

inline SceneObject& scene_at(lua_State* L, int index) {
  return *static_cast<SceneObject*>(luaL_checkudata(L, index, "ricochet.scene"));
}
inline BodyObject& body_at(lua_State* L, int index) {
  return *static_cast<BodyObject*>(luaL_checkudata(L, index, "ricochet.body"));
}
inline MaterialObject& material_at(lua_State* L, int index) {
  return *static_cast<MaterialObject*>(luaL_checkudata(L, index, "ricochet.material"));
}
inline EffectObject& effect_at(lua_State* L, int index) {
  return *static_cast<EffectObject*>(luaL_checkudata(L, index, "ricochet.effect"));
}

/// Makes the metatable of a type of objects: they take no new fields and have only these methods. `shown`: what
/// tostring() gives (displays.hpp).
void make_type(lua_State* L, const char* type, lua_CFunction collector, lua_CFunction shown,
               std::initializer_list<luaL_Reg> methods = {});

/// Adds to the metatable on top of the stack: scripts see none, and `index` answers for names that are not there.
void close_metatable(lua_State* L, lua_CFunction index);

/// Makes names that the table on top of the stack has not errors; `what` names the table.
void push_strict(lua_State* L, const std::string& what);

/// Pushes a table with every column of the row.
void push_row(lua_State* L, const Row& row);

}  // namespace ricochet
