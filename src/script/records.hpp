#pragma once
#include <filesystem>
#include <lua.hpp>
#include <vector>

#include "script/filmed.hpp"

namespace ricochet {

/// Writes the frames of a scene that was followed, in every format of trajectories; `path` is that of the first.
void store_recording(lua_State* L, const std::vector<FilmedScene>& scenes, const std::filesystem::path& path,
                     const FrameTimes& wanted);

}  // namespace ricochet
