#include "script/step_choice.hpp"

#include <fmt/format.h>

#include <cmath>

namespace ricochet {

Telling printed(Session& session, SceneName name) {
  return {[&session](const std::string& line) { session.inform(line + "\n"); }, std::move(name)};
}

Telling logged(Session& session, SceneName name) {
  return {[&session](const std::string& line) { session.log(line + "\n"); }, std::move(name)};
}

std::vector<Scene> with_chosen_steps(Session& session, const std::vector<Scene>& scenes, const Telling& telling) {
  return with_chosen_steps(scenes, session.options.threads, stop_requested, telling);
}

Scene with_chosen_step(Session& session, const Scene& scene) {
  if (session.options.check || std::isnan(scene.integration.accuracy)) return scene;
  auto& chosen = session.chosen[scene.hash()];
  const auto name = [](std::size_t) { return std::string("the scene"); };
  if (!chosen)
    chosen = std::make_shared<const Scene>(with_chosen_steps(session, {scene}, printed(session, name)).front());
  return *chosen;
}

}  // namespace ricochet
