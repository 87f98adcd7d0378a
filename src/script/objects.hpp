#pragma once
// Values that Lua holds: bodies and scenes, each with the place in the script that made it.

#include <filesystem>
#include <lua.hpp>
#include <memory>

#include "impact/outcome.hpp"
#include "impact/scene.hpp"
#include "script/reader.hpp"

namespace ricochet {

struct BodyObject {
  std::shared_ptr<const Body> body;
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

inline EffectObject& effect_at(lua_State* L, int index) {
  return *static_cast<EffectObject*>(luaL_checkudata(L, index, "ricochet.effect"));
}

/// A row of results as values in the order of row_fields().
struct Row {
  std::vector<double> values;
  std::string status, reason, hash, seed;
  double seconds = 0;
};

/// Scenes that ask for an accuracy with the method and step chosen for it, by trial runs; prints what was chosen.
/// Others as they are.
std::vector<Scene> with_chosen_steps(Session& session, const std::vector<Scene>& scenes);
/// The same, told to run.log only.
std::vector<Scene> with_quietly_chosen_steps(Session& session, const std::vector<Scene>& scenes);
/// The same for one scene; the choice is kept for the rest of the run. With --check nothing is tried.
Scene with_chosen_step(Session& session, const Scene& scene);

Row row_of(const Scene& scene, const Outcome& outcome, double seconds);

/// A path below the run's own folder. Throws Error if the name, or a link, leads out of it.
std::filesystem::path below_folder(lua_State* L, const std::string& name);

/// Pushes a table with every column of the row.
void push_row(lua_State* L, const Row& row);

}  // namespace ricochet
