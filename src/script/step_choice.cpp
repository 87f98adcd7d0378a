#include "script/step_choice.hpp"

#include <cmath>

#include "impact/accuracy.hpp"

namespace ricochet {

std::vector<Scene> with_chosen_steps(Session& session, const std::vector<Scene>& scenes) {
  return with_chosen_steps(scenes, session.options.threads, stop_requested,
                           [&](const std::string& line) { session.print(line + "\n"); });
}

std::vector<Scene> with_quietly_chosen_steps(Session& session, const std::vector<Scene>& scenes) {
  return with_chosen_steps(scenes, session.options.threads, stop_requested,
                           [&](const std::string& line) { session.log(line + "\n"); });
}

Scene with_chosen_step(Session& session, const Scene& scene) {
  if (session.options.check || std::isnan(scene.integration.accuracy)) return scene;
  auto& chosen = session.chosen[scene.hash()];
  if (!chosen) chosen = std::make_shared<const Scene>(with_chosen_steps(session, {scene}).front());
  return *chosen;
}

}  // namespace ricochet
