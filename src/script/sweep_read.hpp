#pragma once
// A sweep as lua/ricochet/sweep.lua hands it over: lists of points and of scenes.

#include <lua.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "impact/scene.hpp"
#include "script/sweep_parameters.hpp"

namespace ricochet {

/// Each name's values at all points: of numbers, or of texts. `units`: of parameters, by name.
Parameters read_parameters(lua_State* L, int names, int points, int units);

std::vector<Scene> scenes_at(lua_State* L, int list);

/// Throws the error of a scene of the list at the place that made it; `where`: more about it.
[[noreturn]] void throw_at_scene(lua_State* L, int list, const SceneError& error, const std::string& where = "");

}  // namespace ricochet
