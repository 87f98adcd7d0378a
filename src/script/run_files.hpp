#pragma once
#include <filesystem>
#include <lua.hpp>
#include <string>

namespace ricochet {

/// A path below the run's own folder. Throws Error if the name, or a link, leads out of it.
std::filesystem::path below_folder(lua_State* L, const std::string& name);

/// A path beside the script or below; --unsafe lets links lead elsewhere. Throws Error otherwise.
std::filesystem::path beside_script(lua_State* L, const std::string& name);

}  // namespace ricochet
