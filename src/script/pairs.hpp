#pragma once
#include "sandbox/sandbox.hpp"

namespace ricochet {

/// pairs() in the same order in every run.
void order_pairs(lua_State* L);

}  // namespace ricochet
