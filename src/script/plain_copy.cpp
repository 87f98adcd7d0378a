// Copies of a script's tables that it cannot reach.

#include <fmt/format.h>

#include <algorithm>

#include "script/reader.hpp"

namespace ricochet {
namespace {

// Of an object's kind its name stays, for messages. The original is at `index`, its copy on top of the stack.
void keep_kind_name(lua_State* L, int index) {
  const std::string name = kind_name(L, index);
  if (name.empty()) return;
  lua_createtable(L, 0, 1);
  lua_pushlstring(L, name.data(), name.size());
  lua_setfield(L, -2, "__name");
  lua_setmetatable(L, -2);
}

// Puts what is read from a file, a row of a long sweep or a list of them, in the place of the table on top of the stack
// that stands for it. Others stay.
void read_whole(lua_State* L) {
  if (luaL_getmetafield(L, -1, "whole") == LUA_TNIL) return;
  lua_pushvalue(L, -2);
  lua_call(L, 1, 1);
  if (lua_istable(L, -1))
    lua_replace(L, -2);
  else
    lua_pop(L, 1);
}

// Pushes a plain copy of a value: tables without their metatables, the same ones once (`copies`, at an absolute index,
// remembers them), all else as it is.
void push_plain(lua_State* L, int index, int copies, int depth = 0) {
  constexpr int deepest = 100;
  if (depth > deepest)
    throw at_line(L, fmt::format("a table holds tables that hold tables, more than {} deep", deepest));
  index = lua_absindex(L, index);
  luaL_checkstack(L, 8, "tables in tables");
  lua_pushvalue(L, index);
  if (!lua_istable(L, index)) return;
  if (lua_rawget(L, copies) != LUA_TNIL) return;
  lua_pop(L, 1);
  lua_pushvalue(L, index);
  read_whole(L);
  const int whole = lua_gettop(L);
  // A list with a hole in it stays as long as it is. (A table that is no list may have any length.)
  constexpr lua_Unsigned longest_list = 10'000'000;
  const lua_Unsigned length = lua_rawlen(L, whole);
  lua_createtable(L, length <= longest_list ? static_cast<int>(length) : 0, 0);
  const int copy = lua_gettop(L);
  lua_pushvalue(L, index);
  lua_pushvalue(L, copy);
  lua_rawset(L, copies);
  for (lua_pushnil(L); lua_next(L, whole) != 0;) {
    lua_pushvalue(L, -2);
    push_plain(L, -2, copies, depth + 1);
    lua_rawset(L, copy);
    lua_pop(L, 1);
  }
  keep_kind_name(L, index);
  lua_remove(L, whole);
}

const Field* field_named(const std::vector<Field>& fields, const char* name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

void push_plain_fields(lua_State* L, int index, const std::vector<Field>& fields, int copies);

// Pushes a copy of the value of a field (nullptr: of an unknown one).
void push_plain_value(lua_State* L, int index, const Field* field, int copies) {
  const Function* inner = field ? inner_table(field->type) : nullptr;
  if (field && (field->type == "sweep" || field->type == "rows"))
    lua_pushvalue(L, index);  // long, and read with care
  else if (inner && lua_istable(L, index))
    push_plain_fields(L, index, inner->fields, copies);
  else
    push_plain(L, index, copies);
}

// Puts into the copy, on top of the stack, what only the original's metatable supplies.
void add_supplied_fields(lua_State* L, int index, const std::vector<Field>& fields, int copies) {
  const int copy = lua_gettop(L);
  for (const Field& field : fields) {
    lua_pushstring(L, field.name.c_str());
    const bool there = lua_rawget(L, copy) != LUA_TNIL;
    lua_pop(L, 1);
    if (there) continue;
    if (lua_getfield(L, index, field.name.c_str()) != LUA_TNIL) {
      push_plain_value(L, lua_absindex(L, -1), &field, copies);
      lua_setfield(L, copy, field.name.c_str());
    }
    lua_pop(L, 1);
  }
}

// Pushes a copy of a table of named fields.
void push_plain_fields(lua_State* L, int index, const std::vector<Field>& fields, int copies) {
  index = lua_absindex(L, index);
  lua_newtable(L);
  const int copy = lua_gettop(L);
  for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
    const Field* field = lua_type(L, -2) == LUA_TSTRING ? field_named(fields, lua_tostring(L, -2)) : nullptr;
    lua_pushvalue(L, -2);
    push_plain_value(L, lua_absindex(L, -2), field, copies);
    lua_rawset(L, copy);
  }
  if (!lua_getmetatable(L, index)) return;
  lua_pop(L, 1);
  add_supplied_fields(L, index, fields, copies);
}

// Puts what `push` pushes, given the index of a table that remembers copies, in the place of the value at `index`.
template <class Push>
void replace_by(lua_State* L, int index, Push push) {
  lua_newtable(L);
  push(lua_gettop(L));
  lua_replace(L, index);
  lua_pop(L, 1);
}

}  // namespace

void make_plain(lua_State* L, int index) {
  index = lua_absindex(L, index);
  replace_by(L, index, [&](int copies) { push_plain(L, index, copies); });
}

void make_plain(lua_State* L, int index, const std::vector<Field>& fields) {
  index = lua_absindex(L, index);
  replace_by(L, index, [&](int copies) { push_plain_fields(L, index, fields, copies); });
}

}  // namespace ricochet
