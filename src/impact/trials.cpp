#include "impact/trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/interior.hpp"
#include "core/error.hpp"
#include "impact/sweep.hpp"

namespace ricochet {

double value_of(const Outcome& outcome, const std::string& column) {
  for (const auto& [field, value] : Outcome::fields())
    if (field.name == column) return value(outcome);
  throw std::logic_error("no outcome is called " + column);
}

double richardson(double at_step, double at_half, int order) {
  return std::abs(at_step - at_half) / (1 - std::pow(2.0, -order));
}

double work_of_step(const Method& method, const Solids& solids) {
  if (!method.multirate()) return method.evaluations();
  const MultirateRoles roles;
  const double fast = work_of_sweep(*solids[roles.fast]), slow = work_of_sweep(*solids[roles.slow]);
  return (method.evaluations() * fast + method.slow_evaluations() * slow) / (fast + slow);
}

double springs_of(const Solids& solids) {
  double springs = 0;
  for (const Solid* solid : solids) springs += work_of_sweep(*solid);
  return springs;
}

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Scenes that are judged together: whatever the number of threads, which must not change a choice.
constexpr std::size_t at_once = 3;
// Of the energy's tolerance, what a trial may use: among the scenes that are not tried some stray further, and where
// one strays too far it runs again with half the step.
constexpr double drift_room = 0.5;
// An outcome settles if its error falls by at least this in one halving, or else in two: the orders that rough impacts
// show are 1.4 and more.
constexpr double settling = 0.25;
// One whose error has hardly fallen in the first halving is in doubt; twice in doubt, by whatever method, does not
// settle.
constexpr double hardly = 0.5;
constexpr int most_doubts = 1;

}  // namespace

double Trials::theta(int shorter) const { return theta_ * std::pow(2.0, -shorter / 2.0); }

double Trials::theta_of(std::size_t scene, int shorter) const {
  // In a scene whose longest step is shorter than that of others, the same share of it.
  return theta(shorter) * std::min(1.0, option_.own[scene] / option_.longest);
}

double Trials::cost_of(std::size_t scene, int shorter) const {
  const double steps_a_time = option_.rate[scene] / theta_of(scene, shorter);
  return spent_.mean_time() * steps_a_time * work_of_step(*option_.method, scenes_[scene].solids) *
         springs_of(scenes_[scene].solids);
}

Scene Trials::scene_at(std::size_t scene, int shorter) const {
  Scene tried = scenes_[scene].scene;
  tried.integration.method = option_.method->name;
  tried.integration.accuracy = not_given;
  tried.integration.theta = theta_of(scene, shorter);
  return tried;
}

void Trials::keep(std::size_t scene, int shorter, const Outcome& outcome) {
  const Integration& asked = scenes_[scene].scene.integration;
  Trial& trial = known_[{scene, shorter}];
  trial.hopeless = outcome.status == Status::tunnelled || outcome.status == Status::out_of_time;
  trial.counts = outcome.status != Status::no_contact;
  if (outcome.status == Status::finished) {
    trial.value = value_of(outcome, asked.accuracy_of);
    trial.drift = outcome.energy_drift / asked.energy_tolerance;
    trial.counts = !std::isnan(trial.value);
  } else {
    trial.reason = outcome.reason;
  }
  const Solids solids = scenes_[scene].solids;
  spent_.evaluations += outcome.steps * work_of_step(*option_.method, solids) * springs_of(solids);
  spent_.time += std::isnan(outcome.time) ? 0 : outcome.time;
  ++spent_.runs;
}

// Runs what is not known yet, the steps of a scene beside each other in lanes. False if that would cost too much.
bool Trials::run(const std::vector<std::size_t>& some, const std::vector<int>& at, int threads,
                 const std::atomic<bool>& stop) {
  std::vector<std::pair<std::size_t, int>> wanted;
  std::vector<Scene> list;
  double cost = 0;
  for (const std::size_t scene : some)
    for (const int shorter : at) {
      if (known_.contains({scene, shorter})) continue;
      wanted.emplace_back(scene, shorter);
      list.push_back(scene_at(scene, shorter));
      if (spent_.runs > 0) cost += cost_of(scene, shorter);
    }
  if (list.empty()) return true;
  if (!spent_.affords(cost)) return false;
  std::vector<Outcome> outcomes(list.size());
  run_sweep(list, std::vector<bool>(list.size(), true), {threads}, stop, [&](const std::vector<Result>& results) {
    for (const Result& result : results) outcomes[result.index] = result.outcome;
  });
  if (stop) throw Error("interrupted", Exit::interrupted);
  for (std::size_t i = 0; i < list.size(); ++i) keep(wanted[i].first, wanted[i].second, outcomes[i]);
  return true;
}

