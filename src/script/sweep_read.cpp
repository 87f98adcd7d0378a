#include "script/sweep_read.hpp"

#include <fmt/format.h>

#include "script/objects.hpp"
#include "script/reader.hpp"

namespace ricochet {

Parameters read_parameters(lua_State* L, int names, int points, int units) {
  Parameters p;
  each_element(L, names, [&](lua_Integer) { p.names.push_back(lua_tostring(L, -1)); });
  p.numbers.resize(p.names.size());
  p.texts.resize(p.names.size());
  for (std::size_t k = 0; k < p.names.size(); ++k)
    each_element(L, points, [&](lua_Integer) {
      const int type = lua_getfield(L, -1, p.names[k].c_str());
      if (type == LUA_TNUMBER)
        p.numbers[k].push_back(lua_tonumber(L, -1));
      else
        p.texts[k].push_back(type == LUA_TBOOLEAN ? (lua_toboolean(L, -1) ? "true" : "false") : lua_tostring(L, -1));
      lua_pop(L, 1);
    });
  p.units.resize(p.names.size());
  for (std::size_t k = 0; lua_istable(L, units) && k < p.names.size(); ++k) {
    if (lua_getfield(L, units, p.names[k].c_str()) == LUA_TSTRING) p.units[k] = lua_tostring(L, -1);
    lua_pop(L, 1);
  }
  return p;
}

std::string ran_already(const std::string& name) {
  return fmt::format(
      "a sweep called '{}' has run already and its results would be replaced; give this one another name", name);
}

std::vector<Scene> scenes_at(lua_State* L, int list) {
  std::vector<Scene> scenes;
  each_element(L, list, [&](lua_Integer) { scenes.push_back(scene_at(L, -1).scene); });
  return scenes;
}

[[noreturn]] void throw_at_scene(lua_State* L, int list, const SceneError& error, const std::string& where) {
  lua_rawgeti(L, list, static_cast<lua_Integer>(error.scene) + 1);
  const SceneObject& object = scene_at(L, -1);
  throw_at(session_of(L), object.site, FieldError(error.field, object.scene.units.explained(error.what()) + where));
}

}  // namespace ricochet
