#include "impact/launch/launch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/interior.hpp"
#include "core/error.hpp"
#include "impact/launch/aim.hpp"
#include "impact/launch/checks.hpp"
#include "impact/launch/step.hpp"

namespace ricochet {
namespace {

Start bodies_at_launch(const Scene& scene, const Solids& solids) {
  Start start;
  for (const Solid* solid : solids) start.bodies.push_back(placed_at_rest(*solid));
  for (const Body* body : scene.bodies()) start.stiffness.push_back(body->numbers.stiffness);
  start.bodies[0].velocity = in_space(scene.launch.velocity());
  start.bodies[0].spin = about_z(scene.launch.spin);
  return start;
}

// Gravity acts from a height that was given on. A free target that falls alike sees no fall.
Vec3 fall_from_height(const Scene& scene, const Solids& solids) {
  const int count = static_cast<int>(solids.size());
  if (std::isnan(scene.launch.height)) return Vec3::Zero();
  const bool alike = !solids[1]->anchored() && fall_of(scene.effects, 1, count) != Vec3::Zero();
  return alike ? Vec3(Vec3::Zero()) : fall_of(scene.effects, 0, count);
}

// The projectile as it arrives, if it falls all the height that was given.
Placement arriving(const Scene& scene, Placement launched) {
  const double fall = -launched.acceleration.y(), height = scene.launch.height;
  if (fall > 0 && height > 0) launched.velocity.y() = -std::hypot(launched.velocity.y(), std::sqrt(2 * fall * height));
  return launched;
}

// What of the projectile's motion its contact can meet: before a plane, which has nothing to catch on, what is along
// the plane goes on for ever.
Placement met_by(const Solid& target, Placement placement) {
  if (const auto* plane = std::get_if<Plane>(&target.surface))
    placement.velocity = placement.velocity.dot(plane->normal) * plane->normal;
  return placement;
}

// Energy at launch, and whether it is too little to cross a cell: that of the relative motion, in the frame where it is
// least; an anchored target is infinitely heavy.
void take_energy(Start& start, const Placement& arrives, const Scene& scene, const Solids& solids) {
  const Solid &projectile = *solids[0], &target = *solids[1];
  const Placement flies = met_by(target, arrives);
  const double mass = projectile.total_mass();
  const double reduced = target.anchored() ? mass : mass * target.total_mass() / (mass + target.total_mass());
  const double spin = flies.spin.z(), speed2 = in_plane(flies.velocity).squaredNorm();
  const double rotation = projectile.inertia() * spin * spin / 2;
  start.energy = mass * speed2 / 2 + rotation;
  // Attraction lowers the wall that V0 is, and other effects bring energy beside that of the launch: no claim then.
  const bool more_energy = std::any_of(scene.effects.begin(), scene.effects.end(),
                                       [](const Effect& effect) {
                                         return std::visit([]<class E>(const E&) { return BringsEnergy<E>; }, effect);
                                       }) ||
                           rest_energy(projectile) > 0 || rest_energy(target) > 0;
  start.certified = reduced * speed2 / 2 + rotation < scene.contact.V0 && !more_energy;
}

// What is cut off must not show: at 0.1 c a reach of 0.1 R is far enough, below about 1e-4 c it is not.
ExponentialRepulsion widened(ExponentialRepulsion contact, double energy) {
  constexpr double cut_share = touch_share / 100;
  if (energy > 0) contact.reach = std::max(contact.reach, std::log(contact.V0 / (cut_share * energy)) / contact.xi);
  return contact;
}

}  // namespace

Start launch(const Scene& scene, const Solids& solids) {
  check_bodies(solids);
  check_contact(scene.contact);
  check_effects(scene, solids);
  Start start = bodies_at_launch(scene, solids);
  const Solid &projectile = *solids[0], &target = *solids[1];
  const Flight flight(projectile, target, displacement_at_start(scene.effects));
  start.bodies[0].acceleration = fall_from_height(scene, solids);
  check_motion(scene, start.bodies[0]);
  const Placement arrives = arriving(scene, start.bodies[0]);
  const double fastest = flight.fastest(arrives), meeting = flight.fastest(met_by(target, arrives));
  const auto [step, theta] = choose_step(scene, solids, meeting);
  start.step = step;
  start.theta = theta;
  const double normal_speed = -arrives.velocity.y();
  start.time_limit =
      !std::isnan(scene.integration.time_limit) ? scene.integration.time_limit : 100 + 2 / std::max(normal_speed, 1e-9);
  const Vec2 centre = projectile.centre();
  check_progress(scene, start, fastest, std::max(centre.norm(), flight.radius()));
  check_contact_is_seen(scene, step, meeting, flight.radius());
  take_energy(start, arrives, scene, solids);
  const double lift = flight.resting_lift(scene.launch.at);
  if (std::isnan(lift))
    throw FieldError("at", fmt::format("a projectile at x = {} passes beside the target", scene.launch.at));
  start.overlap_height = centre.y() + lift - target.centre().y();
  start.contact = widened(scene.contact, start.energy);
  const auto placement = upstream(scene, start, flight, lift, centre);
  if (placement) start.bodies[0] = *placement;
  const double thrown = start.bodies[0].velocity.y(), fall = start.bodies[0].acceleration.y();
  start.touches = placement && flight.advance(start.bodies[0], start.contact.reach);
  if (fall != 0) start.fell = (start.bodies[0].velocity.y() - thrown) / fall;
  return start;
}

}  // namespace ricochet
