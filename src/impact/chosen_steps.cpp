#include "impact/chosen_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "impact/contact_error.hpp"
#include "impact/launch/launch.hpp"
#include "impact/spread.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

// Scenes of a kind that are tried: nine of ten others have no greater error than the greatest of nine.
constexpr std::size_t most_tried = 9;
// Halvings of a chosen step under which an impact fails: what a sixteenth of the energy's drift does not save, no step
// does.
constexpr int most_halvings = 3;

// Of bodies that share their trials: all their numbers but the seed, and the extremes of what depends on the place.
std::string kind_of(const Body& body) {
  std::string kind = body.plane ? "plane" : "";
  for (const auto& [field, place] : BodyNumbers::fields())
    if (field.name != "seed" && (field.name != "nu" || body.node_nu.empty()))
      std::visit([&](auto where) { kind += fmt::format(" {}", body.numbers.*where); }, place);
  Vec2 low = Vec2::Zero(), high = low;
  for (const Vec2& p : body.outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 extent = high - low;
  kind +=
      fmt::format(" {} {:.9g} {:.9g} {:.9g};", body.anchored.empty(), signed_area(body.outline), extent[0], extent[1]);
  for (const Points& hole : body.holes) kind += fmt::format("{:.9g};", signed_area(hole));
  for (const std::vector<double>* by_place : {&body.node_stiffness, &body.node_density, &body.node_nu})
    if (!by_place->empty())
      kind += fmt::format("{:.2g} {:.2g};", *std::min_element(by_place->begin(), by_place->end()),
                          *std::max_element(by_place->begin(), by_place->end()));
  return kind;
}

// All numbers of effects but their seeds.
std::string kind_of(std::vector<Effect> effects) {
  for (Effect& effect : effects)
    std::visit(
        [](auto& e) {
          if constexpr (requires { e.seed; }) e.seed = 0;
        },
        effect);
  return text_of(effects);
}

// What scenes that share their trials have in common.
std::string kind_of(const Scene& scene) {
  std::string kind =
      fmt::format("{:.9g} {:.9g}", (scene.launch.velocity() - scene.target->velocity).norm(), scene.target->spin);
  for (const Body* body : scene.bodies()) kind += kind_of(*body);
  const Integration& i = scene.integration;
  return kind +
         fmt::format("{} {} {} {} {} {} {} {} {} {} {}", i.method, i.accuracy, i.accuracy_of, i.energy_tolerance,
                     i.time_limit, scene.contact.V0, scene.contact.xi, scene.contact.reach, scene.contact.sides,
                     scene.contact.deepest, scene.contact.rule) +
         kind_of(scene.effects);
}

using Places = std::vector<std::size_t>;  // of scenes in a list

// The scene as it starts by itself.
Scene without_accuracy(Scene scene) {
  scene.integration.accuracy = not_given;
  if (scene.integration.method == "auto") scene.integration.method = "verlet";
  return scene;
}

// Places of the members of a kind that are tried.
Places tried_of(const std::vector<Scene>& scenes, const Places& members) {
  std::vector<const Scene*> list;
  for (const std::size_t i : members) list.push_back(&scenes[i]);
  Places tried;
  for (const std::size_t k : spread_over(list, most_tried)) tried.push_back(members[k]);
  return tried;
}

// Built, and found to start. Throws SceneError.
TrialScene trial_scene(const std::vector<Scene>& scenes, std::size_t place) {
  try {
    TrialScene trial{BuiltSolids(scenes[place]), scenes[place]};
    check_start(trial.solids, without_accuracy(scenes[place]));
    return trial;
  } catch (const FieldError& error) {
    throw SceneError(error, place);
  }
}

std::string asked_text(const Integration& asked) {
  return fmt::format("accuracy {:g} of {}", asked.accuracy, asked.accuracy_of);
}

void tell_start(const Integration& asked, std::size_t tried, std::size_t members, const Telling& telling) {
  telling.line(fmt::format("{}: tries steps in {} of {} scenes, at the cost of {:.3g} impacts at most",
                           asked_text(asked), tried, members, affordable_impacts(members)));
}

void tell_left_out(const Integration& asked, const Choice& choice, const Places& tried, const Telling& telling) {
  for (const LeftOut& scene : choice.left_out)
    telling.line(fmt::format(
        "  left out: {}: {}", telling.name(tried[scene.scene]),
        std::isnan(scene.error)
            ? scene.reason
            : fmt::format("{} still changes by {:.2g} at the shortest steps tried", asked.accuracy_of, scene.error)));
}

void tell_choice(const Integration& asked, const Choice& choice, std::size_t tried, const Units& units, bool remembered,
                 const Telling& telling) {
  telling.line(fmt::format(
      "{}: {} with theta {:.3g} (a step of {}), {} error {:.2g} ({}{} trial runs of {} scene{}, the work of {:.3g} "
      "spring evaluations{})",
      asked_text(asked), choice.method, choice.theta, units.shown(choice.step, "R/c"),
      choice.found == Found::extrapolated ? "extrapolated" : "estimated", choice.error,
      remembered ? "remembered: " : "", choice.trials, tried, tried == 1 ? "" : "s", choice.evaluations,
      remembered ? ", of an earlier run" : ""));
  if (choice.found == Found::extrapolated) telling.line("  the trials' share was used up before this step was tried");
  if (choice.found == Found::unsettled)
    telling.line(
        fmt::format("  in {} of {} scenes {} does not settle, so that no step is accurate: the longest one that "
                    "keeps the energy was taken",
                    choice.left_out.size(), tried, asked.accuracy_of));
}

// Gives a kind's scenes what was chosen.
void take(std::vector<Scene>& scenes, const Places& members, const Places& tried, const Choice& choice) {
  for (const std::size_t i : members) {
    scenes[i].integration.method = choice.method;
    scenes[i].integration.theta = choice.theta;
    scenes[i].integration.accuracy = not_given;
    scenes[i].error_step = choice.error;
  }
  for (const LeftOut& scene : choice.left_out)
    if (!std::isnan(scene.error)) scenes[tried[scene.scene]].error_step = scene.error;
}

// The theta of a scene with a chosen one: the same share of the longest that its own contact allows. Throws FieldError
// if it cannot start.
double own_theta(const Solids& solids, Scene scene, double longest) {
  const double chosen = scene.integration.theta;
  scene.integration.theta = not_given;
  const double own = longest_theta(scene.method(), launch(scene, solids).theta);
  scene.integration.theta = chosen * std::min(1.0, own / longest);
  try {
    check_start(solids, scene);
  } catch (const FieldError& error) {
    // Nobody gave it.
    throw FieldError(error.field == "theta" ? "accuracy" : error.field, error.what());
  }
  return scene.integration.theta;
}

// The error of a kind's contact, by the scenes that were tried with what was chosen.
double error_of_contact(const std::vector<Scene>& scenes, const Places& places, std::vector<TrialScene> tried,
                        const Choice& choice, int threads, const std::atomic<bool>& stop) {
  for (std::size_t k = 0; k < tried.size(); ++k) {
    tried[k].scene = scenes[places[k]];
    tried[k].scene.integration.theta = own_theta(tried[k].solids, tried[k].scene, choice.longest);
  }
  return contact_error(tried, threads, stop);
}

// Gives a kind's scenes the error of their contact.
void take_contact(std::vector<Scene>& scenes, const Places& members, double error, const Telling& telling) {
  for (const std::size_t i : members) scenes[i].error_contact = error;
  if (!std::isnan(error))
    telling.line(fmt::format("  contact: twice as hard it changes {} by {:.2g}, so its error is about {:.2g}",
                             scenes[members.front()].integration.accuracy_of, error / 2, error));
}

// Names all that decides about a choice: what is tried, in this order, and for how many impacts.
std::string name_of_trials(const std::vector<Scene>& scenes, const Places& tried, std::size_t members) {
  std::string name = fmt::format("{}", affordable_impacts(members));
  for (const std::size_t i : tried) name += " " + scenes[i].hash();
  return hash_text(name);
}

// What trials choose for a kind's scenes, which get it. Throws Error if they were interrupted: half a trial is none.
TriedChoice tried_now(std::vector<Scene>& scenes, const Places& members, const Places& places, int threads,
                      const std::atomic<bool>& stop, const Telling& telling) {
  const Integration asked = scenes[members.front()].integration;
  std::vector<TrialScene> tried;
  for (const std::size_t i : places) tried.push_back(trial_scene(scenes, i));
  tell_start(asked, places.size(), members.size(), telling);
  TriedChoice found{};
  try {
    found.choice = choose_for_accuracy(tried, members.size(), threads, stop);
  } catch (const FieldError& error) {
    throw SceneError(error, members.front());
  }
  tell_left_out(asked, found.choice, places, telling);
  tell_choice(asked, found.choice, places.size(), scenes[members.front()].units, false, telling);
  take(scenes, members, places, found.choice);
  found.error_contact = error_of_contact(scenes, places, tried, found.choice, threads, stop);
  if (stop) throw Error("interrupted", Exit::interrupted);
  return found;
}

// A kind's scenes get what trials choose, or have chosen before.
KindsChoice try_kind(std::vector<Scene>& scenes, const Places& members, int threads, const std::atomic<bool>& stop,
                     const Telling& telling, TriedChoices& before) {
  const Places places = tried_of(scenes, members);
  const std::string name = name_of_trials(scenes, places, members.size());
  auto found = before.find(name);
  if (found == before.end()) {
    found = before.emplace(name, tried_now(scenes, members, places, threads, stop, telling)).first;
  } else {
    const Scene& first = scenes[members.front()];
    tell_choice(first.integration, found->second.choice, places.size(), first.units, true, telling);
    take(scenes, members, places, found->second.choice);
  }
  const auto& [choice, of_contact] = found->second;
  take_contact(scenes, members, of_contact, telling);
  return {choice.method, choice.theta, choice.longest, choice.error, of_contact};
}

void take_known(std::vector<Scene>& scenes, const Places& members, const KindsChoice& choice) {
  for (const std::size_t i : members) {
    scenes[i].integration.method = choice.method;
    scenes[i].integration.theta = choice.theta;
    scenes[i].integration.accuracy = not_given;
    scenes[i].error_step = choice.error_step;
    scenes[i].error_contact = choice.error_contact;
  }
}

}  // namespace

