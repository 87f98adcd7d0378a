#pragma once
#include <string>

namespace ricochet {

/// Generated texts: lua/ricochet.d.lua (for the Lua language server) and lua/REFERENCE.md. Tests keep the files
/// current.
std::string editor_stubs();
std::string reference_page();

/// What the reference says of a function, for a terminal; without a name, the names of all. Throws Error for a name
/// that there is not.
std::string help_on(const std::string& name);

}  // namespace ricochet
