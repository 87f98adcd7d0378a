#pragma once
#include <string>

namespace ricochet {

/// Generated texts: lua/ricochet.d.lua (for the Lua language server) and lua/REFERENCE.md. Tests keep the files
/// current.
std::string editor_stubs();
std::string reference_page();

}  // namespace ricochet
