#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "impact/chosen_steps.hpp"
#include "impact/scene.hpp"
#include "script/session.hpp"

namespace ricochet {

/// Names a scene of a list.
using SceneName = std::function<std::string(std::size_t)>;

/// What is told of chosen steps is printed.
Telling printed(Session& session, SceneName name);
/// The same, into run.log only.
Telling logged(Session& session, SceneName name);

/// Scenes that ask for an accuracy with the method and step chosen for it, by trial runs. Others as they are. Throws
/// Error if that was interrupted; what trials chose until then is remembered.
std::vector<Scene> with_chosen_steps(Session& session, const std::vector<Scene>& scenes, const Telling& telling,
                                     KnownChoices* known = nullptr);
/// The same of a sweep's scenes so far, in rounds: those of an earlier one keep what it chose, and new ones of a kind
/// that was tried take that.
std::vector<Scene> with_steps_of_rounds(Session& session, const std::string& sweep, const std::vector<Scene>& scenes,
                                        const Telling& telling);
/// The same for one scene; the choice is kept for the rest of the run. With --check nothing is tried.
Scene with_chosen_step(Session& session, const Scene& scene);

/// Such an error, and what is stored.
Error with_stored(const Error& interrupted, const std::string& stored);

}  // namespace ricochet
