#include "script/store_folder.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "script/shard_store.hpp"
#include "store/run_names.hpp"

namespace ricochet {

namespace fs = std::filesystem;

StoreFolder::StoreFolder(Session& session, const std::string& name)
    : session_(session),
      path_(session.folders.named(name)),
      parts_(run_names::parts(path_)),
      merges_(session.options.part == Part::merge) {
  if (is_shard()) {
    parts_ = run_names::shards(path_);
    return;
  }
  std::error_code error;
  if (!merges_ && !session.options.force && fs::exists(run_names::plan(path_), error))
    throw FileError(fmt::format(
        "{} holds shards of this sweep; ricochet merge makes results of them, --force drops them", path_.string()));
  session.folders.claim(path_);
  if (session.options.force || (session.options.resume && fs::exists(run_names::new_parts(path_), error)))
    parts_ = run_names::new_parts(path_);
}

fs::path StoreFolder::part(const std::string& key) const {
  return is_shard() ? run_names::shard_part(path_, session_.options.shard) : run_names::part(parts_, key);
}

Provenance StoreFolder::origin() const { return is_shard() ? origin_of_shard() : Session::made_by(); }

std::vector<fs::path> StoreFolder::stored() const {
  if (is_shard()) return run_names::stored_for_shard(path_, session_.options.shard);
  return merges_ ? run_names::all_stored(path_) : run_names::stored(path_);
}

void StoreFolder::refuse_strangers(std::size_t count) const {
  if (count > 0 && merges_)
    throw FileError(fmt::format(
        "{} holds {} rows of other scenes than this sweep's, merged before, which this merge would lose; use the same "
        "parameters, or run and merge these in another --out",
        path_.string(), count));
  if (count > 0)
    throw FileError(fmt::format(
        "{} holds {} rows of other scenes than this sweep's, which --resume would lose; use the same parameters (and "
        "the same scenes where accuracy chooses the step: trials of them chose it), --force, or another --out",
        path_.string(), count));
}

bool StoreFolder::replaces() const {
  std::error_code error;
  return parts_ == run_names::new_parts(path_) &&
         (fs::exists(run_names::readable_results(path_), error) || fs::exists(run_names::plan(path_), error));
}

void StoreFolder::results_are_written(bool whole) const {
  for (const fs::path& parts : {run_names::parts(path_), run_names::new_parts(path_)}) run_names::remove_parts(parts);
  if (whole) run_names::remove_shards(path_);
  session_.folders.results_are_whole(path_);
}

std::string StoreFolder::left_behind(std::size_t count, std::size_t all) const {
  if (is_shard()) return shard_left_behind(session_, count, all);
  return fmt::format("{} of {} impacts are stored in {}; {}--resume goes on from there{}", count, all, path_.string(),
                     session_.options.fresh ? "--new " : "",
                     replaces() ? ", and the earlier results stay until all are there" : "");
}

}  // namespace ricochet
