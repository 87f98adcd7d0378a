#pragma once
// The types that a field of a table may have: what is accepted, and what editors call them.

#include <lua.hpp>
#include <string>

#include "core/field.hpp"

namespace ricochet {

/// The mistake in the value at `index` of the stack, as a sentence about the field; empty if there is none.
std::string mistake_in(lua_State* L, int index, const Field& field);

/// What the Lua language server calls a type.
std::string annotation_of(const std::string& type);

/// "between 0 and 1 R", "at least 2", ...
std::string accepted_range(const Field& field);

}  // namespace ricochet
