#pragma once
// What a script may call: Lua's libraries, bounded; require and load of text alone; strict globals. The module's own
// Lua runs in it too, among functions of its own.

#include <filesystem>
#include <lua.hpp>
#include <string>

namespace ricochet {

/// Opens what scripts may use of Lua's libraries; all of it with `unsafe`.
void open_sandbox(lua_State* L, bool unsafe);

/// When all that scripts find is there: gives the module's Lua its own copy of it, then makes unknown names and new
/// globals errors.
void close_sandbox(lua_State* L);

/// Leaves a file's text on the stack as a chunk called `name`. `of_library`: among the library's own functions. Throws
/// Error for mistakes of syntax.
void load_file(lua_State* L, const std::filesystem::path& path, const std::string& name, bool of_library);

/// A value as tostring() gives it.
std::string displayed(lua_State* L, int index);

/// What a message repeats of a name: nobody reads more, and a script may make one of any length.
std::string shortened(const std::string& name);

}  // namespace ricochet
