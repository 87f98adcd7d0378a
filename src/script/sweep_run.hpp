#pragma once
// The impacts of a sweep, run into whatever keeps their rows.

#include <string>
#include <utility>
#include <vector>

#include "impact/sweep.hpp"
#include "script/known_rows.hpp"
#include "script/step_choice.hpp"

namespace ricochet {

/// Keeps the rows of a sweep as they come in.
class RowStore {
 public:
  explicit RowStore(const std::vector<std::string>& hashes) : known_(hashes) {}
  virtual ~RowStore() = default;

  const std::vector<bool>& done() const { return known_.done(); }
  const std::vector<Row>& rows() const { return known_.rows(); }
  std::size_t count() const { return known_.count(); }

  /// Keeps a finished batch, of scenes by their places.
  virtual void add(const std::vector<std::pair<std::size_t, Row>>& batch) = 0;

 protected:
  KnownRows known_;
};

/// Scenes to run, and what they are called.
struct SweepWork {
  const std::string& name;
  const std::vector<Scene>& scenes;
  const std::vector<std::string>& hashes;
  SceneName scene_name;
};

SweepOptions options_of(const Session& session);

std::vector<std::string> hashes_of(const std::vector<Scene>& scenes);

/// Refuses a step that some lattice does not take, before anything is written. Throws SceneError.
void check_steps(const Session& session, const std::vector<Scene>& scenes);

/// Runs the scenes that the store does not know. `use`: what it made of the machine. Returns false if it was
/// interrupted.
bool run_rows(Session& session, RowStore& store, const SweepWork& work, SweepUse& use);

}  // namespace ricochet
