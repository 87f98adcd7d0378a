#pragma once
// What looks at the lanes of a state between steps: the ledger, the frequency bounds, the endings.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "body/inversion.hpp"
#include "core/error.hpp"
#include "impact/launch/aim.hpp"
#include "impact/report.hpp"
#include "impact/roles.hpp"
#include "impact/watch/contact_frame.hpp"
#include "impact/watch/dents.hpp"
#include "impact/watch/follow_touches.hpp"
#include "impact/watch/indentation.hpp"
#include "impact/watch/ledger.hpp"
#include "impact/watch/surfaces.hpp"
#include "impact/watch/turned_over.hpp"
#include "integrate/kept_energy.hpp"

namespace ricochet {

// The ledger is taken at every so many looks, and at the end.
inline constexpr int looks_between_ledgers = 4;

// The bound of the highest frequency is taken anew every so many looks, each of which costs about a force evaluation.
// It lies 1.10 to 1.15 times above the frequency itself, so an impact is surely unstable only above that slack; what is
// unstable below it, its energy tells.
inline constexpr int looks_between_bounds = 16;
inline constexpr double bound_slack = 1.15;

// Bodies that move apart slower than this share of the impact's speed when its time is over: more time would not part
// them.
inline constexpr double at_rest_share = 1e-3;

template <int W>
class Watch {
 public:
  explicit Watch(State<W>& state) : state_(state) {
    for (const Solid* solid : state.solids) {
      if (solid->free > 0) lightest_ = std::min(lightest_, solid->mass.lightest());
      outlines_.emplace_back(*solid);
    }
    surface_gap_ = mean_cell(*state.solids[role::projectile]);
  }

  Run& run(int lane) { return runs_[at(lane)]; }
  const Run& run(int lane) const { return runs_[at(lane)]; }
  bool idle(int lane) const { return run(lane).scene == nullptr; }

  /// A run begins in a lane, whose state is that at the end of step 0. Throws FieldError if contact shows already.
  void begin(int lane, const Scene& scene, std::size_t index, const Start& start) {
    Run& now = run(lane);
    now = Run{};
    now.scene = &scene;
    now.index = index;
    now.start = start;
    now.threshold = touch_share * start.energy;
    const EndRule& rule = scene.ending;
    now.clocks.assign(state_.contacts.size(), TouchClock(least_load(start, state_.solids), rule.force, start.step));
    if (rule.at == "time") now.end_time = rule.time;
    const Placement &projectile = start.bodies[role::projectile], &target = start.bodies[role::target];
    now.approach = {0, in_plane(projectile.centre - target.centre), in_plane(projectile.velocity - target.velocity)};
    const RigidMotions<W> motions = rigid_motions(state_.bodies);
    const Energies<W> energies(state_, state_.bodies, motions);
    if (energies.contact(lane) > now.threshold) refuse_contact(scene);
    for (std::size_t kind = 0; kind < effect_kinds; ++kind) now.effects_before.push_back(energies.effect(kind, lane));
    now.before = energies.ledger(lane, now.effects_before);
    now.energy_before = now.before.total();
    now.projectile_radius = reach_from_centre(*state_.solids[role::projectile], -upwards());
    now.target_radius = reach_from_centre(*state_.solids[role::target], upwards());
    for (const std::size_t b : {role::projectile, role::target}) now.frame.round[b] = outlines_[b].round();
    now.reference_height = start.overlap_height;
  }

  void clear(int lane) { run(lane) = Run{}; }

  /// After a step of every lane.
  void count_step() {
    for (int lane = 0; lane < W; ++lane) {
      Run& now = run(lane);
      if (!now.scene || state_.broken[at(lane)]) continue;
      ++now.steps;
      now.due_now = std::exchange(now.due, Due{});
      follow_touches(state_, lane, now);
      if (now.time() + 1.5 * now.start.step > now.end_time) now.due.end = true;
    }
  }

  /// Whether a lane asks to be looked at after the next step.
  bool due() const {
    return std::any_of(runs_.begin(), runs_.end(), [](const Run& run) { return run.due.any(); });
  }

  struct Ended {
    int lane;
    Outcome outcome;
  };
  /// Looks at every lane, the state's `end` being that of the last step: those that have come to an end.
  std::vector<Ended> look() {
    Look now = look_at_end();
    take_interior_bounds();
    std::vector<Ended> ended;
    for (int lane = 0; lane < W; ++lane) {
      if (idle(lane)) continue;
      const std::optional<Ending> ending = follow(lane, now);
      if (ending) ended.push_back({lane, report(run(lane), *ending, state_.solids, last_facts(lane, now))});
    }
    return ended;
  }

