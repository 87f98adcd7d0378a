#pragma once
// From a wanted accuracy to a method and a step, by trial runs of the scene itself.

#include <atomic>
#include <string>
#include <vector>

#include "impact/trials.hpp"

namespace ricochet {

/// How a step was found.
enum class Found {
  tried,         ///< it reaches what was wanted
  extrapolated,  ///< what the trials may cost was used up: it follows from the last of them
  unsettled      ///< no step reaches it in a third of the scenes: the longest that keeps the energy, and their error
};

/// A method and step for a scene, and what the trials said of them.
struct Choice {
  std::string method;
  double step = 0;     ///< [R/c], in the first scene
  double theta = 0;    ///< that step times the bound of the highest frequency
  double longest = 0;  ///< theta of the longest step that trials take; scenes with a shorter one take the same share
  double error = 0;    ///< estimated error of the outcome at that step
  Found found = Found::tried;
  int trials = 0;          ///< impacts run to find it
  double evaluations = 0;  ///< of springs, that they took
  std::vector<LeftOut> left_out;
};

/// Theta of the longest step that trials take in a scene, from that of its usual one.
double longest_theta(const Method& method, double usual);

/// Impacts at the usual step that the trials of a sweep of so many may cost: a quarter of them, or twelve where that is
/// more: with fewer nothing can be told.
double affordable_impacts(std::size_t members);

/// Methods worth trying for a wanted error of e (README, "What accuracy costs"), the last one in any case: which of
/// them is the cheapest depends on the bodies.
std::vector<std::string> methods_for(double accuracy);

/// Chooses method (unless the scenes name one with their accuracy) and theta so that the estimated error of
/// integration.accuracy_of is at most half of integration.accuracy in every scene given, and the energy strays by no
/// more than half of its tolerance; the first scene says what is asked. Scenes that pass by, or in which the
/// outcome is not defined, do not count; those whose outcome does not settle are left out. `members`: how many impacts
/// the choice is for. Throws FieldError("accuracy") if no step reaches it, with the error that was reached.
Choice choose_for_accuracy(std::vector<TrialScene> scenes, std::size_t members, int threads,
                           const std::atomic<bool>& stop);

/// The same for one scene.
Choice choose_step_for_accuracy(const Solids& solids, const Scene& scene, const std::atomic<bool>& stop);

}  // namespace ricochet
