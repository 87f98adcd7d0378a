#include "impact/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"
#include "impact/batch.hpp"
#include "impact/launch.hpp"
#include "impact/parallel.hpp"

namespace ricochet {

double value_of(const Outcome& outcome, const std::string& column) {
  for (const auto& [field, value] : Outcome::fields())
    if (field.name == column) return value(outcome);
  throw std::logic_error("no outcome is called " + column);
}

double richardson(double at_step, double at_half, int order) { return std::abs(at_step - at_half) / (1 - std::pow(2.0, -order)); }

std::vector<std::string> methods_for(double accuracy) {
  if (accuracy >= 2e-4) return {"multirate_8", "multirate_4", "multirate_2", "verlet"};
  if (accuracy >= 1e-5) return {"verlet", "takahashi_imada"};
  if (accuracy >= 1e-8) return {"takahashi_imada", "chin_4a"};
  return {"blanes_moan_srkn6b"};
}

double work_of_step(const Method& method, const Lattice& projectile, const Lattice& target) {
  if (!method.multirate()) return method.evaluations();
  const double fast = static_cast<double>(projectile.spring.size()), slow = static_cast<double>(target.spring.size());
  return (method.evaluations() * fast + slow) / (fast + slow);
}

namespace {

constexpr int most_attempts = 12;
// Steps shorter than the default by more than this are not tried: another method is what is wanted then.
constexpr double most_shortened = 20;
// The estimate is aimed at this share of what was asked for: the true error may be twice the estimate.
constexpr double aim = 0.5;

class Trials {
 public:
  Trials(const Lattice& projectile, const Lattice& target, const Scene& scene, const std::string& method, const std::atomic<bool>& stop)
      : projectile_(projectile), target_(target), scene_(scene), stop_(stop) {
    scene_.integration.method = method, scene_.integration.accuracy = not_given;
  }

  // NaN if the impact does not finish.
  double at(double step) {
    scene_.integration.step = step;
    ++count;
    const Outcome outcome = run_scene(projectile_, target_, scene_, stop_);
    if (stop_) throw Error("interrupted", Exit::interrupted);
    reason = outcome.reason;
    return outcome.status == Status::finished ? value_of(outcome, scene_.integration.accuracy_of) : not_given;
  }

  int count = 0;
  std::string reason;

 private:
  const Lattice &projectile_, &target_;
  Scene scene_;
  const std::atomic<bool>& stop_;
};

}  // namespace

namespace {

struct Candidate {
  const Method* method;
  Start start;
  double longest;  ///< step [R/c]
  double work;     ///< of a step
};

Candidate candidate(const Lattice& projectile, const Lattice& target, Scene scene, const std::string& name) {
  const Method& method = method_named(name);
  scene.integration.method = name, scene.integration.accuracy = not_given, scene.integration.step = not_given;
  const Start start = launch(scene, projectile, target);
  // The default step resolves the contact's onset; the stability limit has room for springs that stiffen.
  return {&method, start, start.step * std::min(2.0, 0.8 * method.stability_limit / start.theta), work_of_step(method, projectile, target)};
}

struct Reached {
  double step = 0, error = std::numeric_limits<double>::infinity();  ///< step 0: the accuracy was not reached; the least error was this
  std::string reason;
};

// Shortens the step of a method until the estimated error is small enough, but not below `shortest`.
Reached shorten_step(Trials& trials, const Candidate& c, const Integration& asked, double shortest) {
  const double wanted = asked.accuracy;
  const int order = c.method->outcome_order;
  double step = std::clamp(c.start.step * std::pow(wanted / c.method->usual_accuracy, 1.0 / order), c.start.step / 4, c.longest);
  double best = std::numeric_limits<double>::infinity(), previous = not_given;
  for (int attempt = 0; attempt < most_attempts && step >= shortest; ++attempt) {
    const double error = richardson(trials.at(step), trials.at(step / 2), order);
    if (error <= aim * wanted) return {step, error, ""};
    // Two attempts in a row that gain less than a step of half as long should by far: rounding, or paths that part at a near tie.
    if (!(error < best / 2) && !(previous < 2 * best) && attempt > 3) break;
    previous = best, best = std::min(best, std::isnan(error) ? best : error);
    const double ratio = std::isnan(error) ? 0.5 : std::pow(0.7 * aim * wanted / error, 1.0 / order);
    step *= std::clamp(ratio, 0.2, 0.8);
  }
  return {0, best, trials.reason};
}

}  // namespace

Choice choose_step_for_accuracy(const Lattice& projectile, const Lattice& target, const Scene& scene, const std::atomic<bool>& stop) {
  const auto began = std::chrono::steady_clock::now();
  const Integration& asked = scene.integration;
  std::vector<std::string> names = asked.method == "auto" ? methods_for(asked.accuracy) : std::vector<std::string>{asked.method};
  if (asked.method == "auto") {
    std::erase_if(names, [&](const std::string& name) { return !scene.conflict_with(method_named(name)).empty(); });
    if (names.empty()) names = {"verlet"};  // beside any effect
  }
  const Candidate last = candidate(projectile, target, scene, names.back());
  if (!last.start.touches) return {last.method->name, last.start.step, last.start.theta, 0, 0, 0};
  // From the cheapest at its longest step on, each as long as it stays cheaper than the next.
  std::vector<Candidate> candidates;
  for (const std::string& name : names)
    if (const Candidate c = candidate(projectile, target, scene, name); c.work / c.longest < last.work / last.longest) candidates.push_back(c);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.work / a.longest < b.work / b.longest; });
  candidates.push_back(last);
  int trial_count = 0;
  Reached reached;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    const double shortest = i + 1 < candidates.size() ? c.work * candidates[i + 1].longest / candidates[i + 1].work : c.start.step / most_shortened;
    Trials trials(projectile, target, scene, c.method->name, stop);
    reached = shorten_step(trials, c, asked, shortest);
    trial_count += trials.count;
    if (reached.step == 0) continue;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return {c.method->name, reached.step, reached.step * c.start.theta / c.start.step, reached.error, trial_count, seconds};
  }
  throw FieldError("accuracy", std::isinf(reached.error) ? fmt::format("no trial run finished ({})", reached.reason)
                                                         : fmt::format("{:g} is below what {} can reach for {} here: the estimated error stays at {:.2g}; ask for that, or another method",
                                                                       asked.accuracy, names.back(), asked.accuracy_of, reached.error));
}

