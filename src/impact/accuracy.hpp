#pragma once
// From a wanted accuracy to a method and a step, by trial runs of the scene itself.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "impact/batch.hpp"
#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// A method and step for a scene, and what the trials said of them.
struct Choice {
  std::string method;
  double step;     ///< [R/c]
  double theta;    ///< that step times the bound of the highest frequency
  double error;    ///< estimated error of the outcome at that step
  int trials;      ///< impacts run to find it
  double seconds;  ///< they took
};

/// The value of a column of an outcome, by its name.
double value_of(const Outcome& outcome, const std::string& column);

/// Error of column x at step h by Richardson's extrapolation, |x(h) - x(h/2)| / (1 - 2^-p), p: the order at which
/// outcomes converge.
double richardson(double at_step, double at_half, int order);

/// Methods worth trying for a wanted error of e (README, "What accuracy costs"), the last one in any case: which of
/// them is the cheapest depends on the bodies.
std::vector<std::string> methods_for(double accuracy);

/// Force evaluations a step, in units of one of both bodies: a multirate method evaluates the target's springs less
/// often.
double work_of_step(const Method& method, const Solids& solids);

/// A scene to try steps on, with its solids.
struct TrialScene {
  BuiltSolids solids;
  Scene scene;
};

/// Chooses method (unless the scenes name one with their accuracy) and theta so that the estimated error of
/// integration.accuracy_of is at most half of integration.accuracy in every scene given; the first says what is asked.
/// Scenes that pass by, or in which the outcome is not defined, do not count. Throws FieldError("accuracy") if no step
/// reaches it, with the error that was reached.
Choice choose_for_accuracy(std::vector<TrialScene> scenes, int threads, const std::atomic<bool>& stop);

/// The same for one scene.
Choice choose_step_for_accuracy(const Solids& solids, const Scene& scene, const std::atomic<bool>& stop);

/// Scenes with integration.accuracy get the method, theta and error estimate that trials chose; the others stay as they
/// are. Scenes that differ only in seeds, angle, spin, place of landing and the shape of an outline of equal extent and
/// area share the trials of nine of them, spread evenly: the error estimate is the greatest of these nine, so that
/// about one row of ten may exceed it. `told(line)` is called for each such kind of scenes. Throws SceneError for a
/// trial that cannot reach its accuracy.
std::vector<Scene> with_chosen_steps(std::vector<Scene> scenes, int threads, const std::atomic<bool>& stop,
                                     const std::function<void(const std::string&)>& told);

}  // namespace ricochet
