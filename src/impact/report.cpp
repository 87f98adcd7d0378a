#include "impact/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "impact/axes.hpp"
#include "impact/estimate.hpp"
#include "impact/launch/launch.hpp"
#include "impact/roles.hpp"

namespace ricochet {
namespace {

// Of a row that did not finish, too.
void report_course(const Run& run, Outcome& o) {
  o.certified = run.start.certified;
  o.time = run.time();
  o.step = run.start.step;
  o.theta = run.start.theta;
  o.theta_most = run.theta_most;
  o.steps = static_cast<double>(run.steps);
  o.error_step = run.scene->error_step;
  o.error_contact = run.scene->error_contact;
  o.over_yield = over_yield(*run.scene);
  o.energy_drift = run.drift;
  o.inverted = run.inverted;
  o.xi = run.start.contact.xi;
  o.V0 = run.start.contact.V0;
  o.inversion_time = run.inversion_time;
  o.folded = run.inverted > folded_share;
  o.penetration = run.penetration;
}

void report_last_state(const LastFacts& facts, Outcome& o) {
  const Flying &last = facts.now[role::projectile], &target = facts.now[role::target];
  const auto if_finite = [](double value) { return std::isfinite(value) ? value : Outcome::undefined; };
  const Vec3 velocity = last.velocity - target.velocity;
  o.last_vn = if_finite(normal(velocity));
  o.last_vt = if_finite(tangential(velocity));
  o.last_omega = if_finite(about(last.spin));
  o.last_energy = if_finite(facts.ledger.total());
}

void report_contact(const Run& run, Outcome& o) {
  const TouchClock& clock = run.clock();
  o.touches = clock.count();
  o.contact_time = clock.end() - clock.begin();
  o.contact_time_energy = clock.time_above_floor();
  o.indentation = run.indentation.seen ? run.indentation.depth : Outcome::undefined;
  o.overlap = run.frame.overlap;
  o.contact_length = run.indentation.length;
  o.centre_offset = run.indentation.centre_offset;
  o.tan_alpha = run.indentation.tan_alpha;
}

double ratio(double over, double under) { return under != 0 ? over / under : Outcome::undefined; }

// The projectile's motion relative to the target, before or after.
struct Relative {
  Vec3 velocity;
  double spin, target_spin;
};

Relative relative(const Vec3& velocity, const Vec3& spin, const Vec3& target_velocity, const Vec3& target_spin) {
  return {velocity - target_velocity, about(spin), about(target_spin)};
}

// A body at the first touch: gravity has acted on it since the rims came within reach.
Placement at_touch(const Run& run, const Solids& solids, std::size_t body) {
  return in_flight(*run.scene, solids, run.start, body, run.clock().begin());
}

Relative before(const Run& run, const Solids& solids) {
  const Placement projectile = at_touch(run, solids, role::projectile), target = at_touch(run, solids, role::target);
  return relative(projectile.velocity, projectile.spin, target.velocity, target.spin);
}

Relative after(const Flying& projectile, const Flying& target) {
  return relative(projectile.velocity, projectile.spin, target.velocity, target.spin);
}

// Velocities of the contact point: v_c = v - R omega x n with omega x n = (-omega, 0); the target's own surface moves
// too if it is free and spins.
struct ContactPoint {
  double t, n;
};

ContactPoint under_centre(const Run& run, const Relative& motion) {
  return {tangential(motion.velocity) + run.projectile_radius * motion.spin + run.target_radius * motion.target_spin,
          normal(motion.velocity)};
}

void report_velocities(const Run& run, const Relative& start, const Relative& after, Outcome& o) {
  const ContactPoint first = under_centre(run, start), later = under_centre(run, after);
  o.vn = normal(after.velocity);
  o.vt = tangential(after.velocity);
  o.omega = after.spin;
  o.e = ratio(-normal(after.velocity), normal(start.velocity));
  o.psi1 = ratio(first.t, -first.n);
  o.psi2 = ratio(later.t, -first.n);
  o.beta = ratio(-later.t, first.t);
  if (!std::isfinite(o.tan_alpha)) return;
  const double along = tangential(run.start.bodies[role::projectile].velocity) < 0 ? -1 : 1;
  const Vec2 n_alpha(-along * o.tan_alpha, 1);  // its length cancels
  o.e_alpha = ratio(-Vec2(later.t, later.n).dot(n_alpha), Vec2(first.t, first.n).dot(n_alpha));
}

// J acts on the projectile: its own change of momentum.
Vec3 impulse(const Run& run, const Solids& solids, const Flying& after) {
  return solids[role::projectile]->total_mass() * (after.velocity - at_touch(run, solids, role::projectile).velocity);
}

void report_impulse(const Run& run, const Solids& solids, const Flying& after, const Flying& target_after, Outcome& o) {
  const Vec3 j = impulse(run, solids, after);
  o.impulse_n = normal(j);
  o.impulse_t = tangential(j);
  o.mu = ratio(std::abs(tangential(j)), normal(j));
  o.target_vn = normal(target_after.velocity);
  o.target_vt = tangential(target_after.velocity);
  o.target_omega = about(target_after.spin);
  if (solids[role::target]->anchored()) return;
  const Vec3 target_before = at_touch(run, solids, role::target).velocity;
  const Vec2 residual =
      in_plane(j) + solids[role::target]->total_mass() * in_plane(target_after.velocity - target_before);
  o.momentum_residual =
      residual.norm() / (solids[role::projectile]->total_mass() *
                         in_plane(at_touch(run, solids, role::projectile).velocity - target_before).norm());
}

void report_first_parting(const Run& run, const Solids& solids, const Relative& start, Outcome& o) {
  o.time_first = run.first_parting_time;
  if (!run.first_parting) return;
  const auto& [projectile, target] = *run.first_parting;
  const Vec3 j = impulse(run, solids, projectile);
  o.e_first = ratio(-normal(after(projectile, target).velocity), normal(start.velocity));
  o.mu_first = ratio(std::abs(tangential(j)), normal(j));
}

// From the centres to where the bodies touch, along n and across it. A round body touches below its centre of mass, as
// v_c above has it.
struct Arms {
  double n, t, target_n, target_t;
};

Arms arms_of(const Run& run, const Vec2& n, const Vec2& t) {
  const ContactFrame& frame = run.frame;
  const Vec2 arm = frame.arm[role::projectile] / frame.load, other = frame.arm[role::target] / frame.load;
  Arms arms{-run.projectile_radius, 0, run.target_radius, 0};
  if (!frame.round[role::projectile]) {
    arms.n = arm.dot(n);
    arms.t = arm.dot(t);
  }
  if (!frame.round[role::target]) {
    arms.target_n = other.dot(n);
    arms.target_t = other.dot(t);
  }
  return arms;
}

// v_c = v + omega x arm of both bodies, along n and t.
ContactPoint at_arms(const Relative& motion, const Arms& arms, const Vec2& n, const Vec2& t) {
  const Vec2 v = in_plane(motion.velocity);
  return {t.dot(v) - motion.spin * arms.n + motion.target_spin * arms.target_n,
          n.dot(v) + (motion.spin * arms.t - motion.target_spin * arms.target_t)};
}

// By how much a soft contact may outlast a hard one: the force that counts as one begins ln(1/share)/xi before the
// outlines meet, and ends as far behind. [here]
double contact_time_error(const Run& run, double arrives, double leaves) {
  if (!std::isnan(run.scene->contact.xi)) return Outcome::undefined;
  return -std::log(run.scene->ending.force) / run.start.contact.xi * (1 / std::abs(arrives) + 1 / std::abs(leaves));
}

// What the normal speed of the contact points is uncertain by. Where touches follow each other far apart, the contact
// has no one place: the change of spin times the touches' deviation along t from their mean; none of a round body,
// whose touch is at its foot. Where the normal turns meanwhile, it has no one direction: its deviation times the speed
// along t.
double uncertain_by_place(const Run& run, const Relative& start, const Relative& after, const Vec2& t, double sliding) {
  const ContactFrame& frame = run.frame;
  const std::array<double, 2> turned{after.spin - start.spin, after.target_spin - start.target_spin};
  const double one_way = frame.normal.norm() / frame.load;
  double speed = sliding * std::sqrt(std::max(0.0, 1 - one_way * one_way));
  for (const std::size_t b : {role::projectile, role::target}) {
    if (frame.round[b]) continue;
    const double mean = t.dot(frame.arm[b]) / frame.load;
    const double square = t.dot(frame.arms2[b] * t) / frame.load - mean * mean;
    speed += std::abs(turned[b]) * std::sqrt(std::max(0.0, square));
  }
  return speed;
}

// And by what stands for the smooth outlines: the sides of the rims, along which the contact moves.
double uncertain_by_rims(const Run& run, const Relative& start, const Relative& after, double sliding) {
  const double turning = std::max(std::abs(start.spin - start.target_spin), std::abs(after.spin - after.target_spin));
  return (run.frame.uneven.sliding * sliding + run.frame.uneven.rolling * turning) / run.frame.load;
}

// Where the contact's normal is not y, what the paper defines along y has no meaning.
constexpr double most_tilted = 0.1;
// Of the normal speed, that the contact points' may be uncertain by.
constexpr double most_uncertain = 0.1;
// Of the normal speed: below it what moves along the surface is that of the rim's own polygon.
constexpr double least_slip = 1e-3;

std::string places_leave_uncertain(double share) {
  return fmt::format(
      "e_n and beta_n are undefined: touches at several places of a body that is not round, or a normal that turns "
      "meanwhile, leave v_cn uncertain by {:.0f} %",
      100 * share);
}

std::string rims_leave_uncertain(double share) {
  return fmt::format(
      "e_n is undefined: the sides of the rims, along which the contact moves, leave v_cn uncertain by {:.0f} %; take "
      "more nodes, or a harder contact",
      100 * share);
}

void report_restitution(const Run& run, const Relative& start, const Relative& after, const Vec2& n, Outcome& o) {
  if (run.clock().touching()) return;
  const Vec2 t(normal(n), -tangential(n));
  const Arms arms = arms_of(run, n, t);
  const ContactPoint first = at_arms(start, arms, n, t), later = at_arms(after, arms, n, t);
  o.error_contact_time = contact_time_error(run, first.n, later.n);
  const double sliding = std::max(std::abs(first.t), std::abs(later.t)), towards = std::abs(first.n);
  const double by_place = uncertain_by_place(run, start, after, t, sliding);
  if (!(by_place <= most_uncertain * towards)) {
    o.reason = places_leave_uncertain(by_place / towards);
    return;
  }
  if (std::abs(first.t) > least_slip * towards) o.beta_n = -later.t / first.t;
  const double by_rims = uncertain_by_rims(run, start, after, sliding);
  if (by_rims <= most_uncertain * towards)
    o.e_n = ratio(-later.n, first.n);
  else
    o.reason = rims_leave_uncertain(by_rims / towards);
}

void report_along_normal(const Run& run, const Relative& start, const Relative& after, const Vec2& j, Outcome& o) {
  if (!(run.frame.load > 0)) return;
  const Vec2 n = run.frame.normal.normalized(), t(normal(n), -tangential(n));
  o.normal_x = tangential(n);
  o.normal_y = normal(n);
  report_restitution(run, start, after, n, o);
  o.mu_n = ratio(std::abs(t.dot(j)), n.dot(j));
  if (std::abs(tangential(n)) <= most_tilted) return;
  for (double* of_y : {&o.e, &o.beta, &o.mu, &o.psi1, &o.psi2, &o.e_first, &o.mu_first}) *of_y = Outcome::undefined;
}

// What is defined by the bodies' parting, where the scene's time ends their impact before.
void leave_out_parting(Outcome& o) {
  for (double* of_parting :
       {&o.e, &o.beta, &o.mu, &o.psi2, &o.e_alpha, &o.e_n, &o.beta_n, &o.mu_n, &o.error_contact_time})
    *of_parting = Outcome::undefined;
}

void report_energy(const Run& run, const LastFacts& facts, Outcome& o) {
  o.after = facts.ledger;
  o.effect_energy = facts.effect_energy;
  o.effect_count = facts.effect_count;
  o.energy_closure = std::abs(o.after.total() - run.energy_before) / run.energy_before;
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
  report_course(run, o);
  report_last_state(facts, o);
  o.inertia = inertia_ratio(*solids[role::projectile]);
  o.inertia_target = inertia_ratio(*solids[role::target]);
  if (o.status != Status::finished) return o;
  const Flying &projectile = facts.bodies[role::projectile], &target = facts.bodies[role::target];
  const Relative start = before(run, solids), later = after(projectile, target);
  report_energy(run, facts, o);
  o.plastic_strain_most = facts.plastic_strain_most;
  o.dent = facts.dents[role::projectile];
  o.dent_target = facts.dents[role::target];
  report_contact(run, o);
  report_velocities(run, start, later, o);
  report_impulse(run, solids, projectile, target, o);
  report_first_parting(run, solids, start, o);
  report_along_normal(run, start, later, in_plane(impulse(run, solids, projectile)), o);
  if (run.clock().touching()) leave_out_parting(o);
  return o;
}

Outcome passes_by() {
  Outcome outcome;
  outcome.status = Status::no_contact;
  outcome.reason = sentence_of(ending::PassedBy{}, Run{});
  return outcome;
}

}  // namespace ricochet
