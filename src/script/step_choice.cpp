#include "script/step_choice.hpp"

#include <fmt/format.h>

#include <cmath>

#include "store/files.hpp"

namespace ricochet {

namespace fs = std::filesystem;

Telling printed(Session& session, SceneName name) {
  return {[&session](const std::string& line) { session.inform(line + "\n"); }, std::move(name)};
}

Telling logged(Session& session, SceneName name) {
  return {[&session](const std::string& line) { session.log(line + "\n"); }, std::move(name)};
}

std::vector<Scene> with_chosen_steps(Session& session, const std::vector<Scene>& scenes, const Telling& telling,
                                     KnownChoices* known) {
  TriedChoices& tried = session.steps.read(session.steps_file());
  if (!session.steps.warning.empty()) session.warn(session.steps.warning);
  try {
    return with_chosen_steps(scenes, session.options.threads, stop_requested, telling, known, &tried);
  } catch (const Error& error) {
    if (error.exit != Exit::interrupted) throw;
    const fs::path file = session.steps_file();
    std::string kept;
    try {
      if (session.steps.has_new()) {
        make_folder(file.parent_path());
        session.steps.write(file);
        kept = fmt::format(" (what they chose so far is remembered in {})", file.string());
      }
    } catch (const FileError&) {  // then they are made again
    }
    throw Error("interrupted while trials chose steps" + kept, Exit::interrupted);
  }
}

Error with_stored(const Error& interrupted, const std::string& stored) {
  return Error(fmt::format("{}: {}", interrupted.what(), stored), interrupted.exit);
}

std::vector<Scene> with_steps_of_rounds(Session& session, const std::string& sweep, const std::vector<Scene>& scenes,
                                        const Telling& telling) {
  std::vector<Scene> chosen = scenes, fresh;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto found = session.chosen.find(sweep + scenes[i].hash());
    if (found != session.chosen.end()) {
      chosen[i] = *found->second;
    } else if (!std::isnan(scenes[i].integration.accuracy)) {
      fresh.push_back(scenes[i]);
      places.push_back(i);
    }
  }
  const Telling of_all{telling.line, [&](std::size_t k) { return telling.name(places[k]); }};
  fresh = with_chosen_steps(session, fresh, of_all, &session.rounds[sweep]);
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    chosen[places[k]] = fresh[k];
    session.chosen[sweep + scenes[places[k]].hash()] = std::make_shared<const Scene>(fresh[k]);
  }
  return chosen;
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
