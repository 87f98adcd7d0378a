#include "impact/launch/launch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/interior.hpp"
#include "core/error.hpp"
#include "impact/axes.hpp"
#include "impact/launch/aim.hpp"
#include "impact/launch/checks.hpp"
#include "impact/launch/contact_rule.hpp"
#include "impact/launch/step.hpp"
#include "impact/launch/symmetry.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

Start bodies_at_launch(const Scene& scene, const Solids& solids) {
  Start start;
  for (const Solid* solid : solids) start.bodies.push_back(placed_at_rest(*solid));
  for (const Body* body : scene.bodies()) start.stiffness.push_back(body->numbers.stiffness);
  start.bodies[0].velocity = in_space(scene.launch.velocity());
  start.bodies[0].spin = about_z(scene.launch.spin);
  start.bodies[1].velocity = in_space(scene.target->velocity);
  start.bodies[1].spin = about_z(scene.target->spin);
  return start;
}

// Gravity acts from a height that was given on. A free target that falls alike sees no fall.
Vec3 fall_from_height(const Scene& scene, bool target_is_held) {
  constexpr int count = 2;
  if (std::isnan(scene.launch.height)) return Vec3::Zero();
  const bool alike = !target_is_held && fall_of(scene.effects, 1, count) != Vec3::Zero();
  return alike ? Vec3(Vec3::Zero()) : fall_of(scene.effects, 0, count);
}

// Velocity along y after a fall from all the height that was given.
double fallen(const Scene& scene, double launched, double acceleration) {
  const double height = scene.launch.height;
  return acceleration < 0 && height > 0 ? -std::hypot(launched, std::sqrt(-2 * acceleration * height)) : launched;
}

// The projectile as it arrives.
Placement arriving(const Scene& scene, Placement launched) {
  launched.velocity.y() = fallen(scene, launched.velocity.y(), launched.acceleration.y());
  return launched;
}

// What of the projectile's motion, as the target sees it, its contact can meet: before a plane, which has nothing to
// catch on, what is along the plane goes on for ever.
Placement met_by(const Solid& target, Placement placement) {
  if (const auto* plane = std::get_if<Plane>(&target.surface))
    placement.velocity = placement.velocity.dot(plane->normal) * plane->normal;
  return placement;
}

// Of a node that is pushed off the other body, unless it is held. [m0 c^2]
double least_V0(const ExponentialRepulsion& contact, const Solids& solids) {
  if (!contact.by_length) return contact.V0;
  double least = std::numeric_limits<double>::infinity();
  for (const Solid* solid : solids)
    if (const auto* mesh = std::get_if<Mesh<2>>(&solid->surface))
      least = std::min(least, *std::min_element(mesh->weight.begin(), mesh->weight.end()));
  return contact.V0 * least;
}

// Energy at launch, and whether it is too little to cross a cell: that of the relative motion, in the frame where it is
// least; an anchored target is infinitely heavy.
void take_energy(Start& start, const Placement& arrives, const Scene& scene, const Solids& solids) {
  const Solid &projectile = *solids[0], &target = *solids[1];
  const Placement flies = met_by(target, arrives);
  const double mass = projectile.total_mass();
  const double reduced = target.anchored() ? mass : mass * target.total_mass() / (mass + target.total_mass());
  const double spin = flies.spin.z(), speed2 = in_plane(flies.velocity).squaredNorm();
  const double target_spin = start.bodies[1].spin.z();
  double rotation = projectile.inertia() * spin * spin / 2;
  if (target_spin != 0) rotation += target.inertia() * target_spin * target_spin / 2;
  start.energy = mass * speed2 / 2 + rotation;
  // Attraction lowers the wall that V0 is, and other effects bring energy beside that of the launch: no claim then.
  const bool more_energy = std::any_of(scene.effects.begin(), scene.effects.end(),
                                       [](const Effect& effect) {
                                         return std::visit([]<class E>(const E&) { return BringsEnergy<E>; }, effect);
                                       }) ||
                           rest_energy(projectile) > 0 || rest_energy(target) > 0;
  // What nobody pushes may stand inside.
  const bool all_pushed = scene.contact.two_sided() || std::holds_alternative<Plane>(target.surface);
  start.certified = all_pushed && !more_energy && scene.contact.rule != "spring_normal" &&
                    reduced * speed2 / 2 + rotation < least_V0(scene.contact, solids);
}

// What is cut off must not show: of the paper's contact, 1e-8 of the energy at 0.1 c is left at 0.0735 R.
ExponentialRepulsion widened(ExponentialRepulsion contact, double energy) {
  if (energy > 0) contact.reach = std::max(contact.reach, std::log(contact.V0 / (cut_share * energy)) / contact.xi);
  return contact;
}

