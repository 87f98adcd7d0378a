#pragma once
// The plan of a sweep in shards: what every shard must agree in, whatever machine it runs on. The first to come writes
// it; whoever finds another script, version or outcome refuses.

#include <filesystem>
#include <string>
#include <vector>

#include "impact/scene.hpp"
#include "script/session.hpp"
#include "store/table.hpp"

namespace ricochet {

struct ShardPlan {
  std::size_t shards = 0, points = 0;
  std::vector<std::string> lattices;  ///< the names in `over` that change the lattice
  Provenance facts;                   ///< of the script, the program and the first point: what must be equal
  Table steps;                        ///< of every point, if trials chose them; else empty

  /// The scene of a point with the step that the plan has for it.
  Scene with_step(Scene scene, std::size_t point) const;
};

/// What a session, its sweep's `over` (as text) and the first point's scene as asked tell; the scene's step: as chosen.
/// Runs the first 300 steps of the first point.
Provenance plan_facts(const Session& session, const std::string& over, const Scene& asked, const Scene& chosen);

/// Steps of all points of a sweep, as trials chose them.
Table steps_table(const std::vector<Scene>& scenes);

/// Writes the plan unless there is one; of several processes one succeeds. Throws FileError.
void write_plan(const std::filesystem::path& folder, const ShardPlan& plan, const Provenance& provenance);

/// The plan in a sweep's folder; throws FileError if there is none or it cannot be read.
ShardPlan read_plan(const std::filesystem::path& folder);

/// Throws FileError that says what differs: the script, its arguments, the program, or what it computes. Facts that are
/// not among `own` are not compared.
void refuse_other(const ShardPlan& plan, const Provenance& own, const std::filesystem::path& folder);

/// Facts of a session alone.
Provenance session_facts(const Session& session);

}  // namespace ricochet
