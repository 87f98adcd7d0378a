#pragma once
// How a picture looks that a script asks for: its size, and what it shows.

#include <lua.hpp>
#include <vector>

#include "script/filming.hpp"
#include "script/reader.hpp"

namespace ricochet {

/// `size` and `show`.
std::vector<Field> look_fields();

/// What the table at index 1 says of them.
Shooting shooting_of(lua_State* L);

/// The same where only `size` is asked for.
Shooting sized_shooting_of(lua_State* L, const render::Show& show);

/// Mistakes that show when pictures are drawn stand at this call.
template <class Work>
auto at_call(lua_State* L, Work work) {
  const CallSite call = call_site(L);
  try {
    return work();
  } catch (const FieldError& error) {
    throw_at(session_of(L), call, error);
  }
}

}  // namespace ricochet
