#include "script/objects.hpp"

#include <fmt/format.h>

#include "core/spelling.hpp"
#include "impact/outcome.hpp"
#include "script/displays.hpp"
#include "script/reader.hpp"

namespace ricochet {
namespace {

// "ricochet.body: no field 'x'": an object takes no new fields and has only its methods.
int unknown_method(lua_State* L) {
  luaL_getmetafield(L, 1, "methods");
  lua_pushvalue(L, 2);
  if (lua_rawget(L, -2) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  const std::string type = kind_name(L, 1);
  throw unknown_name(L, "a " + type.substr(type.find('.') + 1), asked_name(L, 2), names_in(L, -1));
}

// A misspelt field of a table that was returned is an error, not nil.
int unknown_result(lua_State* L) { throw unknown_name(L, kind_name(L, 1), asked_name(L, 2), names_in(L, 1)); }

// A misspelt row.name is an error, not nil.
int unknown_column(lua_State* L) {
  const std::string name = asked_name(L, 2), nearest = did_you_mean(name, names_in(L, 1));
  throw at_line(
      L, fmt::format("a row has no column '{}'{}", name, nearest.empty() ? "; lua/REFERENCE.md lists them" : nearest));
}

void push_value(lua_State* L, double value) { lua_pushnumber(L, value); }
void push_value(lua_State* L, const std::string& value) { lua_pushstring(L, value.c_str()); }

}  // namespace

void close_metatable(lua_State* L, lua_CFunction index) {
  lua_pushcfunction(L, index);
  lua_setfield(L, -2, "__index");
  lua_pushboolean(L, false);
  lua_setfield(L, -2, "__metatable");
}

void make_type(lua_State* L, const char* type, lua_CFunction collector, lua_CFunction shown,
               std::initializer_list<luaL_Reg> methods) {
  luaL_newmetatable(L, type);
  lua_pushcfunction(L, collector);
  lua_setfield(L, -2, "__gc");
  lua_pushcfunction(L, shown);
  lua_setfield(L, -2, "__tostring");
  close_metatable(L, guarded<unknown_method>);
  lua_newtable(L);
  for (const luaL_Reg& method : methods) {
    lua_pushcfunction(L, method.func);
    lua_setfield(L, -2, method.name);
  }
  lua_setfield(L, -2, "methods");
  lua_pop(L, 1);
}

void push_strict(lua_State* L, const std::string& what) {
  lua_createtable(L, 0, 3);
  lua_pushstring(L, what.c_str());
  lua_setfield(L, -2, "__name");
  lua_pushcfunction(L, guarded<values_shown>);
  lua_setfield(L, -2, "__tostring");
  close_metatable(L, guarded<unknown_result>);
  lua_setmetatable(L, -2);
}

void push_row(lua_State* L, const Row& row) {
  lua_createtable(L, 0, static_cast<int>(row.outcomes.size() + Row::fields().size()));
  for (std::size_t i = 0; i < row.outcomes.size(); ++i) {
    lua_pushnumber(L, row.outcomes[i]);
    lua_setfield(L, -2, Outcome::fields()[i].first.name.c_str());
  }
  for (const Member<Row>& member : Row::fields()) {
    std::visit([&](auto place) { push_value(L, row.*place); }, member.place);
    lua_setfield(L, -2, member.field.name.c_str());
  }
  if (luaL_newmetatable(L, "row")) {
    lua_pushcfunction(L, guarded<values_shown>);
    lua_setfield(L, -2, "__tostring");
    close_metatable(L, guarded<unknown_column>);
  }
  lua_setmetatable(L, -2);
}

}  // namespace ricochet
