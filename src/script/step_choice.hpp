#pragma once
#include <vector>

#include "impact/scene.hpp"
#include "script/session.hpp"

namespace ricochet {

/// Scenes that ask for an accuracy with the method and step chosen for it, by trial runs; prints what was chosen.
/// Others as they are.
std::vector<Scene> with_chosen_steps(Session& session, const std::vector<Scene>& scenes);
/// The same, told to run.log only.
std::vector<Scene> with_quietly_chosen_steps(Session& session, const std::vector<Scene>& scenes);
/// The same for one scene; the choice is kept for the rest of the run. With --check nothing is tried.
Scene with_chosen_step(Session& session, const Scene& scene);

}  // namespace ricochet
