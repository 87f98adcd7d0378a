#pragma once
// What planning and running shards share, of sweeps with all their scenes at once, chunk by chunk, or by rounds.

#include <lua.hpp>
#include <string>
#include <vector>

#include "core/hash_pieces.hpp"
#include "impact/scene.hpp"
#include "script/session.hpp"
#include "script/shard_plan.hpp"
#include "script/sweep_parameters.hpp"

namespace ricochet {

/// Impacts of a shard, where nobody says how many shards.
inline constexpr std::size_t usual_impacts = 1000;

/// Ends the script; what follows in it runs when shards are merged.
[[noreturn]] void end_script(Session& session);

/// Throws FileError where the plan is of another number of shards than this process was told.
void refuse_other_number(const Session& session, const ShardPlan& plan);

/// How many rows of other scenes lie there.
std::size_t strangers_in(const std::filesystem::path& folder, const std::vector<HashKey>& scenes);
/// Throws FileError where some do: they would stand in the way of the merging, once all shards have run.
void refuse_strangers(const std::filesystem::path& folder, const std::vector<HashKey>& scenes);

/// The canary of the scene at an index of the stack, with its step; a scene that cannot start is an error at its place.
std::string canary_of_first(lua_State* L, int index, const Scene& chosen);

/// What a plan holds of a sweep. `over`: its values as a text; `first`: the scene of its first point.
Provenance facts_of_sweep(lua_State* L, const std::string& over, const Scene& first);

/// Runs a shard's scenes, which have the plan's steps, leaves its file and tells of it. Throws SceneError, FileError,
/// or Error if it was interrupted.
void run_shard_scenes(Session& session, const std::string& name, const std::vector<Scene>& scenes,
                      const Parameters& parameters);

/// "sweep, shard 3/20"
std::string shard_name(const Session& session, const std::string& sweep);

/// "shard 3/20 of 'sweep' is done ..."
void tell_shard_end(Session& session, const std::string& name, std::size_t finished, std::size_t all);

}  // namespace ricochet
