#pragma once
// Tables of a script: checked against their fields, all mistakes reported together at the fields' own lines.

#include <lua.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "sandbox/sandbox.hpp"
#include "script/session.hpp"
#include "script/source.hpp"
#include "script/specification.hpp"

namespace ricochet {

/// Where in the user's files a call stands.
struct CallSite {
  std::string file, function;
  int line = 0;
};

Session& session_of(lua_State* L);

/// The innermost call made by the user's own code (not by the library).
CallSite call_site(lua_State* L);

struct Mistake {
  std::vector<std::string> path;  ///< of the field, outermost first; empty: the call itself
  std::string message;
};

/// "file:line: function: message" with an excerpt of the source, for each mistake; `valid` is listed at the end if not
/// empty.
std::string report(const Session& session, const CallSite& site, const std::vector<Mistake>& mistakes,
                   const std::string& valid = "");

/// "between 0 and 1 R", "at least 2", ...
std::string accepted_range(const Field& field);

/// True if the value is the module itself: a function was called with a colon instead of a dot.
bool is_module(lua_State* L, int index);

/// Puts a copy in the place of the value at `index` that the script cannot reach: tables, and those in them, without
/// metatables.
void make_plain(lua_State* L, int index);

/// Puts a plain copy (as make_plain) in the place of the table at `index`, so that what is checked is what is used,
/// whatever its metatables do and the script does with it later; fields that a metatable supplies are part of the copy.
/// Rows and sweeps stay what they are. The library's own tables (`ours`), which no script can reach, are not copied.
/// Checks it against the fields of a function; throws Error with every mistake.
void check_table(lua_State* L, int index, const Function& function, bool ours = false);

/// Reads the table's members into a plain struct; absent fields keep their values. The table must have been checked.
template <class Struct>
void read_members(lua_State* L, int index, Struct& values) {
  for (const Member<Struct>& member : Struct::fields()) {
    lua_getfield(L, index, member.field.name.c_str());
    if (!lua_isnil(L, -1) && !lua_isfunction(L, -1))
      std::visit(
          [&](auto place) {
            using Value = std::remove_reference_t<decltype(values.*place)>;
            if constexpr (std::is_same_v<Value, double>)
              values.*place = lua_tonumber(L, -1);
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

/// Makes names that the table on top of the stack has not errors; `what` names the table.
void push_strict(lua_State* L, const std::string& what);

/// Elements of a list, as it holds them: a metatable might tell of any number, and of others at each reading.
inline lua_Integer length_of(lua_State* L, int index) { return static_cast<lua_Integer>(lua_rawlen(L, index)); }

/// A value as a message shows it: "a string ('abc')", "nil", "-1".
std::string shown(lua_State* L, int index);

/// An error at the line of the user's that runs: "file:line: message" with that line.
Error at_line(lua_State* L, const std::string& message);

/// The error of a name that `what` has not: "file:line: what has no 'name' (did you mean ...?)" or the names there are.
Error unknown_name(lua_State* L, const std::string& what, const std::string& name, std::vector<std::string> names);

/// Throws the error of a field as a report at the site, looking for the field in the table, or in its launch or contact
/// table.
[[noreturn]] void throw_at(const Session& session, const CallSite& site, const FieldError& error);

}  // namespace ricochet
