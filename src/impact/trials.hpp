#pragma once
// Trial impacts: scenes by one method at shorter and shorter steps, how far their outcomes are from settled, and what
// the trials may cost.

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "impact/batch.hpp"
#include "impact/outcome.hpp"
#include "impact/scene.hpp"

namespace ricochet {

/// A scene to try steps on, with its solids.
struct TrialScene {
  BuiltSolids solids;
  Scene scene;
};

/// A scene that is tried no more.
struct LeftOut {
  std::size_t scene = 0;  ///< its place among those that are tried
  double error = 0;       ///< what its outcome still changes by at the shortest steps tried; NaN if it does not finish
  std::string reason;     ///< why it does not finish; empty if it does
};

/// The value of a column of an outcome, by its name.
double value_of(const Outcome& outcome, const std::string& column);

/// Error of column x at step h by Richardson's extrapolation, |x(h) - x(h/2)| / (1 - 2^-p), p: the order at which
/// outcomes converge.
double richardson(double at_step, double at_half, int order);

/// Force evaluations a step, in units of one of both bodies: a multirate method evaluates the target's springs less
/// often.
double work_of_step(const Method& method, const Solids& solids);

/// Springs of both bodies.
double springs_of(const Solids& solids);

/// A method, and how the scenes that are tried would be run by it.
struct MethodOption {
  const Method* method = nullptr;
  int order = 0;             ///< at which outcomes converge, beside the scene's effects
  std::vector<double> own;   ///< [scene] the longest theta that it takes
  std::vector<double> rate;  ///< [scene] theta over step: the bound of its highest frequency [c/R]
  double usual = 0;          ///< theta of the default step, in the scene where it is longest
  double longest = 0;        ///< theta, in the scene where it is longest
  double work = 0;           ///< of a step, in the first scene

  double cost() const { return work / longest * rate.front(); }  ///< of a unit of time, at best
};

/// The scenes of a choice: those that are still tried, the hardest first, and those that are not.
struct Standing {
  std::vector<std::size_t> order;
  std::vector<LeftOut> left_out{};
  std::vector<int> doubts{};  ///< [scene] steps at which its outcome did not settle at once

  explicit Standing(std::size_t scenes) : order(scenes), doubts(scenes, 0) {
    std::iota(order.begin(), order.end(), std::size_t{0});
  }
  /// So many do not settle that a step which suits the others says little of all.
  bool unsettled() const {
    const auto changes = [](const LeftOut& scene) { return scene.reason.empty(); };
    return 3 * std::count_if(left_out.begin(), left_out.end(), changes) >= std::ssize(doubts);
  }
};

/// What a choice may spend and has spent, in evaluations of single springs: counts are equal on every machine.
struct Spent {
  double impacts = 0;      ///< so many at the usual step are allowed
  double usual = 0;        ///< what one takes at the usual step in a unit of time
  double evaluations = 0;  ///< so far
  double time = 0;         ///< of the impacts that ran [R/c]
  int runs = 0;

  double mean_time() const { return time / runs; }
  bool affords(double more) const { return runs == 0 || evaluations + more <= impacts * usual * mean_time(); }
};

/// Tries the scenes of a list by one method. A step is told by how much shorter it is than the first: by half octaves,
/// so that the half of one is another one, and no impact runs twice.
class Trials {
 public:
  static constexpr int half = 2;  ///< half octaves

  Trials(const std::vector<TrialScene>& scenes, const MethodOption& option, double theta, Standing& standing,
         Spent& spent)
      : scenes_(scenes), option_(option), theta_(theta), standing_(standing), spent_(spent) {}

  struct Judgement {
    bool paid = true;      ///< false: it would cost more than is allowed
    bool defined = false;  ///< the outcome is, in some scene
    double error = 0;      ///< greatest estimate, of all scenes or of those up to the first that fails
    double drift = 0;      ///< of the energy, over what is allowed in a trial, likewise
    std::string reason;    ///< why an impact did not finish; its error is infinite then

    bool good(double allowed) const { return error <= allowed && drift <= 1; }
  };
  /// The scenes at a step; those that change by more than `allowed` and do not settle are left out.
  Judgement judge(int shorter, double allowed, int threads, const std::atomic<bool>& stop);

  double theta(int shorter) const;

 private:
  struct Trial {
    double value = not_given, drift = 0;
    bool counts = true;     ///< false if the bodies pass by each other, or the outcome is not defined there
    bool hopeless = false;  ///< it ended in a way that no shorter step is likely to change
    std::string reason;
  };
  bool run(const std::vector<std::size_t>& some, const std::vector<int>& at, int threads,
           const std::atomic<bool>& stop);
  Scene scene_at(std::size_t scene, int shorter) const;
  void keep(std::size_t scene, int shorter, const Outcome& outcome);
  double theta_of(std::size_t scene, int shorter) const;
  double cost_of(std::size_t scene, int shorter) const;
  const Trial& at(std::size_t scene, int shorter) const { return known_.at({scene, shorter}); }
  double error(std::size_t scene, int shorter) const;
  double drift(std::size_t scene, int shorter) const;
  void add(std::size_t scene, int shorter, Judgement& all) const;
  bool leave_out_unsettled(std::vector<std::size_t> some, int shorter, double allowed, int threads,
                           const std::atomic<bool>& stop);
  void leave_out(std::size_t scene, int shorter);

  const std::vector<TrialScene>& scenes_;
  const MethodOption& option_;
  double theta_;
  Standing& standing_;
  Spent& spent_;
  std::map<std::pair<std::size_t, int>, Trial> known_;
};

}  // namespace ricochet
