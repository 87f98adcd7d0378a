#pragma once
// A sweep of more points than are kept in memory together: its scenes are made, run and dropped chunk by chunk, and
// what stays of each is the hash of its scene. lua/ricochet/long_sweep.lua makes the scenes, whole lattices together.

#include <optional>
#include <string>
#include <vector>

#include "core/hash_pieces.hpp"
#include "script/chunk_steps.hpp"
#include "script/long_store.hpp"
#include "script/shard_plan.hpp"
#include "script/sweep_report.hpp"
#include "script/sweep_run.hpp"
#include "script/swept_axis.hpp"

namespace ricochet {

class LongSweep {
 public:
  /// Claims the sweep's folder, but for a shard. `own`: how many of the points this process runs. Throws FileError.
  LongSweep(Session& session, std::string name, std::vector<SweptAxis> axes, std::size_t points, std::size_t own);

  const std::string& name() const { return name_; }
  std::size_t points() const { return hashes_.size(); }

  /// True if trials choose the steps here: then they may be chosen in other chunks than the scenes are run in, before.
  bool chooses() const { return store_ && !plan_; }
  void choose(const std::vector<std::size_t>& points, std::vector<Scene> scenes);
  /// True if rows are there already: then every chunk is looked at before any is run, so that nothing is lost.
  bool looks_first() const { return looks_first_; }
  void look(const std::vector<std::size_t>& points, std::vector<Scene> scenes);
  /// All chunks were looked at. Throws FileError for rows of other scenes.
  void end_look();
  /// True if some of the points have no row yet.
  bool lacks(const std::vector<std::size_t>& points);
  /// Runs what of a chunk has no row. Throws SceneError, FileError, or Error if it was interrupted.
  void run(const std::vector<std::size_t>& points, std::vector<Scene> scenes);
  /// After the last chunk: writes the results and tells of them.
  void end();
  /// The same of a shard.
  void end_shard();

  /// "psi1 = 2, sample = 7"
  std::string place(std::size_t point) const { return place_of(axes_, point); }
  /// What is stored, for the end of an error; nothing with --check.
  std::string stored() const;

  /// The file of the results, and the row of a point in it; none if it has none (merged with --partial, or checked).
  std::filesystem::path results() const;
  std::optional<std::size_t> row_of_point(std::size_t point) const;
  /// What stands for a row that is not there.
  Row missing(std::size_t point) const;
  /// The point with a scene of this hash.
  std::optional<std::size_t> point_of(const std::string& hash) const;
  /// Gives the scene of a point the step that it ran with.
  void give_step(Scene& scene, std::size_t point) const;
  /// False with --check.
  bool has_results() const { return store_.has_value(); }

 private:
  void take(const std::vector<std::size_t>& points, std::vector<Scene>& scenes);
  void take_steps(const std::vector<std::size_t>& points, std::vector<Scene>& scenes);
  void choose_steps(const std::vector<std::size_t>& points, std::vector<Scene>& scenes);
  bool run_rest(const std::vector<std::size_t>& points, const std::vector<Scene>& scenes);
  std::size_t count_stored(const std::vector<std::size_t>& points);
  void warn_of_twins(std::size_t repeated, std::size_t of);
  void add_use(const SweepUse& use);
  void tell(const LongStore::Written& written, const LongStore::Columns& columns,
            const std::vector<std::size_t>& points);
  std::size_t known() const;
  std::string left_behind() const;

  Session& session_;
  std::string name_;
  std::vector<SweptAxis> axes_;
  std::size_t own_;                   // points of this process
  std::vector<HashKey> hashes_;       // [point]
  std::vector<std::uint8_t> method_;  // [point], in methods()
  std::vector<bool> chosen_;          // [point]: trials chose its step
  std::vector<bool> counted_;         // [point]: the progress knows of its row
  ChunkSteps steps_;
  std::optional<ShardPlan> plan_;   // whose steps a shard or a merged sweep has
  std::optional<LongStore> store_;  // none with --check
  bool chose_ = false, looks_first_ = false, looked_ = false, warned_ = false;
  SweepTold told_;
  std::optional<Progress> progress_;
  std::optional<Scene> first_;
  std::size_t ran_ = 0;
  SweepUse use_;
  std::vector<std::uint32_t> rows_;  // [point] its row in the results, if some have none
};

}  // namespace ricochet
