#include "script/kept_bodies.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "script/lua_values.hpp"

namespace ricochet {
namespace {

// Then they are made again: a list of all bodies of a long sweep would be no small one.
constexpr lua_Integer most_kept = 256;

template <class Value>
std::string bytes_of(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// What tells the value on top of the stack from others; nothing for what may change or be as long as it likes.
std::optional<std::string> text_of_value(lua_State* L) {
  switch (lua_type(L, -1)) {
    case LUA_TNUMBER:
      return lua_isinteger(L, -1) ? "i" + bytes_of(lua_tointeger(L, -1)) : "n" + bytes_of(lua_tonumber(L, -1));
    case LUA_TBOOLEAN:
      return lua_toboolean(L, -1) ? "true" : "false";
    case LUA_TSTRING:
      return "s" + std::string(lua_tostring(L, -1), lua_rawlen(L, -1));
    case LUA_TUSERDATA:
      return "u" + bytes_of(lua_touserdata(L, -1));
    default:
      return std::nullopt;
  }
}

// What tells a table of plain named values from others, in whatever order they stand; nothing for other tables.
std::optional<std::string> key_of(lua_State* L, int index) {
  if (lua_getmetatable(L, index)) {
    lua_pop(L, 1);
    return std::nullopt;
  }
  std::vector<std::string> fields;
  for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
    const auto value = lua_type(L, -2) == LUA_TSTRING ? text_of_value(L) : std::nullopt;
    if (!value) {
      lua_pop(L, 2);
      return std::nullopt;
    }
    const std::string name = lua_tostring(L, -2);
    fields.push_back(bytes_of(name.size()) + name + bytes_of(value->size()) + *value);
  }
  std::sort(fields.begin(), fields.end());
  std::string key;
  for (const std::string& field : fields) key += field;
  return key;
}

void empty_upvalue(lua_State* L, int upvalue) {
  lua_newtable(L);
  lua_replace(L, lua_upvalueindex(upvalue));
}

// Upvalues: the function; bodies by their keys; the tables that they were made of, by count, so that no object in one
// of these gives its place to another.
int kept(lua_State* L) {
  const auto key = lua_gettop(L) == 1 && lua_istable(L, 1) ? key_of(L, 1) : std::nullopt;
  if (key) {
    lua_pushlstring(L, key->data(), key->size());
    if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
    lua_pop(L, 1);
    lua_createtable(L, 0, 4);
    for (lua_pushnil(L); lua_next(L, 1) != 0;) {
      lua_pushvalue(L, -2);
      lua_insert(L, -2);
      lua_rawset(L, -4);
    }
    lua_insert(L, 1);
  }
  const int before = key ? 1 : 0;
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1 + before);
  lua_call(L, lua_gettop(L) - 1 - before, LUA_MULTRET);
  if (!key || lua_gettop(L) != 2 || !is_object(L, 2, "body")) return lua_gettop(L) - before;
  lua_Integer count = list_length(L, lua_upvalueindex(3));
  if (count == most_kept) {
    empty_upvalue(L, 2);
    empty_upvalue(L, 3);
    count = 0;
  }
  lua_pushvalue(L, 1);
  lua_rawseti(L, lua_upvalueindex(3), count + 1);
  lua_pushlstring(L, key->data(), key->size());
  lua_pushvalue(L, 2);
  lua_rawset(L, lua_upvalueindex(2));
  return 1;
}

}  // namespace

int wrap_keeping(lua_State* L) {
  lua_settop(L, 1);
  lua_newtable(L);
  lua_newtable(L);
  lua_pushcclosure(L, kept, 3);
  return 1;
}

}  // namespace ricochet