// Of the step against its half; infinite if one of them does not finish.
double Trials::error(std::size_t scene, int shorter) const {
  const Trial &at_step = at(scene, shorter), &at_half = at(scene, shorter + half);
  if (!at_step.counts || !at_half.counts) return 0;
  const double error = richardson(at_step.value, at_half.value, option_.order);
  return std::isnan(error) ? infinite : error;
}

void Trials::leave_out(std::size_t scene, int shorter) {
  const double left = error(scene, shorter);
  const Trial& last = at(scene, shorter + half);
  standing_.left_out.push_back({scene, std::isinf(left) ? not_given : left, last.reason});
  std::erase(standing_.order, scene);
}

// Of scenes that are off by more than is allowed. False if that would cost too much to tell.
bool Trials::leave_out_unsettled(std::vector<std::size_t> some, int shorter, double allowed, int threads,
                                 const std::atomic<bool>& stop) {
  std::erase_if(some, [&](std::size_t scene) {
    const bool hopeless = at(scene, shorter).hopeless && at(scene, shorter + half).hopeless;
    if (hopeless) leave_out(scene, shorter);
    return hopeless;
  });
  const auto fell = [&](std::size_t scene, int at, double share) {
    const double now = error(scene, at);
    return std::isfinite(now) && now <= std::max(allowed, share * error(scene, shorter));
  };
  if (!run(some, {shorter + 2 * half}, threads, stop)) return false;
  for (const std::size_t scene : some)
    if (!fell(scene, shorter + half, hardly) && ++standing_.doubts[scene] > most_doubts)
      leave_out(scene, shorter + half);
  std::erase_if(some, [&](std::size_t scene) {
    return std::ranges::count(standing_.order, scene) == 0 || fell(scene, shorter + half, settling);
  });
  if (!run(some, {shorter + 3 * half}, threads, stop)) return false;
  for (const std::size_t scene : some)
    if (!fell(scene, shorter + 2 * half, settling)) leave_out(scene, shorter + 2 * half);
  return true;
}

void Trials::add(std::size_t scene, int shorter, Judgement& all) const {
  const Trial &at_step = at(scene, shorter), &at_half = at(scene, shorter + half);
  if (!at_step.counts || !at_half.counts) return;
  all.defined = true;
  const double error_here = error(scene, shorter);
  if (std::isinf(error_here)) all.reason = at_step.reason.empty() ? at_half.reason : at_step.reason;
  all.error = std::max(all.error, error_here);
}

// Over what is allowed in a trial.
double Trials::drift(std::size_t scene, int shorter) const {
  return std::max(at(scene, shorter).drift, at(scene, shorter + half).drift) / drift_room;
}

Trials::Judgement Trials::judge(int shorter, double allowed, int threads, const std::atomic<bool>& stop) {
  Judgement all;
  std::vector<std::size_t>& order = standing_.order;
  for (std::size_t first = 0; first < order.size();) {
    const std::size_t last = std::min(first + at_once, order.size());
    const std::vector<std::size_t> some(order.begin() + static_cast<std::ptrdiff_t>(first),
                                        order.begin() + static_cast<std::ptrdiff_t>(last));
    all.paid = run(some, {shorter, shorter + half}, threads, stop);
    if (!all.paid) return all;
    std::vector<std::size_t> off;
    for (const std::size_t scene : some) {
      all.drift = std::max(all.drift, drift(scene, shorter));
      if (!(error(scene, shorter) <= allowed)) off.push_back(scene);
    }
    const std::size_t before = order.size();
    all.paid = leave_out_unsettled(off, shorter, allowed, threads, stop);
    const std::size_t stayed = last - first - (before - order.size());
    for (std::size_t k = 0; k < stayed; ++k) {
      const auto place = order.begin() + static_cast<std::ptrdiff_t>(first + k);
      Judgement alone;
      alone.drift = drift(*place, shorter);
      add(*place, shorter, alone);
      add(*place, shorter, all);
      if (!alone.good(allowed)) std::rotate(order.begin(), place, place + 1);  // the next time it comes first
    }
    if (!all.paid || !all.good(allowed)) return all;
    first += stayed;
  }
  return all;
}

}  // namespace ricochet
