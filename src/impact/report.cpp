#include "impact/report.hpp"

#include <cmath>

#include "impact/axes.hpp"
#include "impact/estimate.hpp"
#include "impact/roles.hpp"

namespace ricochet {
namespace {

void report_course(const Run& run, Outcome& o) {
  o.certified = run.start.certified;
  o.time = run.time();
  o.step = run.start.step;
  o.theta = run.start.theta;
  o.theta_most = run.theta_most;
  o.steps = static_cast<double>(run.steps);
  o.error_estimate = run.scene->error_estimate;
  o.over_yield = over_yield(*run.scene);
  o.energy_drift = run.drift;
  o.inverted = run.inverted;
  o.inversion_time = run.inversion_time;
}

void report_contact(const Run& run, Outcome& o) {
  const TouchRecord& touch = run.touch[role::aimed_pair];
  o.touches = touch.touches;
  o.contact_time = touch.duration();
  o.indentation = run.indentation.seen ? run.indentation.depth : Outcome::undefined;
  o.contact_length = run.indentation.length;
  o.centre_offset = run.indentation.centre_offset;
  o.tan_alpha = run.indentation.tan_alpha;
}

// The projectile at the first touch: where gravity acts from the start, it has gone on falling since the rims came
// within reach.
Placement at_touch(const Run& run) {
  return flown(run.start.bodies[role::projectile], run.touch[role::aimed_pair].first);
}

// Velocities of the contact point: v_c = v - R omega x n with omega x n = (-omega, 0); the target's own surface moves
// too if it is free and spins.
struct ContactPoint {
  double t, n;
};

void report_velocities(const Run& run, const Flying& after, const Flying& target_after, Outcome& o) {
  const Placement launched = at_touch(run);
  const Vec3& v = launched.velocity;
  const Vec3 w = after.velocity - target_after.velocity;
  const double R = run.projectile_radius, omega = about(after.spin);
  const ContactPoint before{tangential(v) + R * about(launched.spin), normal(v)};
  const ContactPoint later{tangential(w) + R * omega + run.target_radius * about(target_after.spin), normal(w)};
  o.vn = normal(w);
  o.vt = tangential(w);
  o.omega = omega;
  o.e = -normal(w) / normal(v);
  o.psi1 = before.t / -before.n;
  o.psi2 = later.t / -before.n;
  o.beta = before.t != 0 ? -later.t / before.t : Outcome::undefined;
  if (!std::isfinite(o.tan_alpha)) return;
  const Vec2 n_alpha(-o.tan_alpha, 1);  // its length cancels
  o.e_alpha = -Vec2(later.t, later.n).dot(n_alpha) / Vec2(before.t, before.n).dot(n_alpha);
}

// J acts on the projectile: its own change of momentum.
void report_impulse(const Run& run, const Solids& solids, const Flying& after, const Flying& target_after, Outcome& o) {
  const Vec3 v = at_touch(run).velocity;
  const double mass = solids[role::projectile]->total_mass();
  const Vec3 impulse = mass * (after.velocity - v);
  o.impulse_n = normal(impulse);
  o.impulse_t = tangential(impulse);
  o.mu = std::abs(tangential(impulse)) / normal(impulse);
  if (solids[role::target]->anchored()) return;
  const Vec2 residual = in_plane(impulse) + solids[role::target]->total_mass() * in_plane(target_after.velocity);
  o.momentum_residual = residual.norm() / (mass * in_plane(v).norm());
}

// I/(M R^2), of what can turn.
double inertia_ratio(const Solid& solid) {
  return solid.anchored() ? Outcome::undefined : solid.inertia() / solid.total_mass();
}

}  // namespace

Outcome report(const Run& run, const Ending& ending, const Solids& solids, const LastFacts& facts) {
  Outcome o;
  o.status = status_of(ending);
  o.reason = sentence_of(ending, run);
  o.before = run.before;
  o.after = facts.ledger;
  o.effect_energy = facts.effect_energy;
  o.effect_count = facts.effect_count;
  o.energy_closure = std::abs(o.after.total() - run.energy_before) / run.energy_before;
  report_course(run, o);
  report_contact(run, o);
  o.inertia = inertia_ratio(*solids[role::projectile]);
  o.inertia_target = inertia_ratio(*solids[role::target]);
  const Flying &after = facts.bodies[role::projectile], &target_after = facts.bodies[role::target];
  report_velocities(run, after, target_after, o);
  report_impulse(run, solids, after, target_after, o);
  return o;
}

Outcome passes_by() {
  Outcome outcome;
  outcome.status = Status::no_contact;
  outcome.reason = sentence_of(ending::PassedBy{}, Run{});
  return outcome;
}

}  // namespace ricochet
