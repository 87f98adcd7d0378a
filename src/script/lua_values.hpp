#pragma once
// Values on Lua's stack, as readers and messages see them.

#include <lua.hpp>
#include <string>
#include <vector>

namespace ricochet {

/// Elements of a list, as it holds them: a metatable might tell of any number, and of others at each reading.
inline lua_Integer list_length(lua_State* L, int index) { return static_cast<lua_Integer>(lua_rawlen(L, index)); }

/// Calls use(i) for each element i = 1, 2, ... of the list at `index`, with the element on top of the stack.
template <class Use>
void each_element(lua_State* L, int index, Use use) {
  index = lua_absindex(L, index);
  for (lua_Integer i = 1; i <= list_length(L, index); ++i) {
    lua_rawgeti(L, index, i);
    use(i);
    lua_pop(L, 1);
  }
}

/// The same for the list in a field of the table at `index`; no call if there is none.
template <class Use>
void each_in_field(lua_State* L, int index, const char* field, Use use) {
  if (lua_getfield(L, index, field) == LUA_TTABLE) each_element(L, -1, use);
  lua_pop(L, 1);
}

/// True if the table at `index` has the field.
bool has_field(lua_State* L, int index, const char* field);

std::vector<double> numbers_at(lua_State* L, int index);

/// The keys of the table at `index` that are strings.
std::vector<std::string> names_in(lua_State* L, int index);

/// A value as a message shows it: "a string ('abc')", "nil", "-1".
std::string shown(lua_State* L, int index);
/// The same, but a string as it is: a name that was asked for.
std::string asked_name(lua_State* L, int index);

/// The name that the value's metatable gives to its kind ("sweep"); empty if it has none.
std::string kind_name(lua_State* L, int index);

/// True for an object of ours: "body", "scene" or "effect".
bool is_object(lua_State* L, int index, const std::string& type);

/// table[name] = value, of the table on top of the stack.
void set_number(lua_State* L, const char* name, double value);

}  // namespace ricochet
