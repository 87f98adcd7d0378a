#pragma once
// The steps of a sweep whose scenes are made chunk by chunk.

#include <string>
#include <vector>

#include "script/step_choice.hpp"
#include "store/table.hpp"

namespace ricochet {

/// The steps that trials choose for points of a sweep, a chunk after the other: what they found for a kind of scenes
/// counts for all later chunks.
class ChunkSteps {
 public:
  explicit ChunkSteps(std::size_t points) : points_(points) {}

  /// Scenes of these points that ask for an accuracy get method and step. Throws SceneError.
  void choose(Session& session, const std::vector<std::size_t>& points, std::vector<Scene>& scenes,
              const Telling& telling);
  /// Gives the scene of a point what was chosen for it.
  void give(Scene& scene, std::size_t point) const;
  /// Of every point, as a plan of shards holds them; empty if none was chosen.
  Table table() const;

 private:
  struct Step {
    std::string method;
    double theta = not_given, error_step = not_given, error_contact = not_given;
  };

  std::size_t points_;
  KnownChoices known_;
  std::vector<Step> steps_;  // [point], if any was chosen
};

}  // namespace ricochet
