#include "impact/launch/contact_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "body/elasticity.hpp"
#include "contact/plastic_contact.hpp"
#include "impact/axes.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

constexpr double softness = 0.005;       // 1/xi over the expected indentation, of smooth rims
constexpr double rough_softness = 0.02;  // of rough ones, whose contact lasts as its asperities do
constexpr double held = 0.005;        // F/xi over the energy of the impact, where springs yield; over e^2 of it, metals
constexpr double strength = 1000;     // V0 R over the energy of the impact
constexpr double ranges = 30;         // xi reach
constexpr double most_ranges = 699;   // beyond it there is nothing
constexpr double on_asperity = 0.25;  // of the force, on one node of a rough rim
constexpr double least_slope = 0.1;   // the normal speed counts as no less of the speed: a rough rim meets asperities

// Area, or volume of a body of revolution.
double measure_of(const Solid& solid) {
  double sum = 0;
  for (const Triangle& t : solid.cells) sum += measure_at_rest(solid, t);
  return sum;
}

// Of the springs, on average. [m0 c^2/R^2]
double stiffness_of(const Body& body) {
  if (body.node_stiffness.empty()) return body.numbers.stiffness;
  return std::accumulate(body.node_stiffness.begin(), body.node_stiffness.end(), 0.0) /
         static_cast<double>(body.node_stiffness.size());
}

LineBody line_body(const Body& body, const Solid& solid) {
  if (body.rigid()) return LineBody::rigid_plane();
  const PlaneModuli moduli = usual_moduli(body.numbers);
  const double modulus = moduli.per_stiffness * stiffness_of(body);
  if (!solid.anchored()) return LineBody::disk(modulus, std::sqrt(measure_of(solid) / std::numbers::pi));
  const Box box = bounding_box(solid.points);
  return LineBody::block(modulus, moduli.poisson_ratio, normal(Vec2(box.high - box.low)));
}

PointBody point_body(const Body& body, const Solid& solid) {
  if (body.rigid()) return {};
  const double modulus = usual_moduli(body.numbers).per_stiffness * stiffness_of(body);
  if (solid.anchored()) return {modulus};
  return {modulus, std::cbrt(3 * measure_of(solid) / (4 * std::numbers::pi))};
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

// An attraction and the repulsion are one potential, whose numbers nobody but the script knows: the usual ones.
ExponentialRepulsion beside_pair_forces(const Scene& scene) {
  ExponentialRepulsion contact = scene.contact;
  const bool one = std::any_of(scene.effects.begin(), scene.effects.end(), [](const Effect& effect) {
    return std::visit([]<class E>(const E&) { return PairForceEffect<E>; }, effect);
  });
  if (!one) return contact;
  if (std::isnan(contact.V0)) contact.V0 = 150;
  if (std::isnan(contact.xi)) contact.xi = 300;
  if (std::isnan(contact.reach)) contact.reach = 30 / contact.xi;
  return contact;
}

bool rough(const Scene& scene) {
  const auto bodies = scene.bodies();
  return std::any_of(bodies.begin(), bodies.end(), [](const Body* body) { return body->numbers.roughness > 0; });
}

// The least yield stress of the bodies whose elements yield; infinite if none do. [m0 c^2/R^2, m0 c^2/R^3]
double least_yield(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  for (const Effect& effect : scene.effects)
    if (const auto* yielding = std::get_if<Yielding>(&effect)) least = std::min(least, yielding->yield);
  return least;
}

// Where elements yield, if the energy is more than what is elastic.
PlasticImpact expected_flow(const Scene& scene, const Solids& solids, double energy, double pressure) {
  const auto bodies = scene.bodies();
  if (solids[0]->axisymmetric)
    return plastic_point_impact(
        pressed_together(point_body(*bodies[0], *solids[0]), point_body(*bodies[1], *solids[1])), energy, pressure);
  return plastic_line_impact(pressed_together(line_body(*bodies[0], *solids[0]), line_body(*bodies[1], *solids[1])),
                             energy, pressure);
}

// xi of a contact that gives back no more than `held` of what the bodies do themselves, where they flow; else 0. [1/R]
double hard_where_it_flows(const Scene& scene, const Solids& solids, double force, double energy) {
  const double yield = least_yield(scene);
  if (std::isinf(yield)) return 0;
  const PlasticImpact flow = expected_flow(scene, solids, energy, flow_pressure(yield));
  return std::min(force, flow.force) / (held * std::min(energy, flow.kept));
}

double rule_of_xi(const Scene& scene, const Solids& solids, const Placement& arrives) {
  const QuasiStaticImpact impact = expected_impact(scene, solids, arrives);
  const double hard = 1 / ((rough(scene) ? rough_softness : softness) * impact.approach);
  const double energy = energy_of(scene, solids, arrives);
  if (yields(scene)) return std::max(hard, impact.force / (held * energy));
  return std::max(hard, hard_where_it_flows(scene, solids, impact.force, energy));
}

}  // namespace

QuasiStaticImpact expected_impact(const Scene& scene, const Solids& solids, const Placement& arrives) {
  const Vec2 velocity = in_plane(arrives.velocity);
  const double speed = std::max(std::abs(normal(velocity)), least_slope * velocity.norm());
  const auto bodies = scene.bodies();
  const double mass = reduced_mass(*solids[0], *solids[1]);
  if (solids[0]->axisymmetric)
    return point_impact(pressed_together(point_body(*bodies[0], *solids[0]), point_body(*bodies[1], *solids[1])), mass,
                        speed);
  return line_impact(pressed_together(line_body(*bodies[0], *solids[0]), line_body(*bodies[1], *solids[1])), mass,
                     speed);
}

ExponentialRepulsion acting_contact(const Scene& scene, const Solids& solids, const Placement& arrives) {
  ExponentialRepulsion contact = beside_pair_forces(scene);
  const bool by_rule = std::isnan(contact.xi);
  if (by_rule) contact.xi = rule_of_xi(scene, solids, arrives);
  contact.by_length = std::isnan(contact.V0);
  if (contact.by_length) contact.V0 = strength * energy_of(scene, solids, arrives);
  if (std::isnan(contact.reach)) contact.reach = ranges / contact.xi;
  if (by_rule) contact.reach = std::min(contact.reach, most_ranges / contact.xi);
  return contact;
}

double contact_frequency(const Scene& scene, const Solids& solids, const Placement& arrives,
                         const ExponentialRepulsion& acts) {
  if (!acts.by_length) return 0;
  const QuasiStaticImpact impact = expected_impact(scene, solids, arrives);
  double most = 0, lightest = std::numeric_limits<double>::infinity();
  for (const Solid* solid : solids) {
    const auto* mesh = std::get_if<Mesh<2>>(&solid->surface);
    for (std::size_t k = 0; mesh && k < mesh->node.size(); ++k)
      if (mesh->node[k] < solid->free) {
        most = std::max(most, mesh->weight[k] / solid->mass[mesh->node[k]]);
        lightest = std::min(lightest, solid->mass[mesh->node[k]]);
      }
  }
  const double pressure = std::min(impact.pressure, flow_pressure(least_yield(scene)));
  double omega2 = 2 * acts.xi * pressure * most;
  if (rough(scene)) omega2 = std::max(omega2, 2 * acts.xi * impact.force * on_asperity / lightest);
  return std::sqrt(omega2);
}

}  // namespace ricochet