  /// Looks at the lanes that asked for it before the last step: those that have come to an end.
  std::vector<Ended> look_closely() {
    Look now = look_at_end();
    std::vector<Ended> ended;
    for (int lane = 0; lane < W; ++lane) {
      const Due due = std::exchange(run(lane).due_now, Due{});
      if (idle(lane) || !due.any() || state_.broken[at(lane)]) continue;
      if (due.frame) take_frame(lane, now);
      if (due.parting)
        keep_first_parting(run(lane), at_parting(role::projectile, lane, now), at_parting(role::target, lane, now));
      if (const auto ending = over(lane, now))
        ended.push_back({lane, report(run(lane), *ending, state_.solids, last_facts(lane, now))});
    }
    return ended;
  }

 private:
  /// What is taken of all lanes at once, if one asks for it.
  struct Look {
    RigidMotions<W> motions;
    std::optional<Energies<W>> energies;
    std::optional<Lane<W>> inverted;
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  [[noreturn]] static void refuse_contact(const Scene& scene) {
    std::string warm;
    for (const Effect& effect : scene.effects)
      std::visit(
          [&]<class E>(const E&) {
            if constexpr (AtStart<E>) warm = E::name;
          },
          effect);
    if (warm.empty())
      throw FieldError("height",
                       "the repulsion of all nodes that stand near shows at the start; raise launch.height, or leave "
                       "it out");
    throw FieldError("effects", warm +
                                    ": the vibration reaches across the gap between the bodies at the start; lower its "
                                    "temperature or raise contact.reach");
  }

  Look look_at_end() {
    state_.contacts.update(state_.end);
    return {rigid_motions(state_.end), {}, {}};
  }

  void take_frame(int lane, const Look& now) {
    std::array<const SmoothOutline*, 2> outline;
    std::array<Pose, 2> pose;
    for (const std::size_t b : {role::projectile, role::target}) {
      outline[b] = &outlines_[b];
      pose[b] = pose_of(state_.end[b], lane, in_plane(fact(now.motions[b].centre, lane)));
    }
    add_to_frame(state_.contacts.pairs()[role::aimed_pair], lane, state_.end, outline, pose, run(lane));
  }

  const Energies<W>& energies(Look& now) {
    return now.energies ? *now.energies : now.energies.emplace(state_, state_.end, now.motions);
  }
  const Lane<W>& inverted(Look& now) {
    if (now.inverted) return *now.inverted;
    Lane<W> share = Lane<W>::Zero();
    for (const Motion<W>& body : state_.end)
      if (body.solid->free > 0) share = share.max(inverted_share(body));
    return now.inverted.emplace(share);
  }

  // Every lane at its own sixteenth looks, so that its neighbours do not change what it sees.
  void take_interior_bounds() {
    const auto due = [](const Run& run) { return run.scene && run.looks % looks_between_bounds == 0; };
    if (std::any_of(runs_.begin(), runs_.end(), due)) {
      for (Run& run : runs_)
        if (due(run)) run.interior_bound = 0;
      for (std::size_t b = 0; b < state_.end.size(); ++b) {
        const SquaredBounds<W> bounds = interior_bounds(static_cast<int>(b));
        const double slower = slower_by(state_.method, b);
        for (std::size_t lane = 0; lane < W; ++lane) {
          const double omega2 = bounds.omega2[static_cast<int>(lane)] * (slower * slower);
          if (!due(runs_[lane]) || !(omega2 > runs_[lane].interior_bound)) continue;
          runs_[lane].interior_bound = omega2;
          runs_[lane].bound_node = {static_cast<int>(b), bounds.node[lane]};
        }
      }
    }
    for (Run& run : runs_) ++run.looks;
  }

  SquaredBounds<W> interior_bounds(int body) const {
    const Motion<W>& motion = state_.end[at(body)];
    if (state_.effects.empty()) return squared_frequency_bound(motion);
    return squared_frequency_bound(motion, [&](int s, const Lane<W>& x) { return state_.effects.rest(body, s, x); });
  }

  // Follows a lane; none: it goes on.
  std::optional<Ending> follow(int lane, Look& now) {
    Run& run = this->run(lane);
    if (const auto& node = state_.broken[at(lane)]) return ending::BrokenNode{*node, flowed(state_, run)};
    if (const auto turned = turned_over(state_, lane)) return *turned;
    if (run.clock().touching()) take_frame(lane, now);
    if (!run.clock().touched()) keep_approach(lane, now);
    const bool parted = separated(lane, now), late = run.time() >= run.start.time_limit;
    if (parted || late || run.looks % looks_between_ledgers == 0)
      if (auto ending = keep_ledger(lane, now)) return ending;
    if (auto ending = keep_stable(lane)) return ending;
    if (run.clock().touched()) {
      if (auto ending = keep_outside(lane)) return ending;
      indent(lane, now);
    } else if (parted && state_.effects.empty()) {
      if (auto ending = flew_through(run)) return ending;
    }
    if (auto ending = over(lane, now)) return ending;
    if (parted && !run.clock().touched()) return ending::PassedBy{};
    if (parted && run.end_time == never) return ending::Finished{};
    if (late) return ending::NotParted{rests(lane, now)};
    return std::nullopt;
  }

