#include "impact/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "body/interior.hpp"
#include "core/error.hpp"
#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "impact/launch/step.hpp"
#include "impact/parallel.hpp"
#include "shape/outline.hpp"

namespace ricochet {

double value_of(const Outcome& outcome, const std::string& column) {
  for (const auto& [field, value] : Outcome::fields())
    if (field.name == column) return value(outcome);
  throw std::logic_error("no outcome is called " + column);
}

double richardson(double at_step, double at_half, int order) {
  return std::abs(at_step - at_half) / (1 - std::pow(2.0, -order));
}

std::vector<std::string> methods_for(double accuracy) {
  if (accuracy >= 1e-5)
    return {"multirate_8", "multirate_5", "multirate_3", "multirate_2", "verlet", "takahashi_imada"};
  if (accuracy >= 1e-8) return {"multirate_3", "multirate_2", "takahashi_imada", "chin_4a"};
  return {"blanes_moan_srkn6b"};
}

double work_of_step(const Method& method, const Solids& solids) {
  if (!method.multirate()) return method.evaluations();
  const MultirateRoles roles;
  const double fast = work_of_sweep(*solids[roles.fast]), slow = work_of_sweep(*solids[roles.slow]);
  return (method.evaluations() * fast + method.slow_evaluations() * slow) / (fast + slow);
}

namespace {

constexpr int most_attempts = 12;
// Steps shorter than the default by more than this are not tried: another method is what is wanted then.
constexpr double most_shortened = 20;
// The estimate is aimed at this share of what was asked for: the true error may be twice the estimate.
constexpr double aim = 0.5;
// Scenes of a kind that are tried: nine of ten others have no greater error than the greatest of nine.
constexpr std::size_t most_tried = 9;

/// One scene, run by a method and theta; what its outcome says.
struct Trial {
  const TrialScene* of;
  double theta;
  double value = not_given;
  bool counts = true;  ///< false if the bodies pass by each other, or the outcome is not defined there
  std::string reason{};
};

/// Runs scenes by one method.
class Trials {
 public:
  /// `scenes` are tried in their order; the hardest one is moved to the front.
  Trials(std::vector<const TrialScene*>& scenes, const std::string& method, int threads, const std::atomic<bool>& stop)
      : scenes_(scenes), method_(method), threads_(threads), stop_(stop) {}

  // The greatest estimated error of all scenes, or of those up to one above `allowed`; NaN if one of them does not
  // finish.
  double error_at(double theta, int order, double allowed) {
    double worst = 0;
    some_count = false;
    for (std::size_t first = 0; first < scenes_.size(); first += at_once) {
      const std::size_t last = std::min(first + at_once, scenes_.size());
      std::vector<Trial> trials;
      for (std::size_t i = first; i < last; ++i) {
        trials.push_back({scenes_[i], theta});
        trials.push_back({scenes_[i], theta / 2});
      }
      run(trials);
      std::size_t hardest = scenes_.size();
      for (std::size_t i = first; i < last; ++i) {
        const Trial &at_step = trials[2 * (i - first)], &at_half = trials[2 * (i - first) + 1];
        if (!at_step.counts || !at_half.counts) continue;
        some_count = true;
        const double error = richardson(at_step.value, at_half.value, order);
        if (std::isnan(error)) reason = at_step.reason.empty() ? at_half.reason : at_step.reason;
        if (!(error <= worst) && !std::isnan(worst)) {
          worst = error;
          hardest = i;
        }
      }
      if (!(worst <= allowed)) {
        std::rotate(scenes_.begin(), scenes_.begin() + static_cast<std::ptrdiff_t>(hardest),
                    scenes_.begin() + static_cast<std::ptrdiff_t>(hardest) + 1);
        break;
      }
    }
    return worst;
  }

  int count = 0;
  bool some_count = true;  ///< an outcome was defined in some scene of the last trials
  std::string reason;

