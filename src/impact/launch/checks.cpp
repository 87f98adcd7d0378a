#include "impact/launch/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "impact/launch/step.hpp"

namespace ricochet {
namespace {

// Which field the user chose the step by, if any.
const char* given_step(const Integration& wanted) {
  return !std::isnan(wanted.step) ? "step" : !std::isnan(wanted.theta) ? "theta" : nullptr;
}

const char* speed_field(const Scene& scene) { return std::isnan(scene.launch.normal_speed) ? "speed" : "normal_speed"; }

}  // namespace

void check_bodies(const Solids& solids) {
  const Solid& projectile = *solids.front();
  if (projectile.anchored())
    throw FieldError("projectile", projectile.free > 0
                                       ? "a projectile must be free, this body has anchored nodes"
                                       : "a projectile must be free, nothing of this body moves; make it the target");
}

void check_motion(const Scene& scene, const Placement& launched) {
  if (launched.velocity != Vec3::Zero() || launched.acceleration != Vec3::Zero()) return;
  throw FieldError(std::isnan(scene.launch.normal_speed) ? "speed" : "normal_speed",
                   "0 leaves the projectile where it is: it needs a launch.height to fall from and gravity on the "
                   "projectile alone, effects = { ricochet.gravity { g = 1e-3 } }, or a speed above 0");
}

void check_small_turns(const Solids& solids, const Start& start) {
  for (std::size_t b = 0; b < solids.size(); ++b) {
    const Elements* elements = solids[b]->elements();
    if (elements && !turns_freely(elements->law) && start.bodies[b].spin != Vec3::Zero())
      throw FieldError(b == 0 ? "spin" : body_name(b),
                       "the linear law takes a rotation for a strain; leave the spin out, or give the body law = "
                       "\"polynomial\"");
  }
}

void check_contact(const ExponentialRepulsion& contact) {
  const double ranges = contact.xi * contact.reach;
  if (ranges < 20)
    throw FieldError(
        "contact",
        fmt::format("xi reach = {:g} cuts the repulsion at more than exp(-20); raise reach to {:g} R or more", ranges,
                    20 / contact.xi));
  if (ranges > 700)
    throw FieldError(
        "contact",
        fmt::format("xi reach = {:g} is beyond exp(-700), the smallest number there is; lower reach to {:g} R or less",
                    ranges, 700 / contact.xi));
}

void check_effects(const Scene& scene, const Solids& solids) {
  if (const std::string conflict = conflict_of(scene.effects); !conflict.empty()) throw FieldError("effects", conflict);
  if (const std::string conflict = conflict_with(scene.effects, solids, scene.contact); !conflict.empty())
    throw FieldError("effects", conflict);
}

// Of E: what yields sooner is a number in another unit.
constexpr double least_yield_share = 1e-6;

void check_yielding(const Scene& scene) {
  const auto bodies = scene.bodies();
  const int count = static_cast<int>(bodies.size());
  for (int b = 0; b < count; ++b) {
    const BodyNumbers& numbers = bodies[static_cast<std::size_t>(b)]->numbers;
    const Yielding* yielding = flowing(scene.effects, b, count);
    if (!yielding || numbers.interior != "elements" || bodies[static_cast<std::size_t>(b)]->plane) continue;
    const std::string of = "yielding: the " + body_name(static_cast<std::size_t>(b));
    if (std::isnan(yielding->yield + yielding->hardening))
      throw FieldError("effects", of + " is of no material with a yield stress; give yield and hardening");
    if (yielding->yield < least_yield_share * numbers.stiffness)
      throw FieldError("effects",
                       fmt::format("{} has a yield stress of {:.2g} of its E, and metals have 1e-4 to 1e-2: in "
                                   "SI both are in Pa",
                                   of, yielding->yield / numbers.stiffness));
    if (numbers.state == "plane_stress")
      throw FieldError("effects", of + " is free to bulge, and would flow across the plane too; give it state = "
                                       "\"plane_strain\" or \"axisymmetric\"");
    if (numbers.law != BodyNumbers{}.law)
      throw FieldError("effects", fmt::format("{} has the law {}, and what yields has one of its own; leave law out",
                                              of, numbers.law));
    if (scene.method().evaluations() != 1)
      throw FieldError("method",
                       fmt::format("{} evaluates places that are no places of the motion, where elements would "
                                   "yield; give verlet or leave method out",
                                   scene.method().name));
  }
}

void check_contact_is_seen(const Scene& scene, double step, double fastest, double radius) {
  const Integration& wanted = scene.integration;
  const char* given = given_step(wanted);
  if (!given || fastest == 0) return;
  const Method& method = scene.method();
  const double furthest = std::min(10 * onset_share * contact_kicks(method) / scene.contact.xi,
                                   radius * method.evaluations() / evaluations_between_looks);
  if (step * fastest <= furthest) return;
  const double unit = std::isnan(wanted.step) ? wanted.theta / step : 1;
  throw FieldError(given,
                   fmt::format("the projectile would move by {:.2g} R in a step of {:.3g} R/c and might pass the "
                               "contact unseen, whose repulsion grows e-fold in {:.2g} R; give {:.3g}{} or less",
                               step * fastest, step, 1 / scene.contact.xi, 0.99 * furthest / fastest * unit,
                               std::isnan(wanted.step) ? "" : " R/c"));
}

void check_patience(const Scene& scene, const Start& start, double fastest, double radius) {
  constexpr double most_steps = 1e9;  // hours to days
  constexpr double usual_time = 100;  // of an impact; a slow approach may take longer by itself
  const double limit = scene.integration.time_limit, time = std::isnan(limit) ? usual_time : limit;
  const bool set_by_contact = start.theta < 0.99 * scene.method().usual;
  const double steps = time / start.step;
  if (given_step(scene.integration) || !set_by_contact || steps <= most_steps) return;
  const double share = most_steps / steps, spin = std::abs(scene.launch.spin);
  const bool by_spin = spin * radius > fastest / 2;
  const std::string field = by_spin ? "spin" : speed_field(scene);
  throw FieldError(
      field, fmt::format("the projectile's nodes move at {:.2g} c: to follow their contact takes steps of {:.2g} R/c, "
                         "{:.2g} of them in {:.3g} R/c; give a {} below {:.2g} {}, or a time_limit below {:.2g} R/c",
                         fastest, start.step, steps, time, field, share * (by_spin ? spin : fastest),
                         by_spin ? "c/R" : "c", share * time));
}

namespace {

// t + step = t within the time limit.
[[noreturn]] void refuse_lost_step(const Scene& scene, const Start& start, const char* given, const char* speed) {
  const bool limited = !std::isnan(scene.integration.time_limit);
  if (!given && !limited && start.step < 1e-12)
    throw FieldError("projectile",
                     fmt::format("the bodies are so stiff that a time step of {:.3g} R/c is lost in rounding at the "
                                 "time limit of {:.3g} R/c; take softer or heavier bodies",
                                 start.step, start.time_limit));
  const std::string remedy = given     ? std::string("a longer ") + given
                             : limited ? "a shorter time_limit"
                                       : "a lower speed";
  throw FieldError(
      given     ? given
      : limited ? "time_limit"
                : speed,
      fmt::format(
          "a time step of {:.3g} R/c is lost in rounding at the time limit of {:.3g} R/c: t + step = t; give {}",
          start.step, start.time_limit, remedy));
}

}  // namespace

double least_step(double fastest, double size) {
  return fastest > 0 ? 1e3 * std::numeric_limits<double>::epsilon() * size / fastest : 0;
}

void check_progress(const Scene& scene, const Start& start, double fastest) {
  const Integration& wanted = scene.integration;
  const char* given = given_step(wanted);
  const char* speed = speed_field(scene);
  if (start.time_limit + start.step == start.time_limit) refuse_lost_step(scene, start, given, speed);
  if (!(start.step < start.least_step)) return;
  const double least = start.least_step * fastest;
  const std::string remedy = !given ? fmt::format("a speed of {:.2g} c", least / start.step)
                             : given[0] == 's'
                                 ? fmt::format("a step of {:.2g} R/c", least / fastest)
                                 : fmt::format("a theta of {:.2g}", least / fastest / start.step * wanted.theta);
  throw FieldError(
      given ? given : speed,
      fmt::format(
          "in a step of {:.3g} R/c the projectile would move by {:.2g} R, which is lost in rounding; give {} or more",
          start.step, start.step * fastest, remedy));
}

}  // namespace ricochet