  // What the scene says of its end, beside parting for good.
  std::optional<Ending> over(int lane, Look& now) {
    const Run& run = this->run(lane);
    const EndRule& rule = run.scene->ending;
    const bool in_time = run.time() + run.start.step / 2 >= run.end_time;
    const bool first = rule.at == "first_parting" && run.first_parting && !run.clock().touching() &&
                       (std::isnan(rule.gap) || gap_between(state_.end, lane) >= rule.gap);
    if (!in_time && !first) return std::nullopt;
    if (auto ending = keep_ledger(lane, now)) return ending;
    if (!run.clock().touched()) return ending::NotTouched{};
    return ending::Finished{run.clock().touching()};
  }

  void keep_approach(int lane, const Look& now) {
    const RigidMotion<W>&p = now.motions[role::projectile], &t = now.motions[role::target];
    run(lane).approach = {run(lane).time(), in_plane(fact(p.centre, lane) - fact(t.centre, lane)),
                          in_plane(fact(p.velocity, lane) - fact(t.velocity, lane))};
  }

  std::optional<Ending> keep_ledger(int lane, Look& now) {
    Run& run = this->run(lane);
    const double total = energies(now).ledger(lane, run.effects_before).total();
    if (!std::isfinite(total)) return ending::EnergyBeyondNumbers{};
    run.inverted = std::max(run.inverted, inverted(now)[lane]);
    if (run.inverted > folded_share && std::isnan(run.inversion_time)) run.inversion_time = run.time();
    run.drift = std::max(run.drift, std::abs(total - run.energy_before) / run.energy_before);
    const double tolerance = run.scene->integration.energy_tolerance;
    if (!(run.drift > tolerance)) return std::nullopt;
    const int order = state_.effects.empty() ? state_.method.order : 2;
    return ending::EnergyDrift{std::pow(tolerance / (2 * run.drift), 1.0 / order)};
  }

  // Contact stiffens the nodes that it pushes; K <= 2 blockdiag(K_ii) holds for it as for a spring.
  std::optional<Ending> keep_stable(int lane) {
    Run& run = this->run(lane);
    std::vector<double> on_body(state_.solids.size(), 0.0);
    double stiffest = -1;
    BodyNode node;
    state_.contacts.take_stiffest(lane, [&](const Pair<W>& pair, double stiffness) {
      for (int side : {0, 1}) on_body[at(pair.body(side))] += stiffness;
      if (stiffness > stiffest) node = pair.stiffest_node(lane);
      stiffest = std::max(stiffest, stiffness);
    });
    const double contact_bound = 2 * *std::max_element(on_body.begin(), on_body.end());
    const double omega = std::sqrt(run.interior_bound + contact_bound);
    run.theta_most = std::max(run.theta_most, run.start.step * omega);
    if (!(run.start.step * omega > bound_slack * state_.method.stability_limit)) return std::nullopt;
    // It may rise further: to what it is if one node holds all energy in its contact, but hardly so far.
    const double highest =
        std::sqrt(run.interior_bound + 2 * std::pow(run.start.contact.xi, 2) * run.energy_before / lightest_);
    return ending::Unstable{omega, std::max(2 * omega, std::sqrt(omega * highest)),
                            contact_bound > run.interior_bound ? node : run.bound_node};
  }

  std::optional<Ending> keep_outside(int lane) {
    Run& run = this->run(lane);
    const ExponentialRepulsion& law = run.start.contact;
    const double deepest = std::isnan(law.deepest) ? surface_gap_ : law.deepest;
    const Surfaces surfaces = surfaces_at(state_.end, lane);
    for (std::size_t p = 0; p < run.clocks.size(); ++p) {
      if (!run.clocks[p].touched()) continue;
      const Pair<W>& pair = state_.contacts.pairs()[p];
      run.penetration =
          std::max(run.penetration, deepest_inside(surfaces[at(pair.body(0))], surfaces[at(pair.body(1))]));
    }
    const auto intruder =
        inside_one_another(surfaces[role::projectile], surfaces[role::target], law.two_sided(), deepest);
    if (!intruder) return std::nullopt;
    const std::size_t whose = intruder->side == 0 ? role::projectile : role::target;
    const int other = static_cast<int>(intruder->side == 0 ? role::target : role::projectile);
    const int node = surface_nodes(state_.solids[whose]->surface)[intruder->place];
    return ending::Tunnelled{
        {static_cast<int>(whose), node}, other, whose == role::target && !law.two_sided(), intruder->depth};
  }

