#pragma once
// What the merging of shards asks: the steps of the plan, and whether all are there.

#include <string>
#include <vector>

#include "script/step_choice.hpp"
#include "script/sweep_run.hpp"

namespace ricochet {

/// The scenes of a sweep with the steps of its plan; where there is none (any more), with those that trials choose.
/// Throws FileError if the plan is of something else.
std::vector<Scene> with_planned_steps(Session& session, const std::string& sweep, const std::vector<Scene>& scenes,
                                      const Telling& telling);

/// Throws Error that names the shards whose rows are not all there, what they ended by, and the command for them;
/// with --partial it only warns. `places`: of the scenes in the plan, if they are not in its order.
void refuse_missing(Session& session, const std::string& sweep, const RowStore& store,
                    const std::vector<std::size_t>& places = {});

/// The rows of a sweep, with one of status "not_run" at every scene that has none.
std::vector<Row> with_missing(const RowStore& store, const std::vector<Scene>& scenes);

/// The rows of a sweep that was merged before, for the shards of a later one. Throws FileError if some are missing.
std::vector<Row> merged_rows(Session& session, const std::string& sweep, const std::vector<std::string>& hashes);

/// The command that does a part of this session's work: "ricochet run s.lua samples=4 --shard 3/4 --out out".
std::string command_of(const Session& session, const std::string& command, const std::string& options,
                       const std::string& program = "ricochet");

}  // namespace ricochet