std::vector<Scene> with_chosen_steps(std::vector<Scene> scenes, int threads, const std::atomic<bool>& stop,
                                     const Telling& telling, KnownChoices* known, TriedChoices* tried) {
  std::map<std::string, Places> kinds;
  std::vector<bool> chosen(scenes.size());
  std::vector<double> theta(scenes.size()), longest(scenes.size());
  KnownChoices own;
  if (!known) known = &own;
  TriedChoices none;
  if (!tried) tried = &none;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    chosen[i] = !std::isnan(scenes[i].integration.accuracy);
    if (chosen[i]) kinds[kind_of(scenes[i])].push_back(i);
  }
  for (const auto& [kind, members] : kinds) {
    if (const auto found = known->find(kind); found != known->end())
      take_known(scenes, members, found->second);
    else
      known->emplace(kind, try_kind(scenes, members, threads, stop, telling, *tried));
    for (const std::size_t i : members) longest[i] = known->at(kind).longest;
  }
  SweepOptions options;
  options.threads = threads;
  each_built(scenes, chosen, options, stop,
             [&](std::size_t i, const Solids& solids) { theta[i] = own_theta(solids, scenes[i], longest[i]); });
  if (stop) throw Error("interrupted", Exit::interrupted);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (chosen[i]) scenes[i].integration.theta = theta[i];
  return scenes;
}