  // How far the projectile has come, and its contact where that is farthest.
  void indent(int lane, const Look& now) {
    Run& run = this->run(lane);
    const RigidMotion<W>&p = now.motions[role::projectile], &t = now.motions[role::target];
    const double overlap = run.reference_height - (normal(fact(p.centre, lane)) - normal(fact(t.centre, lane)));
    if (run.indentation.seen && !(overlap > run.indentation.depth)) return;
    measure_contact(state_.contacts.pairs()[role::aimed_pair], lane, state_.end, tangential(fact(p.centre, lane)),
                    overlap, run);
  }

  std::optional<Ending> flew_through(const Run& run) const {
    if (std::holds_alternative<Plane>(state_.solids[role::target]->surface)) return std::nullopt;  // nothing passes it
    const double touch = std::log(run.start.contact.V0 / run.threshold) / run.start.contact.xi;
    const double enough = std::max(touch / 2, 1e-4 * run.projectile_radius);
    const double least = closest_approach(run.start, state_.solids, enough);
    if (least > enough) return std::nullopt;
    return ending::FlewThrough{least, touch};
  }

  bool rests(int lane, const Look& now) const {
    const Vec3 apart =
        fact(now.motions[role::projectile].velocity, lane) - fact(now.motions[role::target].velocity, lane);
    const double launched = in_plane(seen_by_target(run(lane).start).velocity).norm();
    return std::hypot(tangential(apart), normal(apart)) < at_rest_share * launched;
  }

  // Parted for good: no node within reach of a cell (or the gap that the scene wants), and clear of each other. An
  // asperity that touched before the main contact does not end the impact: the surfaces are not clear yet.
  bool separated(int lane, const Look& now) const {
    const double gap = run(lane).scene->ending.gap;
    if (std::isnan(gap) ? !state_.contacts.pairs()[role::aimed_pair].apart(lane, state_.end)
                        : gap_between(state_.end, lane) < gap)
      return false;
    const RigidMotion<W>&p = now.motions[role::projectile], &t = now.motions[role::target];
    const RelativeFlight flight{in_plane(fact(p.centre, lane)), in_plane(fact(t.centre, lane)),
                                in_plane(fact(p.velocity, lane) - fact(t.velocity, lane)), about(fact(p.turning, lane)),
                                about(fact(t.turning, lane))};
    const Surfaces surfaces = surfaces_at(state_.end, lane);
    return clear_for_good(surfaces[role::projectile], surfaces[role::target], flight);
  }

  static Vec3 fact(const Space<W>& of_lanes, int lane) {
    return {of_lanes.at[0][lane], of_lanes.at[1][lane], of_lanes.at[2][lane]};
  }

  static Flying flying(std::size_t body, int lane, const Look& now) {
    return {fact(now.motions[body].velocity, lane), fact(now.motions[body].spin, lane)};
  }

  // Velocities after the impact are those at parting: what acts on meanwhile would make them those of some later
  // moment.
  Flying at_parting(std::size_t body, int lane, const Look& now) const {
    const Run& run = this->run(lane);
    const Flying last = flying(body, lane, now);
    const bool parted = run.clock().touched() && !run.clock().touching() && run.end_time == never;
    if (state_.effects.empty() || !parted || state_.solids[body]->anchored()) return last;
    return state_.effects.at_parting(static_cast<int>(body), last, run.time() - run.clock().end());
  }

  LastFacts last_facts(int lane, Look& now) {
    const Run& run = this->run(lane);
    const ActingEffects<W>& effects = state_.effects;
    LastFacts facts;
    facts.ledger = energies(now).ledger(lane, run.effects_before);
    for (std::size_t b = 0; b < state_.end.size(); ++b) {
      if (effects.empty())
        facts.ledger.bodies[b].vibration +=
            kept_beyond(state_.method, state_.h, b == MultirateRoles{}.slow, state_.end[b])[lane];
      facts.bodies.push_back(at_parting(b, lane, now));
      facts.now.push_back(flying(b, lane, now));
    }
    if (effects.empty()) return facts;
    const auto counts = effects.counts(lane);
    facts.effect_count.assign(counts.begin(), counts.end());
    facts.plastic_strain_most = effects.flows().most_strain(lane);
    if (effects.flows().any()) facts.dents = dents(run, now.motions, state_.end, lane);
    facts.effect_energy.assign(effect_kinds, Outcome::undefined);
    for (const Effect& effect : run.scene->effects)
      facts.effect_energy[effect.index()] =
          energies(now).effect(effect.index(), lane) - run.effects_before[effect.index()];
    return facts;
  }

  State<W>& state_;
  double lightest_ = std::numeric_limits<double>::infinity();  // of the masses that move [m0]
  std::vector<SmoothOutline> outlines_;                        // [body]
  double surface_gap_ = 0;  // the mean distance of neighbours in the projectile's surface [R]
  std::array<Run, W> runs_{};
};

}  // namespace ricochet
