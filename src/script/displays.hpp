#pragma once
// What tostring(), print() and the repl show of the module's objects.

#include <lua.hpp>

namespace ricochet {

/// Lua functions for `__tostring`.
int body_shown(lua_State* L);
int material_shown(lua_State* L);
int effect_shown(lua_State* L);
int scene_shown(lua_State* L);
/// Of a row, or another table of named values: a line each, those of a row in the reference's order; what is undefined
/// (NaN) is left out.
int values_shown(lua_State* L);

}  // namespace ricochet