namespace {

// What scenes that share their trials have in common.
std::string kind_of(const Scene& scene) {
  Scene plain = scene;
  plain.launch = Launch{};
  std::string kind = fmt::format("{:.9g}", scene.launch.velocity().norm());
  for (const auto* body : {&scene.projectile, &scene.target}) {
    const BodyNumbers& n = (*body)->numbers;
    kind += fmt::format(" {} {} {} {} {} {};", n.nodes, n.placement, n.stiffness, n.quartic, n.mass, n.roughness);
  }
  const Integration& i = scene.integration;
  return kind + fmt::format("{} {} {} {} {} {} {}", i.method, i.accuracy, i.accuracy_of, scene.contact.V0, scene.contact.xi, scene.contact.reach, scene.contact.sides) + text_of(scene.effects);
}

}  // namespace

std::vector<Scene> with_chosen_steps(std::vector<Scene> scenes, int threads, const std::atomic<bool>& stop, const std::function<void(const std::string&)>& told) {
  std::map<std::string, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (!std::isnan(scenes[i].integration.accuracy)) {
      kinds[kind_of(scenes[i])].push_back(i);
    }
  struct Trial {
    std::size_t scene;
    Choice choice;
  };
  std::vector<Trial> trials;
  for (const auto& [kind, members] : kinds)
    for (const std::size_t i : std::set<std::size_t>{members.front(), members[members.size() / 2], members.back()}) trials.push_back({i, {}});
  in_parallel(trials, threads, [&](Trial& trial) {
    const Scene& scene = scenes[trial.scene];
    try {
      trial.choice = choose_step_for_accuracy(*build_lattice(*scene.projectile), *build_lattice(*scene.target), scene, stop);
    } catch (const FieldError& error) {
      throw SceneError(error, trial.scene);
    }
  });
  auto trial = trials.begin();
  for (const auto& [kind, members] : kinds) {
    const auto first = trial;
    while (trial != trials.end() && std::find(members.begin(), members.end(), trial->scene) != members.end()) ++trial;
    const Choice least = std::min_element(first, trial, [](const Trial& a, const Trial& b) { return a.choice.theta < b.choice.theta; })->choice;
    const Method& method = method_named(first->choice.method);
    double error = 0, seconds = 0;
    for (auto t = first; t != trial; ++t)
      error = std::max(error, t->choice.error * std::pow(least.theta / t->choice.theta, method.outcome_order)), seconds += t->choice.seconds;
    const Integration& wanted = scenes[first->scene].integration;
    told(fmt::format("accuracy {:g} of {}: {} with theta {:.3g} (a step of {:.3g} R/c), estimated error {:.2g} ({} trials, {:.1f} s)", wanted.accuracy, wanted.accuracy_of, method.name,
                     least.theta, least.step, error, trial - first, seconds));
    for (const std::size_t i : members) {
      scenes[i].integration.method = method.name, scenes[i].integration.theta = least.theta, scenes[i].integration.accuracy = not_given;
      scenes[i].error_estimate = error;
    }
  }
  return scenes;
}

}  // namespace ricochet