namespace {

bool failed_by_step(const Scene& scene, const Outcome& outcome) {
  return scene.step_is_chosen() && (outcome.status == Status::energy_drift || outcome.status == Status::unstable ||
                                    outcome.status == Status::not_finite);
}

}  // namespace

bool run_chosen(const std::vector<Scene>& scenes, const std::vector<bool>& todo, const SweepOptions& options,
                const std::atomic<bool>& stop, const std::function<void(const std::vector<Result>&)>& some_done,
                const Telling& telling, SweepUse* use) {
  std::vector<Scene> shortened;
  std::vector<bool> again(scenes.size());
  std::map<std::size_t, std::string> failed;  // why
  const auto run = [&](const std::vector<Scene>& list, const std::vector<bool>& which, bool last, SweepUse* used) {
    const auto keep = [&](const std::vector<Result>& results) {
      std::vector<Result> kept;
      for (const Result& result : results) {
        again[result.index] = !last && failed_by_step(list[result.index], result.outcome);
        if (again[result.index])
          failed[result.index] = name_of(result.outcome.status);
        else
          kept.push_back(result);
      }
      if (!kept.empty()) some_done(kept);
    };
    return run_sweep(list, which, options, stop, keep, used);
  };
  if (!run(scenes, todo, false, use)) return false;
  for (int halving = 1; halving <= most_halvings && !failed.empty(); ++halving) {
    if (shortened.empty()) shortened = scenes;
    for (const auto& [i, status] : failed) shortened[i].integration.theta /= 2;
    const auto& [first, status] = *failed.begin();
    const std::string others = failed.size() > 1 ? fmt::format(", and so did {} others", failed.size() - 1) : "";
    telling.line(fmt::format("  {} ended {} by the step that trials chose{}; again with half of it, theta {:.3g}",
                             telling.name(first), status, others, shortened[first].integration.theta));
    failed.clear();
    const std::vector<bool> which = std::exchange(again, std::vector<bool>(scenes.size()));
    if (!run(shortened, which, halving == most_halvings, nullptr)) return false;
  }
  return true;
}

}  // namespace ricochet
