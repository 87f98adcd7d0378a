#pragma once
// Tables of a script: checked against their fields, all mistakes reported together at the fields' own lines.

#include <lua.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sandbox/sandbox.hpp"
#include "script/functions.hpp"
#include "script/lua_values.hpp"
#include "script/report.hpp"
#include "script/session.hpp"
#include "script/source.hpp"

namespace ricochet {

/// Puts a copy in the place of the value at `index` that the script cannot reach: tables, and those in them, without
/// metatables.
void make_plain(lua_State* L, int index);

/// The same for a table of named fields: those that a metatable supplies (a table of defaults, say) are part of the
/// copy. Rows and sweeps stay what they are.
void make_plain(lua_State* L, int index, const std::vector<Field>& fields);

/// Checks the table at `index` against the fields of a function; throws Error with every mistake. A plain copy takes
/// its place, so that what is checked is what is used, whatever its metatables do and the script does with it later.
/// The library's own tables (`ours`), which no script can reach, are not copied.
void check_table(lua_State* L, int index, const Function& function, bool ours = false);

/// Reads the table's members into a plain struct; absent fields keep their values. The table must have been checked.
/// `units`: those of the table.
template <class Struct>
void read_members(lua_State* L, int index, Struct& values, const Units& units = {}) {
  for (const Member<Struct>& member : Struct::fields()) {
    lua_getfield(L, index, member.field.name.c_str());
    if (!lua_isnil(L, -1) && !lua_isfunction(L, -1))
      std::visit(
          [&](auto place) {
            using Value = std::remove_reference_t<decltype(values.*place)>;
            if constexpr (std::is_same_v<Value, double>)
              values.*place = lua_tonumber(L, -1) / units.worth(member.field.unit);
            else if constexpr (std::is_same_v<Value, bool>)
              values.*place = lua_toboolean(L, -1);
            else if constexpr (std::is_same_v<Value, std::string>)
              values.*place = lua_tostring(L, -1);
            else
              values.*place = static_cast<Value>(lua_tointeger(L, -1));
          },
          member.place);
    lua_pop(L, 1);
  }
}

/// The same of the table in a field, if there is one.
template <class Struct>
void read_inner_members(lua_State* L, int index, const char* field, Struct& values, const Units& units = {}) {
  if (lua_getfield(L, index, field) == LUA_TTABLE) read_members(L, lua_gettop(L), values, units);
  lua_pop(L, 1);
}

}  // namespace ricochet
