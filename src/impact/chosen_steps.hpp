#pragma once
// Steps for all scenes of a list that ask for an accuracy, and runs of such scenes.

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "impact/accuracy.hpp"
#include "impact/scene.hpp"
#include "impact/sweep.hpp"

namespace ricochet {

/// What a choice of steps tells, and how it names a scene of the list ("psi1 = 2, sample = 7").
struct Telling {
  std::function<void(const std::string& line)> line;
  std::function<std::string(std::size_t scene)> name;
};

/// What trials chose for a kind of scenes.
struct KindsChoice {
  std::string method;
  double theta, longest, error_step, error_contact;
};

/// By what scenes that share their trials have in common.
using KnownChoices = std::map<std::string, KindsChoice>;

/// What trials found, and the error of the contact beside it.
struct TriedChoice {
  Choice choice;
  double error_contact;
};

/// What trials found before, by the hash of all that decides about it: the scenes that were tried and how much the
/// trials may cost. So a choice that is remembered is the one that trials would make again.
using TriedChoices = std::map<std::string, TriedChoice>;

/// Scenes with integration.accuracy get the method, theta and error estimate that trials chose; the others stay as they
/// are. Scenes that differ only in seeds, angle, spin, place of landing and the shape of an outline of equal extent and
/// area share the trials of nine of them, spread over all in which they differ: the error estimate is the greatest of
/// these nine, so that about one row of ten may exceed it. One of the nine that does not settle has its own. Then every
/// one of them is found to start with its step. Throws SceneError for a trial that cannot reach its accuracy, and for
/// a scene that cannot start.
/// Kinds that are `known` are not tried again, and those that are tried are known afterwards; what was `tried` before
/// is not tried again either.
std::vector<Scene> with_chosen_steps(std::vector<Scene> scenes, int threads, const std::atomic<bool>& stop,
                                     const Telling& telling, KnownChoices* known = nullptr,
                                     TriedChoices* tried = nullptr);

/// run_sweep() of such scenes: those that fail by a step that trials chose (energy_drift, unstable, not_finite) are run
/// again with half of it, three times at most, and only the last outcome is handed over.
bool run_chosen(const std::vector<Scene>& scenes, const std::vector<bool>& todo, const SweepOptions& options,
                const std::atomic<bool>& stop, const std::function<void(const std::vector<Result>&)>& some_done,
                const Telling& telling, SweepUse* use = nullptr);

}  // namespace ricochet
