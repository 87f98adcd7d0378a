#pragma once
// A sweep's rows as they come in, in part files that survive a kill, and the results of them all.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "script/session.hpp"
#include "script/store_folder.hpp"
#include "script/sweep_parameters.hpp"
#include "script/sweep_run.hpp"
#include "store/table.hpp"

namespace ricochet {

/// What of a sweep's earlier rows a store takes up.
struct Earlier {
  bool taken;      ///< else it begins anew
  bool strangers;  ///< rows of other scenes may be among them: later rounds will ask for those
};

/// Rows of a sweep as they come in, and their files.
class Store : public RowStore {
 public:
  /// Takes what is stored if it is to be taken up. Throws FileError for what is damaged, or not of these scenes, or of
  /// another version.
  Store(Session& session, const std::string& name, const std::vector<std::string>& hashes, const Parameters& parameters,
        const Earlier& earlier);

  const std::filesystem::path& folder() const { return folder_.path(); }
  /// Rows of other scenes that were there and allowed.
  std::size_t strangers() const { return strangers_; }

  /// Keeps a finished batch as a part file: from then on it survives a kill.
  void add(const std::vector<std::pair<std::size_t, Row>>& batch) override;

  /// The results, in every format, of every row there is, in the sweep's order; then the parts are not needed any more.
  /// Returns their digest of outcomes.
  std::string assemble();
  /// The same of a sweep that stops early, unless it would replace earlier results with less: then the parts stay
  /// beside them.
  void stop_early();
  /// "12 of 40 impacts are stored in out/s; --resume goes on from there".
  std::string left_behind() const { return folder_.left_behind(count(), rows().size()); }

 private:
  StoreFolder folder_;
  const Parameters& parameters_;
  std::size_t strangers_ = 0;
};

}  // namespace ricochet
