#include "script/lua_values.hpp"

#include <fmt/format.h>

namespace ricochet {
namespace {

std::string shown_number(lua_State* L, int index) {
  if (lua_isinteger(L, index)) return fmt::format("{}", lua_tointeger(L, index));
  const double value = lua_tonumber(L, index);
  return value != value ? "nan" : fmt::format("{}", value);
}

std::string shown_object(lua_State* L, int index) {
  if (kind_name(L, index).empty()) return "an object";
  if (is_object(L, index, "body")) return "a body";
  return is_object(L, index, "effect") ? "an effect" : "a scene";
}

}  // namespace

bool has_field(lua_State* L, int index, const char* field) {
  const bool there = lua_getfield(L, index, field) != LUA_TNIL;
  lua_pop(L, 1);
  return there;
}

std::vector<double> numbers_at(lua_State* L, int index) {
  std::vector<double> list;
  each_element(L, index, [&](lua_Integer) { list.push_back(lua_tonumber(L, -1)); });
  return list;
}

std::vector<std::string> names_in(lua_State* L, int index) {
  index = lua_absindex(L, index);
  std::vector<std::string> names;
  for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING)  // a conversion of the key would lead lua_next astray
      names.push_back(lua_tostring(L, -2));
  return names;
}

std::string shown(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNIL:
      return "nil";
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) ? "true" : "false";
    case LUA_TNUMBER:
      return shown_number(L, index);
    case LUA_TSTRING:
      return fmt::format("a string ('{:.40}')", lua_tostring(L, index));
    case LUA_TUSERDATA:
      return shown_object(L, index);
    default:
      break;
  }
  const std::string name = kind_name(L, index);
  if (name.empty()) return fmt::format("a {}", luaL_typename(L, index));
  return name == "sweep" ? "a sweep; run it first" : name;
}

std::string asked_name(lua_State* L, int index) {
  return lua_type(L, index) == LUA_TSTRING ? lua_tostring(L, index) : shown(L, index);
}

std::string kind_name(lua_State* L, int index) {
  const int type = luaL_getmetafield(L, index, "__name");
  if (type == LUA_TNIL) return "";
  const std::string name = type == LUA_TSTRING ? lua_tostring(L, -1) : "";
  lua_pop(L, 1);
  return name;
}

bool is_object(lua_State* L, int index, const std::string& type) {
  return luaL_testudata(L, index, ("ricochet." + type).c_str()) != nullptr;
}

void set_number(lua_State* L, const char* name, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, name);
}

}  // namespace ricochet
