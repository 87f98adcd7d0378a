#include "impact/launch/contact_rule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "impact/axes.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

constexpr double softness = 0.02;    // 1/xi over the expected indentation
constexpr double held = 0.005;       // F/xi over the energy of the impact, where springs yield
constexpr double strength = 1000;    // V0 R over the energy of the impact
constexpr double ranges = 30;        // xi reach
constexpr double least_slope = 0.1;  // the normal speed counts as no less of the speed: a rough rim meets asperities

// E2/ka of a lattice of equal springs, and its Poisson's ratio. [triangular lattice: 2/sqrt(3), 1/3]
const double modulus_of_springs = 2 / std::sqrt(3.0);
constexpr double poisson_ratio = 1.0 / 3;

double area_of(const Solid& solid) {
  double area = 0;
  for (const Triangle& t : solid.cells) {
    const auto place = [&](int corner) {
      return solid.points[static_cast<std::size_t>(t[static_cast<std::size_t>(corner)])];
    };
    area += cross(place(1) - place(0), place(2) - place(0)) / 2;
  }
  return area;
}

// Of the springs, on average. [m0 c^2/R^2]
double stiffness_of(const Body& body) {
  if (body.node_stiffness.empty()) return body.numbers.stiffness;
  return std::accumulate(body.node_stiffness.begin(), body.node_stiffness.end(), 0.0) /
         static_cast<double>(body.node_stiffness.size()) * body.numbers.stiffness;
}

LineBody line_body(const Body& body, const Solid& solid) {
  if (body.rigid()) return LineBody::rigid_plane();
  const double modulus = modulus_of_springs * stiffness_of(body);
  if (!solid.anchored()) return LineBody::disk(modulus, std::sqrt(area_of(solid) / std::numbers::pi));
  const Box box = bounding_box(solid.points);
  return LineBody::block(modulus, poisson_ratio, normal(Vec2(box.high - box.low)));
}

double reduced_mass(const Solid& projectile, const Solid& target) {
  const double mass = projectile.total_mass();
  return target.anchored() ? mass : mass * target.total_mass() / (mass + target.total_mass());
}

// Kinetic energy of the relative motion and of the spin.
double energy_of(const Scene& scene, const Solids& solids, const Placement& arrives) {
  const double target_spin = scene.target->spin;
  const double turning = target_spin == 0 ? 0 : solids[1]->inertia() * target_spin * target_spin / 2;
  return turning + reduced_mass(*solids[0], *solids[1]) * arrives.velocity.squaredNorm() / 2 +
         solids[0]->inertia() * arrives.spin.squaredNorm() / 2;
}

bool yields(const Scene& scene) {
  return std::any_of(scene.effects.begin(), scene.effects.end(), [](const Effect& effect) {
    return std::visit([]<class E>(const E&) { return SpringChange<E>; }, effect);
  });
}

double rule_of_xi(const Scene& scene, const Solids& solids, const Placement& arrives) {
  const LineImpact impact = expected_impact(scene, solids, arrives);
  const double hard = 1 / (softness * impact.approach);
  return yields(scene) ? std::max(hard, impact.force / (held * energy_of(scene, solids, arrives))) : hard;
}

}  // namespace

LineImpact expected_impact(const Scene& scene, const Solids& solids, const Placement& arrives) {
  const Vec2 velocity = in_plane(arrives.velocity);
  const double speed = std::max(std::abs(normal(velocity)), least_slope * velocity.norm());
  const auto bodies = scene.bodies();
  return line_impact(pressed_together(line_body(*bodies[0], *solids[0]), line_body(*bodies[1], *solids[1])),
                     reduced_mass(*solids[0], *solids[1]), speed);
}

ExponentialRepulsion acting_contact(const Scene& scene, const Solids& solids, const Placement& arrives) {
  ExponentialRepulsion contact = scene.contact;
  if (std::isnan(contact.xi)) contact.xi = rule_of_xi(scene, solids, arrives);
  contact.by_length = std::isnan(contact.V0);
  if (contact.by_length) contact.V0 = strength * energy_of(scene, solids, arrives);
  if (std::isnan(contact.reach)) contact.reach = ranges / contact.xi;
  return contact;
}

double contact_frequency(const Scene& scene, const Solids& solids, const Placement& arrives,
                         const ExponentialRepulsion& acts) {
  if (!acts.by_length) return 0;
  const LineImpact impact = expected_impact(scene, solids, arrives);
  double most = 0;
  for (const Solid* solid : solids) {
    const auto* mesh = std::get_if<Mesh<2>>(&solid->surface);
    for (std::size_t k = 0; mesh && k < mesh->node.size(); ++k)
      if (mesh->node[k] < solid->free) most = std::max(most, mesh->weight[k] / solid->mass[mesh->node[k]]);
  }
  const double pressure = 2 * impact.force / (std::numbers::pi * impact.half_width);
  return std::sqrt(2 * acts.xi * pressure * most);
}

}  // namespace ricochet
