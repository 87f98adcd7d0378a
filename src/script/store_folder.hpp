#pragma once
// The folder of a sweep's rows: which files hold them, and what is told of it when a run ends early.

#include <filesystem>
#include <string>
#include <vector>

#include "script/session.hpp"

namespace ricochet {

class StoreFolder {
 public:
  /// Claims the sweep's folder, but for a shard, which shares it. Throws FileError for one that holds shards, unless
  /// they are to be merged.
  StoreFolder(Session& session, const std::string& name);

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& parts() const { return parts_; }
  Session& session() const { return session_; }

  /// A new part of the rows, told apart by `key`; and what stands beside them of where they come from.
  std::filesystem::path part(const std::string& key) const;
  Provenance origin() const;
  bool is_shard() const { return session_.options.part == Part::shard; }

  /// The files whose rows are taken up.
  std::vector<std::filesystem::path> stored() const;
  /// Throws FileError if so many of their rows are of other scenes.
  void refuse_strangers(std::size_t count) const;

  /// True if earlier results stay until all new rows are there.
  bool replaces() const;
  /// The results are written: what they were made of is not needed any more; `whole`: nor are shards.
  void results_are_written(bool whole) const;
  /// "12 of 40 impacts are stored in out/s; --resume goes on from there".
  std::string left_behind(std::size_t count, std::size_t all) const;

 private:
  Session& session_;
  std::filesystem::path path_, parts_;
  bool merges_;
};

}  // namespace ricochet