 private:
  static constexpr std::size_t at_once = 3;  // whatever the number of threads: they must not change a choice

  void run(std::vector<Trial>& trials) {
    in_parallel(trials, threads_, [&](Trial& trial) {
      Scene scene = trial.of->scene;
      scene.integration.method = method_;
      scene.integration.accuracy = not_given;
      scene.integration.theta = trial.theta;
      const Outcome outcome = run_scene(trial.of->solids, scene, stop_);
      if (outcome.status == Status::finished) {
        trial.value = value_of(outcome, scene.integration.accuracy_of);
        trial.counts = !std::isnan(trial.value);
      } else {
        trial.counts = outcome.status != Status::no_contact;
        trial.reason = outcome.reason;
      }
    });
    if (stop_) throw Error("interrupted", Exit::interrupted);
    count += static_cast<int>(trials.size());
  }

  std::vector<const TrialScene*>& scenes_;
  std::string method_;
  int threads_;
  const std::atomic<bool>& stop_;
};

struct MethodOption {
  const Method* method;
  double usual;          ///< theta of the default step
  double longest;        ///< theta
  double step_of_theta;  ///< [R/c], in the first scene
  double work;           ///< of a step

  double cost() const { return work / (longest * step_of_theta); }  ///< of a unit of time, at best
};

MethodOption option_of(const std::vector<TrialScene>& scenes, const std::string& name) {
  const Method& method = method_named(name);
  MethodOption c{&method, std::numeric_limits<double>::infinity(), 0, 0, 0};
  for (const TrialScene& trial : scenes) {
    Scene scene = trial.scene;
    scene.integration.method = name;
    scene.integration.accuracy = not_given;
    const Start start = launch(scene, trial.solids);
    if (&trial == &scenes.front()) {
      c.step_of_theta = start.step / start.theta;
      c.work = work_of_step(method, trial.solids);
    }
    c.usual = std::min(c.usual, start.theta);  // the default step resolves the contact's onset
  }
  c.longest = c.usual * std::min(2.0, 0.8 * method.stability_limit / c.usual);  // room for springs that stiffen
  return c;
}

struct Reached {
  double theta = 0, error = std::numeric_limits<double>::infinity();  ///< theta 0: the accuracy was not reached; the
                                                                      ///< least error was this
  std::string reason;
};

// Shortens the step of a method until the estimated error is small enough, but not below `shortest`.
Reached shorten_step(Trials& trials, const MethodOption& c, const Integration& asked, double shortest,
                     bool from_longest, const std::vector<Effect>& effects) {
  const double wanted = asked.accuracy;
  int order = c.method->outcome_order;
  for (const Effect& effect : effects)
    if (order_beside(effect) > 0) order = std::min(order, order_beside(effect));
  const double guess =
      std::clamp(c.usual * std::pow(wanted / c.method->usual_accuracy, 1.0 / order), c.usual / 4, c.longest);
  double theta = from_longest ? c.longest : std::max(guess, shortest), best = std::numeric_limits<double>::infinity(),
         previous = not_given;
  for (int attempt = 0; attempt < most_attempts && theta >= shortest; ++attempt) {
    const double error = trials.error_at(theta, order, aim * wanted);
    if (!trials.some_count)
      throw FieldError("accuracy_of",
                       fmt::format("{} is not defined in this impact; name another outcome", asked.accuracy_of));
    if (error <= aim * wanted) return {theta, error, ""};
    // Two attempts in a row that gain less than a step of half as long should by far: rounding, or paths that part at a
    // near tie.
    if (!(error < best / 2) && !(previous < 2 * best) && attempt > 3) break;
    previous = best;
    best = std::min(best, std::isnan(error) ? best : error);
    const double ratio = std::isnan(error) ? 0.5 : std::pow(0.7 * aim * wanted / error, 1.0 / order);
    theta *= std::clamp(ratio, 0.2, 0.8);
  }
  return {0, best, trials.reason};
}

// Names of the methods that may be tried for these scenes.
std::vector<std::string> names_for(const Scene& scene, const Solids& solids) {
  const Integration& asked = scene.integration;
  if (asked.method != "auto") return {asked.method};
  std::vector<std::string> names = methods_for(asked.accuracy);
  std::erase_if(names,
                [&](const std::string& name) { return !conflict_of(scene, method_named(name), solids).empty(); });
  if (names.empty()) names = {"verlet"};  // beside any effect
  return names;
}

bool passes_by(const TrialScene& trial, const std::string& method) {
  Scene plain = trial.scene;
  plain.integration.method = method;
  plain.integration.accuracy = not_given;
  return !launch(plain, trial.solids).touches;
}

// From the cheapest at its longest step on, each as long as it stays cheaper than the last, which ends the list.
std::vector<MethodOption> options_for(const std::vector<TrialScene>& scenes, const std::vector<std::string>& names) {
  const MethodOption last = option_of(scenes, names.back());
  std::vector<MethodOption> options;
  for (const std::string& name : names)
    if (const MethodOption c = option_of(scenes, name); c.cost() < last.cost()) options.push_back(c);
  std::sort(options.begin(), options.end(),
            [](const MethodOption& a, const MethodOption& b) { return a.cost() < b.cost(); });
  options.push_back(last);
  return options;
}

[[noreturn]] void refuse_accuracy(const Integration& asked, const std::string& method, const Reached& reached) {
  throw FieldError("accuracy",
                   std::isinf(reached.error)
                       ? fmt::format("no trial run finished ({})", reached.reason)
                       : fmt::format("{:g} is below what {} can reach for {} here: the estimated error "
                                     "stays at {:.2g}; ask for {:.2g}, or for another method",
                                     asked.accuracy, method, asked.accuracy_of, reached.error, 2.1 * reached.error));
}

}  // namespace

Choice choose_for_accuracy(std::vector<TrialScene> scenes, int threads, const std::atomic<bool>& stop) {
  const auto began = std::chrono::steady_clock::now();
  const Scene scene = scenes.front().scene;
  const std::vector<std::string> names = names_for(scene, scenes.front().solids);
  const std::vector<TrialScene> all = scenes;
  std::erase_if(scenes, [&](const TrialScene& trial) { return passes_by(trial, names.back()); });
  if (scenes.empty()) {
    const MethodOption any = option_of(all, names.back());
    return {any.method->name, any.usual * any.step_of_theta, any.usual, 0, 0, 0};
  }
  const std::vector<MethodOption> options = options_for(scenes, names);
  std::vector<const TrialScene*> in_order;
  for (const TrialScene& trial : scenes) in_order.push_back(&trial);
  int trial_count = 0;
  Reached reached;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const MethodOption& c = options[i];
    const double shortest =
        i + 1 < options.size() ? c.work / (options[i + 1].cost() * c.step_of_theta) : c.usual / most_shortened;
    Trials trials(in_order, c.method->name, threads, stop);
    // A single scene's estimate may be small by chance, the more steps are tried; that of several hardly.
    reached = shorten_step(trials, c, scene.integration, shortest, scenes.size() > 2, scene.effects);
    trial_count += trials.count;
    if (reached.theta == 0) continue;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return {c.method->name, reached.theta * c.step_of_theta, reached.theta, reached.error, trial_count, seconds};
  }
  refuse_accuracy(scene.integration, names.back(), reached);
}

