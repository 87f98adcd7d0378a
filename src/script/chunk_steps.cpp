#include "script/chunk_steps.hpp"

#include <algorithm>
#include <cmath>

#include "script/shard_plan.hpp"

namespace ricochet {

void ChunkSteps::choose(Session& session, const std::vector<std::size_t>& points, std::vector<Scene>& scenes,
                        const Telling& telling) {
  const auto asks = [](const Scene& scene) { return !std::isnan(scene.integration.accuracy); };
  if (std::none_of(scenes.begin(), scenes.end(), asks)) return;
  std::vector<bool> asked;
  for (const Scene& scene : scenes) asked.push_back(asks(scene));
  scenes = with_chosen_steps(session, scenes, telling, &known_);
  steps_.resize(points_);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (asked[i])
      steps_[points[i]] = {scenes[i].integration.method, scenes[i].integration.theta, scenes[i].error_step,
                           scenes[i].error_contact};
}

void ChunkSteps::give(Scene& scene, std::size_t point) const {
  if (steps_.empty() || std::isnan(scene.integration.accuracy)) return;
  const Step& step = steps_[point];
  scene.integration.accuracy = not_given;
  scene.integration.method = step.method;
  scene.integration.theta = step.theta;
  scene.error_step = step.error_step;
  scene.error_contact = step.error_contact;
}

Table ChunkSteps::table() const {
  Table table;
  for (const Step& step : steps_) {
    Scene scene;
    scene.integration.method = step.method;
    scene.integration.theta = step.theta;
    scene.error_step = step.error_step;
    scene.error_contact = step.error_contact;
    add_step(table, scene);
  }
  return table;
}

}  // namespace ricochet
