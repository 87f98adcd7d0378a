#pragma once
// What looks at the lanes of a state between steps: the ledger, the frequency bounds, the endings.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "body/inversion.hpp"
#include "core/error.hpp"
#include "impact/launch/aim.hpp"
#include "impact/report.hpp"
#include "impact/roles.hpp"
#include "impact/watch/indentation.hpp"
#include "impact/watch/ledger.hpp"
#include "integrate/kept_energy.hpp"

namespace ricochet {

// The ledger is taken at every so many looks, and at the end.
inline constexpr int looks_between_ledgers = 4;

// The bound of the highest frequency is taken anew every so many looks, each of which costs about a force evaluation.
// It lies 1.10 to 1.15 times above the frequency itself, so an impact is surely unstable only above that slack; what is
// unstable below it, its energy tells.
inline constexpr int looks_between_bounds = 16;
inline constexpr double bound_slack = 1.15;

// A body has folded when more than this share of its area is turned over; slivers of a random lattice do so in any
// impact.
inline constexpr double folded_share = 0.01;

// Bodies that move apart slower than this share of the impact's speed when its time is over: more time would not part
// them.
inline constexpr double at_rest_share = 1e-3;

template <int W>
class Watch {
 public:
  explicit Watch(State<W>& state) : state_(state) {
    for (const Solid* solid : state.solids)
      if (solid->free > 0) lightest_ = std::min(lightest_, solid->mass.lightest());
    surface_gap_ = longest_cell(*state.solids[role::projectile]);
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
    now.touch.resize(state_.contacts.size());
    const RigidMotions<W> motions = rigid_motions(state_.bodies);
    const Energies<W> energies(state_, state_.bodies, motions);
    if (energies.contact(lane) > now.threshold) refuse_contact(scene);
    for (std::size_t kind = 0; kind < effect_kinds; ++kind) now.effects_before.push_back(energies.effect(kind, lane));
    now.before = energies.ledger(lane, now.effects_before);
    now.energy_before = now.before.total();
    now.projectile_radius = reach_from_centre(*state_.solids[role::projectile], -upwards());
    now.target_radius = reach_from_centre(*state_.solids[role::target], upwards());
    now.reference_height = start.overlap_height;
  }

  void clear(int lane) { run(lane) = Run{}; }

  /// After a step of every lane; the contacts' energies before it.
  void count_step(const std::vector<Lane<W>>& contact_before) {
    for (int lane = 0; lane < W; ++lane) {
      Run& now = run(lane);
      if (!now.scene || state_.broken[at(lane)]) continue;
      ++now.steps;
      for (std::size_t p = 0; p < now.touch.size(); ++p)
        count_touch(now, now.touch[p], contact_before[p][lane], state_.contact_energy[p][lane]);
    }
  }