[[noreturn]] void refuse_landing(const Scene& scene, const Flight& flight) {
  const auto [first, last] = flight.landing_range();
  throw FieldError("at",
                   fmt::format("a projectile at x = {} R passes beside the target; give more than {:.6g} R and less "
                               "than {:.6g} R",
                               scene.launch.at, first, last));
}

// Refuses a start that the projectile could only have come to through the target: time 0 is the end of a free flight. A
// script that gives the height says itself where that begins.
void check_arrival(const Scene& scene, const Solids& solids, const Flight& flight, Placement seen) {
  if (!std::isnan(scene.launch.height) || std::holds_alternative<Plane>(solids[1]->surface) ||
      is_convex(solids[1]->smooth))
    return;
  seen.velocity = -seen.velocity;
  seen.spin = -seen.spin;
  const double touch = 0.01 * flight.distance(seen);
  if (flight.closest_approach(seen, touch) <= touch)
    throw FieldError(
        "launch",
        "the flight to the start passes through the target; give height, to start below what is in the way, "
        "or another at, angle or psi1");
}

// The run begins where the flight, seen by the target, has come to: the target's centre is where it was built.
void settle(Start& start, const Placement& seen) {
  Placement& target = start.bodies[1];
  start.bodies[0] = seen;
  start.bodies[0].velocity += target.velocity;
  target.turn = Turn(target.spin.z() * seen.time);
  target.time = seen.time;
}

}  // namespace

Start launch(const Scene& described, const Solids& solids) {
  check_bodies(solids);
  check_symmetry(described, solids);
  check_yielding(described);
  Scene scene = described;
  Start start = bodies_at_launch(scene, solids);
  const Solid &projectile = *solids[0], &target = *solids[1];
  const Flight flight(projectile, target, displacement_at_start(scene.effects), start.bodies[1].spin.z());
  start.bodies[0].acceleration = fall_from_height(scene, solids[1]->anchored());
  check_motion(scene, start.bodies[0]);
  check_small_turns(solids, start);
  const Placement arrives = arriving(scene, seen_by_target(start));
  const Placement met = met_by(target, arrives);
  scene.contact = acting_contact(described, solids, met);
  check_contact(scene.contact);
  check_effects(scene, solids);
  const double fastest = flight.fastest(arrives), meeting = flight.fastest(met);
  const auto [step, theta] = choose_step(scene, solids, meeting, contact_frequency(scene, solids, met, scene.contact));
  start.step = step;
  start.theta = theta;
  const double normal_speed = -arrives.velocity.y();
  start.time_limit =
      !std::isnan(scene.integration.time_limit) ? scene.integration.time_limit : 100 + 2 / std::max(normal_speed, 1e-9);
  if (scene.ending.at == "time") start.time_limit = std::max(start.time_limit, scene.ending.time);
  const Vec2 centre = projectile.centre();
  start.least_step = least_step(fastest, std::max(centre.norm(), flight.radius()));
  check_progress(scene, start, fastest);
  check_patience(scene, start, meeting, flight.radius());
  check_contact_is_seen(scene, step, meeting, flight.radius());
  take_energy(start, arrives, scene, solids);
  const double lift = flight.resting_lift(scene.launch.at);
  if (std::isnan(lift)) refuse_landing(scene, flight);
  start.overlap_height = centre.y() + lift - target.centre().y();
  start.contact = widened(scene.contact, start.energy);
  auto placement = upstream(scene, start, flight, lift, centre);
  const double thrown = placement ? placement->velocity.y() : 0, fall = start.bodies[0].acceleration.y();
  start.touches = placement && flight.advance(*placement, start.contact.reach);
  if (!placement) return start;
  check_arrival(scene, solids, flight, *placement);
  if (fall != 0) start.fell = (placement->velocity.y() - thrown) / fall;
  settle(start, *placement);
  return start;
}

Vec2 arriving_velocity(const Scene& scene, bool target_is_held) {
  const Vec2 seen = scene.launch.velocity() - scene.target->velocity;
  return {tangential(seen), fallen(scene, normal(seen), normal(fall_from_height(scene, target_is_held)))};
}

Vec3 free_fall(const Scene& scene, const Solids& solids, std::size_t body) {
  if (solids[body]->anchored()) return Vec3::Zero();
  return fall_of(scene.effects, static_cast<int>(body), static_cast<int>(solids.size()));
}

Placement in_flight(const Scene& scene, const Solids& solids, const Start& start, std::size_t body, double time) {
  Placement placement = start.bodies[body];
  placement.acceleration = free_fall(scene, solids, body);
  return flown(placement, time);
}

}  // namespace ricochet
