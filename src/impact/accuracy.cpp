#include "impact/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "impact/launch/launch.hpp"
#include "impact/launch/step.hpp"

namespace ricochet {

std::vector<std::string> methods_for(double accuracy) {
  if (accuracy >= 1e-5)
    return {"multirate_8", "multirate_5", "multirate_3", "multirate_2", "verlet", "takahashi_imada"};
  if (accuracy >= 1e-8) return {"multirate_3", "multirate_2", "takahashi_imada", "chin_4a"};
  return {"blanes_moan_srkn6b"};
}

double affordable_impacts(std::size_t members) { return std::max(12.0, 0.25 * static_cast<double>(members)); }

double longest_theta(const Method& method, double usual) {
  return std::min(2 * usual, 0.8 * method.stability_limit);  // room for springs that stiffen
}

namespace {

constexpr int most_attempts = 12;
// Steps shorter than the default by more than this are not tried: another method is what is wanted then.
constexpr double most_shortened = 20;
// The estimate is aimed at this share of what was asked for: the true error may be twice the estimate.
constexpr double aim = 0.5;

MethodOption option_of(const std::vector<TrialScene>& scenes, const std::string& name) {
  MethodOption c;
  c.method = &method_named(name);
  c.order = c.method->outcome_order;
  for (const Effect& effect : scenes.front().scene.effects)
    if (order_beside(effect) > 0) c.order = std::min(c.order, order_beside(effect));
  c.work = work_of_step(*c.method, scenes.front().solids);
  for (const TrialScene& trial : scenes) {
    Scene scene = trial.scene;
    scene.integration.method = name;
    scene.integration.accuracy = not_given;
    const Start start = launch(scene, trial.solids);
    c.own.push_back(longest_theta(*c.method, start.theta));
    c.rate.push_back(start.theta / start.step);
    c.usual = std::max(c.usual, start.theta);
    c.longest = std::max(c.longest, c.own.back());
  }
  return c;
}

// The longest step that is likely to do, for an accuracy that the usual one does not reach.
double guess_of(const MethodOption& c, double wanted) {
  return std::clamp(c.usual * std::pow(wanted / c.method->usual_accuracy, 1.0 / c.order), c.usual / 4, c.longest);
}

/// A step by a method, and the error that it makes.
struct Reached {
  const MethodOption* by = nullptr;
  double theta = 0, error = 0;

  double cost() const { return by->work * by->rate.front() / theta; }  ///< of a unit of time
};

// The share of a step that keeps the energy as trials must.
double energy_ratio(const Trials::Judgement& seen, const MethodOption& c) {
  return std::pow(0.9 / seen.drift, 1.0 / std::min(c.order, c.method->order));
}

int half_octaves(double ratio) { return static_cast<int>(std::ceil(-2 * std::log2(std::clamp(ratio, 0.2, 0.8)))); }

// By how many half octaves a step must be shorter to reach what is wanted, by the orders of outcome and energy.
int shortening(const Trials::Judgement& seen, const MethodOption& c, double wanted) {
  const double of_error = std::isinf(seen.error) ? 0.5 : std::pow(0.7 * aim * wanted / seen.error, 1.0 / c.order);
  return half_octaves(seen.drift > 1 ? std::min(of_error, energy_ratio(seen, c)) : of_error);
}

/// The scenes of a choice, and where it stands.
struct Search {
  const std::vector<TrialScene>& scenes;
  const Integration& asked;
  int threads;
  const std::atomic<bool>& stop;
  Standing standing{scenes.size()};
  Spent spent{};
  bool used_up = false;                                          ///< nothing more may be spent
  double least_error = std::numeric_limits<double>::infinity();  ///< seen
  std::string reason{};                                          ///< why a trial did not finish
  Reached likely{};   ///< the cheapest untried step that is likely to reach what is wanted
  Reached longest{};  ///< the cheapest step that keeps the energy