Choice choose_step_for_accuracy(const Solids& solids, const Scene& scene, const std::atomic<bool>& stop) {
  std::vector<std::shared_ptr<const Solid>> borrowed;
  for (const Solid* solid : solids) borrowed.emplace_back(std::shared_ptr<const Solid>(), solid);
  return choose_for_accuracy({{BuiltSolids(borrowed), scene}}, 1, stop);
}

namespace {

// Of bodies that share their trials: all their numbers but the seed, and the extremes of what depends on the place.
std::string kind_of(const Body& body) {
  std::string kind = body.plane ? "plane" : "";
  for (const auto& [field, place] : BodyNumbers::fields())
    if (field.name != "seed") std::visit([&](auto where) { kind += fmt::format(" {}", body.numbers.*where); }, place);
  Vec2 low = Vec2::Zero(), high = low;
  for (const Vec2& p : body.outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 extent = high - low;
  kind +=
      fmt::format(" {} {:.9g} {:.9g} {:.9g};", body.anchored.empty(), signed_area(body.outline), extent[0], extent[1]);
  if (const auto& k = body.node_stiffness; !k.empty())
    kind += fmt::format("{:.2g} {:.2g};", *std::min_element(k.begin(), k.end()), *std::max_element(k.begin(), k.end()));
  return kind;
}

// What scenes that share their trials have in common.
std::string kind_of(const Scene& scene) {
  std::string kind = fmt::format("{:.9g}", scene.launch.velocity().norm());
  for (const Body* body : scene.bodies()) kind += kind_of(*body);
  const Integration& i = scene.integration;
  return kind +
         fmt::format("{} {} {} {} {} {} {} {} {}", i.method, i.accuracy, i.accuracy_of, i.energy_tolerance,
                     i.time_limit, scene.contact.V0, scene.contact.xi, scene.contact.reach, scene.contact.sides) +
         batch_text_of(scene.effects);
}

using Places = std::vector<std::size_t>;  // of scenes in a list

// As many as are tried, spread evenly.
std::set<std::size_t> tried_of(const Places& members) {
  std::set<std::size_t> places;
  const std::size_t count = std::min(members.size(), most_tried);
  for (std::size_t k = 0; k < count; ++k)
    places.insert(members[count > 1 ? k * (members.size() - 1) / (count - 1) : 0]);
  return places;
}

// Built, and found to start. Throws SceneError.
TrialScene trial_scene(const std::vector<Scene>& scenes, std::size_t place) {
  Scene plain = scenes[place];
  plain.integration.accuracy = not_given;
  if (plain.integration.method == "auto") plain.integration.method = "verlet";
  try {
    TrialScene trial{BuiltSolids(scenes[place]), scenes[place]};
    check_start(trial.solids, plain);
    return trial;
  } catch (const FieldError& error) {
    throw SceneError(error, place);
  }
}

}  // namespace

std::vector<Scene> with_chosen_steps(std::vector<Scene> scenes, int threads, const std::atomic<bool>& stop,
                                     const std::function<void(const std::string&)>& told) {
  std::map<std::string, Places> kinds;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (!std::isnan(scenes[i].integration.accuracy)) kinds[kind_of(scenes[i])].push_back(i);
  for (const auto& [kind, members] : kinds) {
    std::vector<TrialScene> tried;
    for (const std::size_t i : tried_of(members)) tried.push_back(trial_scene(scenes, i));
    Choice choice;
    try {
      choice = choose_for_accuracy(tried, threads, stop);
    } catch (const FieldError& error) {
      throw SceneError(error, members.front());
    }
    const Integration& wanted = scenes[members.front()].integration;
    told(
        fmt::format("accuracy {:g} of {}: {} with theta {:.3g} (a step of {:.3g} R/c), estimated error {:.2g} ({} "
                    "trial runs of {} scene{}, {:.1f} s)",
                    wanted.accuracy, wanted.accuracy_of, choice.method, choice.theta, choice.step, choice.error,
                    choice.trials, tried.size(), tried.size() == 1 ? "" : "s", choice.seconds));
    for (const std::size_t i : members) {
      scenes[i].integration.method = choice.method;
      scenes[i].integration.theta = choice.theta;
      scenes[i].integration.accuracy = not_given;
      scenes[i].error_step = choice.error;
    }
  }
  return scenes;
}

}  // namespace ricochet
