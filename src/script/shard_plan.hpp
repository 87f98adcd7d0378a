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

/// A name in `over`, with as many values.
struct SweptName {
  std::string name;
  std::size_t values;
  bool changes_lattice;
};

/// Points are counted from 0, the last name of `over` fastest. Lattices are dealt out to the shards as cards are, each
/// round from another one on, and where there are fewer than shards, their pieces: points of one lattice cost less
/// together than apart.
struct ShardPlan {
  std::size_t shards = 0;
  std::vector<SweptName> over;
  Provenance facts;  ///< of the script, the program and the first point: what must be equal
  Table steps;       ///< of every point, if trials chose them; else empty

  std::size_t points() const;
  std::size_t impacts() const;  ///< of all shards: the points, unless a fact says of how many of them
  std::size_t shard_of(std::size_t point) const;
  /// In their order.
  std::vector<std::size_t> points_of(std::size_t shard) const;
  /// The scene of a point with the step that the plan has for it.
  Scene with_step(Scene scene, std::size_t point) const;
  /// The same for a shard. Throws FieldError for a scene that asks for an accuracy where the first did not.
  Scene with_planned_step(Scene scene, std::size_t point) const;
};

/// Of a session: its script, arguments and program.
Provenance facts_of(const Session& session);

/// True if results with this provenance are of the script and arguments of these facts, in whatever order.
bool is_of_results(const Provenance& facts, const Provenance& results);

/// The hash of what a scene's impact comes to in its first steps. Throws FieldError if it cannot start.
std::string canary_of(const Scene& scene);

/// Steps of all points of a sweep, as trials chose them, one after the other.
void add_step(Table& table, const Scene& scene);

/// Writes the plan unless there is one; of several processes one does, and gets true. Throws FileError.
bool write_plan(const std::filesystem::path& folder, const ShardPlan& plan, const Provenance& provenance);

/// The plan in a sweep's folder; throws FileError if there is none or it cannot be read.
ShardPlan read_plan(const std::filesystem::path& folder);

/// Throws FileError that says what differs in one of these facts: the script, its arguments, the program, or what it
/// computes.
void refuse_other(const ShardPlan& plan, const Provenance& own, const std::filesystem::path& folder);

}  // namespace ricochet
