#pragma once
#include <vector>

#include "script/functions.hpp"

namespace ricochet {

/// What ricochet.sweep, the methods of its rows and ricochet.range take and return. Their code is in
/// lua/ricochet/sweep.lua, rows.lua and init.lua.
std::vector<Function> sweep_descriptions();

}  // namespace ricochet
