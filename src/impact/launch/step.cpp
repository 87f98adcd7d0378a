#include "impact/launch/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/interior.hpp"
#include "core/error.hpp"

namespace ricochet {
namespace {

/// The vibration that a step must follow.
struct Fastest {
  double omega = 0, slower = 1;  ///< the bound of its frequency times `slower`
  std::size_t body = 0;
  int node = 0;
};

Fastest fastest_vibration(const Scene& scene, const Solids& solids) {
  Fastest fastest;
  const auto bodies = scene.bodies();
  for (std::size_t b = 0; b < solids.size(); ++b) {
    const FrequencyBound bound = frequency_bound(*solids[b], bodies[b]->numbers.stiffness);
    if (!std::isfinite(bound.omega))
      throw FieldError(
          body_name(b),
          "its stiffness over its mass gives frequencies beyond every number; take a softer or heavier body");
    const double slower = slower_by(scene.method(), b);
    if (bound.omega * slower > fastest.omega) fastest = {bound.omega * slower, slower, b, bound.node};
  }
  return fastest;
}

// The lightest node of both surfaces that moves. [m0]
double lightest_on_surface(const Solids& solids) {
  double lightest = std::numeric_limits<double>::infinity();
  for (const Solid* solid : solids)
    for (const int node : surface_nodes(solid->surface))
      if (node < solid->free) lightest = std::min(lightest, solid->mass[node]);
  return lightest;
}

// A light node that a heavy body presses takes up more energy than it could bring itself, which the contact's onset
// resolves. The relative motion brings E = M v^2/2 for each node of the projectile, M: the reduced mass over their
// number; a contact of energy E has the stiffness xi^2 E, and that of a node of mass m the frequency bound
// omega^2 <= 2 xi^2 E/m. `gathered` times the excess (M - m) v^2/2 gathers at one node: up to 1.7 times was seen at
// masses of 10 to 10,000. Above V0 it has passed. 0 where no node is lighter, and of bodies of revolution, whose rings
// are pressed by their areas, which are as their masses: contact_frequency() follows them. [here]
double pressed_frequency(const Scene& scene, const Solids& solids, double speed) {
  constexpr double gathered = 4;
  const Solid &projectile = *solids.front(), &target = *solids.back();
  if (projectile.axisymmetric) return 0;
  const double mass = projectile.total_mass();
  const double reduced = target.anchored() ? mass : mass * target.total_mass() / (mass + target.total_mass());
  const double light = lightest_on_surface(solids), excess = reduced / projectile.nodes() - light;
  if (!(excess > 0)) return 0;
  const double energy = std::min(gathered * excess * speed * speed / 2, scene.contact.V0);
  return scene.contact.xi * std::sqrt(2 * energy / light);
}

// Of a touching node that friction holds by its tangential spring k, which it pulls at the lightest with all that pulls
// back: omega^2 <= 2 k/m. 0 without friction. [here]
double held_frequency(const Scene& scene, const Solids& solids) {
  const Friction* friction = find_effect<Friction>(scene.effects);
  if (!friction) return 0;
  double softer = std::numeric_limits<double>::infinity();
  const auto bodies = scene.bodies();
  for (std::size_t b = 0; b < solids.size(); ++b)
    softer = std::min(softer, mean_stiffness(*solids[b]) * bodies[b]->numbers.stiffness);
  return std::sqrt(2 * friction->stiffness * softer / lightest_on_surface(solids));
}

[[noreturn]] void refuse(const Method& method, const Step& step, const Fastest& fastest, bool by_step) {
  const double unit = by_step ? 1 / fastest.omega : 1;
  const std::string field = by_step ? "step" : "theta", time = by_step ? " R/c" : "";
  throw FieldError(
      field,
      fmt::format("{:.6g}{} is unstable: {} needs a {} below {:.4g}{} here (node {} of the {} vibrates at up to "
                  "{:.4g} c/R); {:.3g}{} works",
                  by_step ? step.step : step.theta, time, method.name, field, method.stability_limit * unit, time,
                  fastest.node, body_name(fastest.body), fastest.omega / fastest.slower, method.usual * unit, time));
}

}  // namespace

std::string conflict_of(const Scene& scene, const Method& method, const Solids& solids) {
  if (method.multirate() && solids.size() != 2)
    return fmt::format("{} moves two bodies, and these are {}; give another method or leave it out", method.name,
                       solids.size());
  if (method.multirate() && solids.front()->axisymmetric)
    return fmt::format("{} knows no axis that nodes cannot leave; give another method or leave it out", method.name);
  return scene.conflict_with(method);
}

Step choose_step(const Scene& scene, const Solids& solids, double fastest_node, double expected) {
  const Method& method = scene.method();
  if (const std::string conflict = conflict_of(scene, method, solids); !conflict.empty())
    throw FieldError("method", conflict);
  const Fastest fastest = fastest_vibration(scene, solids);
  const Integration& wanted = scene.integration;
  const double onset = onset_share * contact_kicks(method) / (scene.contact.xi * fastest_node);
  const double pressed = pressed_frequency(scene, solids, fastest_node);
  // Half of what would be unstable: pressures vary along a rim.
  const double followed = 0.5 * method.stability_limit / expected;
  constexpr double room = 0.9;  // below the limit, of vibrations that friction makes faster
  const double held = held_frequency(scene, solids);
  const double gripped = held > 0 ? room * method.stability_limit / std::hypot(fastest.omega, held)
                                  : std::numeric_limits<double>::infinity();
  const bool by_step = !std::isnan(wanted.step);
  Step step{};
  step.step = by_step ? wanted.step
              : !std::isnan(wanted.theta)
                  ? wanted.theta / fastest.omega
                  : std::min({method.usual / fastest.omega, onset, method.usual / pressed, followed, gripped});
  step.theta = step.step * fastest.omega;
  if (!(step.theta <= method.stability_limit)) refuse(method, step, fastest, by_step);
  return step;
}

}  // namespace ricochet
