#pragma once
// Bodies that a script asks for again: the scenes of a sweep share most of theirs, and making one is most of the time
// that making a scene takes.

#include <lua.hpp>

namespace ricochet {

/// wrap_keeping(f): a C function that calls f, a function of the library that makes a body of one table; for a table of
/// equal plain values it gives the body that it made before, which nothing can change.
int wrap_keeping(lua_State* L);

}  // namespace ricochet