  struct Ended {
    int lane;
    Outcome outcome;
  };
  /// Looks at every lane, the state's `end` being that of the last step: those that have come to an end.
  std::vector<Ended> look() {
    state_.contacts.update(state_.end);
    Look now{rigid_motions(state_.end), {}, {}};
    take_interior_bounds();
    std::vector<Ended> ended;
    for (int lane = 0; lane < W; ++lane) {
      if (idle(lane)) continue;
      const std::optional<Ending> ending = follow(lane, now);
      if (ending) ended.push_back({lane, report(run(lane), *ending, state_.solids, last_facts(lane, now))});
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

  static double reach_from_centre(const Solid& solid, const Vec2& direction) {
    return PlacedSurface(solid.surface, solid.smooth).support(direction) - direction.dot(solid.centre());
  }

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

  void count_touch(const Run& now, TouchRecord& touch, double energy_before, double energy) const {
    const bool touching = energy > now.threshold;
    if (touching && !touch.touching && touch.touches++ == 0) touch.first = now.time();
    if (touching) touch.last = now.time();
    // The energy of a contact that ends falls as an exponential: where within the step it passed the threshold, so that
    // effects that act on do not shift what is read by a step. (Verlet, which they go with, evaluates in the middle of
    // its steps.)
    else if (touch.touching && state_.effects.split())
      touch.last =
          now.time() - now.start.step * (0.5 + std::log(now.threshold / energy) / std::log(energy_before / energy));
    touch.touching = touching;
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
    if (const auto& node = state_.broken[at(lane)]) return ending::BrokenNode{*node};
    const bool parted = separated(lane, now), late = run.time() >= run.start.time_limit;
    if (parted || late || run.looks % looks_between_ledgers == 0)
      if (auto ending = keep_ledger(lane, now)) return ending;
    if (auto ending = keep_stable(lane)) return ending;
    const TouchRecord& touch = run.touch[role::aimed_pair];
    if (touch.touches > 0) {
      if (auto ending = keep_outside(lane)) return ending;
      indent(lane, now);
    } else if (parted && state_.effects.empty()) {
      if (auto ending = flew_through(run)) return ending;
    }
    if (parted && touch.touches > 0) return ending::Finished{};
    if (parted) return ending::PassedBy{};
    if (late) return ending::NotParted{rests(lane, now)};
    return std::nullopt;
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
    const double contact_bound = 2 * *std::max_element(on_body.begin(), on_body.end()) / lightest_;
    const double omega = std::sqrt(run.interior_bound + contact_bound);
    run.theta_most = std::max(run.theta_most, run.start.step * omega);
    if (!(run.start.step * omega > bound_slack * state_.method.stability_limit)) return std::nullopt;
    // It may rise further: to what it is if one node holds all energy in its contact, but hardly so far.
    const double highest =
        std::sqrt(run.interior_bound + 2 * std::pow(run.start.contact.xi, 2) * run.energy_before / lightest_);
    return ending::Unstable{omega, std::max(2 * omega, std::sqrt(omega * highest)),
                            contact_bound > run.interior_bound ? node : run.bound_node};
  }

  std::optional<Ending> keep_outside(int lane) const {
    const Run& run = this->run(lane);
    const bool two_sided = run.scene->contact.two_sided();
    const auto intruder =
        inside_one_another(surface(role::projectile, lane), surface(role::target, lane), two_sided, surface_gap_);
    if (!intruder) return std::nullopt;
    const std::size_t whose = intruder->side == 0 ? role::projectile : role::target;
    const int other = static_cast<int>(intruder->side == 0 ? role::target : role::projectile);
    const int node = surface_nodes(state_.solids[whose]->surface)[intruder->place];
    return ending::Tunnelled{
        {static_cast<int>(whose), node}, other, whose == role::target && !two_sided, intruder->depth};
  }

  // How far the projectile has come, and its contact where that is farthest.
  void indent(int lane, const Look& now) {
    Run& run = this->run(lane);
    const RigidMotion<W>&p = now.motions[role::projectile], &t = now.motions[role::target];
    const double height = normal(fact(p.centre, lane)) - normal(fact(t.centre, lane));
    const double overlap = run.reference_height - height;
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
    const Vec2 launched = in_plane(seen_by_target(run(lane).start).velocity);
    return std::hypot(tangential(apart), normal(apart)) < at_rest_share * launched.norm();
  }

  // Parted for good: no node within reach of a cell, and clear of each other. An asperity that touched before the main
  // contact does not end the impact: the surfaces are not clear yet.
  bool separated(int lane, const Look& now) const {
    if (!state_.contacts.pairs()[role::aimed_pair].apart(lane, state_.end)) return false;
    const RigidMotion<W>&p = now.motions[role::projectile], &t = now.motions[role::target];
    const RelativeFlight flight{in_plane(fact(p.centre, lane)), in_plane(fact(t.centre, lane)),
                                in_plane(fact(p.velocity, lane) - fact(t.velocity, lane)), about(fact(p.turning, lane)),
                                about(fact(t.turning, lane))};
    return clear_for_good(surface(role::projectile, lane), surface(role::target, lane), flight);
  }

  static Vec3 fact(const Space<W>& of_lanes, int lane) {
    return {of_lanes.at[0][lane], of_lanes.at[1][lane], of_lanes.at[2][lane]};
  }

  // The surface of a body at the end of the last step.
  PlacedSurface surface(std::size_t body, int lane) const {
    Points points;
    for (const int node : surface_nodes(state_.solids[body]->surface))
      points.push_back(state_.end[body].q.at(node, lane));
    return PlacedSurface(state_.solids[body]->surface, std::move(points));
  }

  // Velocities after the impact are those at parting: what acts on meanwhile would make them those of some later
  // moment.
  LastFacts last_facts(int lane, Look& now) {
    const Run& run = this->run(lane);
    const ActingEffects<W>& effects = state_.effects;
    const TouchRecord& touch = run.touch[role::aimed_pair];
    LastFacts facts;
    facts.ledger = energies(now).ledger(lane, run.effects_before);
    for (std::size_t b = 0; b < state_.end.size(); ++b) {
      if (effects.empty())
        facts.ledger.bodies[b].vibration +=
            kept_beyond(state_.method, state_.h, b == MultirateRoles{}.slow, state_.end[b])[lane];
      const Flying flying{fact(now.motions[b].velocity, lane), fact(now.motions[b].spin, lane)};
      const bool taken_back = !effects.empty() && touch.touches > 0 && !state_.solids[b]->anchored();
      facts.bodies.push_back(taken_back ? effects.at_parting(static_cast<int>(b), flying, run.time() - touch.last)
                                        : flying);
    }
    if (effects.empty()) return facts;
    const auto counts = effects.counts(lane);
    facts.effect_count.assign(counts.begin(), counts.end());
    facts.effect_energy.assign(effect_kinds, Outcome::undefined);
    for (const Effect& effect : run.scene->effects)
      facts.effect_energy[effect.index()] =
          energies(now).effect(effect.index(), lane) - run.effects_before[effect.index()];
    return facts;
  }

  State<W>& state_;
  double lightest_ = std::numeric_limits<double>::infinity();  // of the masses that move [m0]
  double surface_gap_ = 0;  // the longest distance of neighbours in the projectile's surface [R]
  std::array<Run, W> runs_{};
};

}  // namespace ricochet