  bool over() const { return used_up || standing.order.empty() || standing.unsettled(); }
};

void keep_cheaper(Reached& kept, const Reached& other) {
  if (!kept.by || other.cost() < kept.cost()) kept = other;
}

// What the search learns from a step that did not do. Returns by how much shorter the next one should be.
int learn(Search& search, const Trials& trials, int shorter, const Trials::Judgement& seen, const MethodOption& c) {
  search.least_error = std::min(search.least_error, seen.error);
  if (!seen.reason.empty()) search.reason = seen.reason;
  const int by = shortening(seen, c, search.asked.accuracy);
  const int for_energy = seen.drift > 1 ? half_octaves(energy_ratio(seen, c)) : 0;
  keep_cheaper(search.longest, {&c, trials.theta(shorter + for_energy)});
  const Reached next{&c, trials.theta(shorter + by), seen.error * std::pow(2.0, -by * c.order / 2.0)};
  if (next.error <= search.asked.accuracy) keep_cheaper(search.likely, next);
  return by;
}

// Shortens the step of a method until the estimated error is small enough, but not below `shortest`. Nothing if no step
// did.
std::optional<Reached> shorten_step(Search& search, const MethodOption& c, double shortest) {
  const double wanted = search.asked.accuracy;
  // A single scene's estimate may be small by chance, the more steps are tried; that of several hardly.
  const bool from_longest = search.scenes.size() > 2;
  Trials trials(search.scenes, c, from_longest ? c.longest : std::max(guess_of(c, wanted), shortest), search.standing,
                search.spent);
  int shorter = 0;
  for (int attempt = 0; attempt < most_attempts && trials.theta(shorter) >= shortest * (1 - 1e-9); ++attempt) {
    const Trials::Judgement seen = trials.judge(shorter, aim * wanted, search.threads, search.stop);
    search.used_up = !seen.paid;
    if (search.standing.order.empty()) break;
    if (search.used_up && !seen.defined) break;
    if (!seen.defined)
      throw FieldError("accuracy_of",
                       fmt::format("{} is not defined in this impact; name another outcome", search.asked.accuracy_of));
    if (seen.paid && seen.good(aim * wanted) && !search.standing.unsettled())
      return Reached{&c, trials.theta(shorter), seen.error};
    shorter += learn(search, trials, shorter, seen, c);
    if (search.over()) break;
  }
  return std::nullopt;
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

[[noreturn]] void refuse_accuracy(const Search& search, const std::string& method) {
  const Integration& asked = search.asked;
  double least = search.least_error;
  std::string reason = search.reason;
  for (const LeftOut& scene : search.standing.left_out) {
    if (!std::isnan(scene.error)) least = std::min(least, scene.error);
    if (!scene.reason.empty()) reason = scene.reason;
  }
  if (std::isinf(least)) throw FieldError("accuracy", fmt::format("no trial run finished ({})", reason));
  const std::string all = search.standing.order.empty() && search.scenes.size() > 1
                              ? fmt::format(" in any of {} scenes that were tried", search.scenes.size())
                              : "";
  throw FieldError("accuracy", fmt::format("{:g} is below what {} can reach for {} here{}: the estimated error stays "
                                           "at {:.2g}; ask for {:.2g}, or for another method",
                                           asked.accuracy, method, asked.accuracy_of, all, least, 2.1 * least));
}

Choice choice_of(const Search& search, const Reached& reached, Found found, const std::vector<std::size_t>& places) {
  const MethodOption& c = *reached.by;
  Choice choice{
      c.method->name,    reached.theta / c.rate.front(), reached.theta,           c.longest, reached.error, found,
      search.spent.runs, search.spent.evaluations,       search.standing.left_out};
  for (LeftOut& scene : choice.left_out) {
    if (found == Found::unsettled && scene.reason.empty()) choice.error = std::max(choice.error, scene.error);
    scene.scene = places[scene.scene];
  }
  return choice;
}

// What an impact takes at the usual step of a method, or at the one that a higher accuracy is likely to need.
double usual_cost(const std::vector<TrialScene>& scenes, const MethodOption& c, double wanted) {
  return c.work * springs_of(scenes.front().solids) * c.rate.front() / std::min(c.usual, guess_of(c, wanted));
}

}  // namespace

Choice choose_for_accuracy(std::vector<TrialScene> scenes, std::size_t members, int threads,
                           const std::atomic<bool>& stop) {
  const Integration asked = scenes.front().scene.integration;
  const std::vector<std::string> names = names_for(scenes.front().scene, scenes.front().solids);
  std::vector<TrialScene> meeting;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (passes_by(scenes[i], names.back())) continue;
    places.push_back(i);
    meeting.push_back(scenes[i]);
  }
  if (meeting.empty()) {
    const MethodOption any = option_of(scenes, names.back());
    return {any.method->name, any.usual / any.rate.front(), any.usual, any.longest};
  }
  const std::vector<MethodOption> options = options_for(meeting, names);
  Search search{meeting, asked, threads, stop};
  search.spent.impacts = affordable_impacts(members);
  search.spent.usual = usual_cost(meeting, option_of(meeting, meeting.front().scene.method().name), asked.accuracy);
  for (std::size_t i = 0; i < options.size() && !search.over(); ++i) {
    const MethodOption& c = options[i];
    const double shortest =
        i + 1 < options.size() ? c.work * c.rate.front() / options[i + 1].cost() : c.usual / most_shortened;
    if (const auto reached = shorten_step(search, c, shortest))
      return choice_of(search, *reached, Found::tried, places);
  }
  const bool some = !search.standing.order.empty();
  if (some && search.standing.unsettled()) return choice_of(search, search.longest, Found::unsettled, places);
  if (some && search.used_up && search.likely.by) return choice_of(search, search.likely, Found::extrapolated, places);
  refuse_accuracy(search, names.back());
}

Choice choose_step_for_accuracy(const Solids& solids, const Scene& scene, const std::atomic<bool>& stop) {
  std::vector<std::shared_ptr<const Solid>> borrowed;
  for (const Solid* solid : solids) borrowed.emplace_back(std::shared_ptr<const Solid>(), solid);
  return choose_for_accuracy({{BuiltSolids(borrowed), scene}}, 1, 1, stop);
}

}  // namespace ricochet
