#pragma once
// W impacts that share their lattices, advancing together: the state, one step, and the look at every lane between
// steps.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "force/contact/contact.hpp"
#include "force/springs.hpp"
#include "impact/acting_effects.hpp"
#include "impact/batch.hpp"
#include "impact/endings.hpp"
#include "impact/followed.hpp"
#include "impact/inversion.hpp"
#include "impact/kept_energy.hpp"
#include "impact/launch.hpp"
#include "impact/multirate.hpp"
#include "impact/rigid_motion.hpp"
#include "integrate/compose.hpp"
#include "integrate/step_limit.hpp"
#include "lattice/outline.hpp"

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
inline constexpr double at_rest = 1e-3;

/// `Effects` is ActingEffects but in the benchmark that shows what it costs a scene without effects.
template <int W, class Effects = ActingEffects<W>>
class Engine {
  template <int V, class OtherEffects>
  friend class Engine;

 public:
  using Bodies = std::array<Moving<W>, 2>;  ///< projectile, target

  Engine(const Lattice& projectile, const Lattice& target, const Method& method, const std::vector<Effect>& effects)
      : body_{Moving<W>{&projectile}, Moving<W>{&target}},
        method_(method),
        multirate_(projectile, target),
        contact_(projectile, target, find_effect<Adhesion>(effects), find_effect<Friction>(effects)),
        effects_(effects, projectile, target) {
    for (int b : {0, 1}) {
      Moving<W>& body = body_[b];
      for (NodeVectors<W>* values : {&body.position, &body.velocity, &body.force, &displacement_[b]})
        values->resize(body.lattice->nodes());
      for (int i = 0; i < body.lattice->nodes(); ++i)  // idle lanes rest
        for (int lane = 0; lane < W; ++lane) body.position.set(i, lane, body.lattice->points[i]);
    }
    end_ = body_;
    const std::vector<int>& nodes = projectile.rim;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      rim_gap_ =
          std::max(rim_gap_, (projectile.points[nodes[k]] - projectile.points[nodes[(k + 1) % nodes.size()]]).norm());
  }

  const Run& run(int lane) const { return runs_[lane]; }
  bool idle(int lane) const { return runs_[lane].scene == nullptr; }

  /// Puts a scene into a lane. Returns the outcome at once if it never touches.
  std::optional<Outcome> begin(int lane, const Scene& scene, std::size_t index) {
    Run run;
    run.scene = &scene;
    run.index = index;
    run.start = launch(scene, *body_[0].lattice, *body_[1].lattice);
    if (!run.start.touches) {
      Outcome outcome;
      outcome.status = Status::no_contact;
      outcome.reason = "the projectile passes by the target";
      return outcome;
    }
    runs_[lane] = run;
    Run& now = runs_[lane];
    place(lane, now.start, scene);
    // The ledger before: the state is still at the end of step 0.
    const Motions motions = motions_of(body_);
    const Energies energies = energies_of(body_, motions);
    if (energies.contact[lane] > touch_share * run.start.energy)
      throw FieldError("effects",
                       "thermal: the vibration reaches across the gap between the bodies at the start; lower its "
                       "temperature or raise contact.reach");
    for (std::size_t kind = 0; kind < effect_kinds; ++kind) now.effects_before[kind] = energies.effects[kind][lane];
    now.before = ledger(lane, motions, energies);
    now.energy_before = now.before.total();
    now.projectile_radius = support(body_[0].lattice->smooth_rim, Vec2(0, -1)) + body_[0].lattice->centre().y();
    now.target_radius = support(body_[1].lattice->smooth_rim, Vec2(0, 1)) - body_[1].lattice->centre().y();
    now.reference_height = run.start.overlap_height;
    threshold_[lane] = touch_share * run.start.energy;
    Lane<W> alone = Lane<W>::Zero();  // a step of 0 leaves the other lanes as they are, bit for bit
    alone[lane] = h_[lane];
    for (int b : {0, 1}) {  // what a snapshot sees before the first step
      end_[b].stiffness[lane] = body_[b].stiffness[lane];
      for (int i = 0; i < body_[b].lattice->nodes(); ++i) {
        end_[b].position.set(i, lane, body_[b].position.at(i, lane));
        end_[b].velocity.set(i, lane, body_[b].velocity.at(i, lane));
      }
    }
    if (!effects_.split()) get_ahead(method_, alone, Mover{*this, body_});
    return std::nullopt;
  }

  void spend(int lane, double seconds) { runs_[lane].seconds += seconds; }

  /// Takes over an impact from a lane of another engine, between two steps.
  template <int V>
  void take(int lane, const Engine<V>& from, int from_lane) {
    const auto copy = [&](const Moving<V>& old, Moving<W>& body) {
      for (int i = 0; i < body.lattice->nodes(); ++i) {
        body.position.set(i, lane, old.position.at(i, from_lane));
        body.velocity.set(i, lane, old.velocity.at(i, from_lane));
        body.force.set(i, lane, Vec2::Zero());  // as after every kick
      }
      body.stiffness[lane] = old.stiffness[from_lane];
    };
    for (int b : {0, 1}) copy(from.body_[b], body_[b]);
    runs_[lane] = from.runs_[from_lane];
    h_[lane] = from.h_[from_lane];
    threshold_[lane] = from.threshold_[from_lane];
    contact_energy_[lane] = from.contact_energy_[from_lane];
    contact_.set(lane, &runs_[lane].start.contact);
    contact_.take(lane, from.contact_, from_lane);
    effects_.take(lane, from.effects_, from_lane);
  }

  void clear(int lane) {
    runs_[lane] = Run{};
    h_[lane] = 0;
    contact_.set(lane, nullptr);
  }

  /// `seen`: a look or a snapshot follows.
  [[gnu::noinline]] void advance_one_step(bool seen = true) {
    passing_end_ = seen && method_.multirate();
    const Mover mover{*this, body_};
    const Lane<W> contact_before = contact_energy_;
    if (effects_.split()) {
      // What depends on velocities is split off the step, half before and half after it; both find the ends of steps.
      effects_.dissipate(body_, h_ / 2, true);
      get_ahead(method_, h_, mover);
      step(method_, h_, mover);
      fall_back(body_);
      effects_.dissipate(body_, h_ / 2, false);
    } else {
      step(method_, h_, mover);
    }
    passing_end_ = false;
    for (int lane = 0; lane < W; ++lane) {
      Run& run = runs_[lane];
      if (!run.scene || run.broken) continue;
      ++run.steps;
      const bool touching = contact_energy_[lane] > threshold_[lane];
      if (touching && !run.touching && run.touches++ == 0) run.first_touch = run.time();
      if (touching) run.last_touch = run.time();
      // The energy of a contact that ends falls as an exponential: where within the step it passed the threshold, so
      // that effects that act on do not shift what is read by a step. (Verlet, which they go with, evaluates in the
      // middle of its steps.)
      else if (run.touching && effects_.split())
        run.last_touch =
            run.time() - run.start.step * (0.5 + std::log(threshold_[lane] / contact_energy_[lane]) /
                                                     std::log(contact_before[lane] / contact_energy_[lane]));
      run.touching = touching;
    }
  }

  /// Looks at every lane; calls `ended(lane, outcome)` for those that have come to an end.
  template <class Ended>
  void look(Ended&& ended) {
    go_to_step_end();
    contact_.update(end_[0].position, end_[1].position);
    const Motions motions = motions_of(end_);
    take_spring_bounds();
    std::optional<Energies> taken;
    const auto energies = [&]() -> const Energies& {
      return taken ? *taken : taken.emplace(energies_of(end_, motions));
    };
    std::optional<Lane<W>> shares;
    const auto inverted = [&]() -> const Lane<W>& {
      return shares ? *shares : shares.emplace(inverted_share(end_[0]).max(inverted_share(end_[1])));
    };
    for (int lane = 0; lane < W; ++lane) {
      if (!runs_[lane].scene) continue;
      Outcome outcome;
      outcome.status = follow(lane, motions, energies, inverted, outcome.reason);
      if (outcome.status == Status::not_run) continue;
      write(lane, motions, energies(), outcome);
      ended(lane, outcome);
    }
  }

  Snapshot snapshot(int lane) {
    go_to_step_end();
    const Motions motions = motions_of(end_);
    Snapshot shot;
    shot.time = runs_[lane].time();
    shot.step = runs_[lane].steps;
    shot.energy = ledger(lane, motions, energies_of(end_, motions));
    Bodies pushed = end_;
    contact_.add_forces_to_copies(lane, pushed[0], pushed[1]);
    for (int i = 0; i < body_[0].lattice->nodes(); ++i) shot.projectile_force.push_back(pushed[0].force.at(i, lane));
    for (int i = 0; i < body_[1].lattice->nodes(); ++i) shot.target_force.push_back(pushed[1].force.at(i, lane));
    for (int i = 0; i < body_[0].lattice->nodes(); ++i) {
      shot.projectile.push_back(end_[0].position.at(i, lane));
      shot.projectile_velocity.push_back(end_[0].velocity.at(i, lane));
    }
    for (int i = 0; i < body_[1].lattice->nodes(); ++i) {
      shot.target.push_back(end_[1].position.at(i, lane));
      shot.target_velocity.push_back(end_[1].velocity.at(i, lane));
    }
    for (int b : {0, 1})
      if (effects_.changes_springs(b))
        each_spring(end_[b], [&](const auto&, int, int s, const Spring& spring, const Lane<W>&, const Lane<W>&,
                                 const Lane<W>& r) {
          const SpringRest<Lane<W>> rest = effects_.rest(b, s, Lane<W>(r - spring.length));
          shot.springs[static_cast<std::size_t>(b)].push_back({rest.elastic[lane], rest.share[lane]});
        });
    return shot;
  }

  /// Test hook: both bodies where the run is, which most methods leave ahead of a step's end.
  Bodies& state() { return body_; }
  /// Test hook: changes the bodies at the end of the last step by `change(bodies)`, in every lane.
  template <class Change>
  void change(Change&& change) {
    go_to_step_end();
    change(end_);
    for (int b : {0, 1}) {
      body_[b].position = end_[b].position;
      body_[b].velocity = end_[b].velocity;
    }
    if (!effects_.split()) get_ahead(method_, h_, Mover{*this, body_});
  }

  const Method& method() const { return method_; }
  int steps_between_looks() const { return std::max(1, evaluations_between_looks / method_.evaluations()); }

 private:
  struct Rates {
    NodeVectors<W> velocity, acceleration;
  };

  /// The two bodies as compose.hpp moves them.
  struct Mover {
    Engine& engine;
    Bodies& bodies;

    void kick_and_drift(const Lane<W>& kick, const Lane<W>& drift) const {
      const bool shakes = engine.effects_.shakes();
      if (shakes) engine.effects_.release_anchors(bodies[1]);
      engine.contact_energy_ = engine.contact_.add_forces(bodies[0], bodies[1]);
      if (!engine.effects_.empty())
        for (int b : {0, 1}) engine.effects_.add_forces(b, bodies[b]);
      for (Moving<W>& body : bodies) ricochet::kick_and_drift(body, Lane<W>(kick / body.lattice->mass), drift);
      engine.find_broken(bodies);
      if (shakes) {
        engine.effects_.book_anchors(bodies[1], kick);
        engine.effects_.drift_anchors(bodies[1], drift);
      }
    }
    void drift(const Lane<W>& by) const {
      for (Moving<W>& body : bodies)
        for (int i = 0; i < body.lattice->free; ++i) {
          body.position.x(i) += by * body.velocity.x(i);
          body.position.y(i) += by * body.velocity.y(i);
        }
      if (engine.effects_.shakes()) engine.effects_.drift_anchors(bodies[1], by);
    }
    // A kick of displacements that were 0, and a drift with them for a unit of time.
    void displace(const Lane<W>& by) const {
      const auto swap = [&] {
        for (int b : {0, 1}) std::swap(bodies[b].velocity, engine.displacement_[b]);
      };
      swap();
      kick_and_drift(by, Lane<W>::Ones());
      swap();
    }
    void put_back() const {
      for (int b : {0, 1})
        for (int i = 0; i < bodies[b].lattice->free; ++i)
          ricochet::put_back(bodies[b].position, engine.displacement_[b], i);
    }

    Displaceable<W, Contact<W, Effects::catalogue>> displaceable() const {
      return {bodies, engine.displacement_, engine.contact_};
    }
    void displace_fast(const Lane<W>& by) const {
      engine.contact_energy_ = engine.multirate_.displace(displaceable(), by);
      engine.find_broken(bodies);
    }
    void put_back_fast() const { engine.multirate_.put_back(displaceable()); }
    void fast(const Lane<W>& kick, const Lane<W>& drift) const {
      engine.contact_energy_ = engine.multirate_.kick(displaceable(), kick, drift);
      engine.find_broken(bodies);
    }
    // A step ends in the middle of the slow kick, where no drift is under way.
    void displace_slow(const Lane<W>& kick, const Lane<W>& gradient, double mixed) const {
      if (engine.passing_end_) engine.copy_to_end();
      engine.multirate_.displace_slow(displaceable(), kick, gradient, mixed);
      engine.find_broken(bodies);
    }
    void slow(const Lane<W>& kick, const Lane<W>& drift, const Lane<W>& outer_drift) const {
      engine.multirate_.kick_slow(displaceable(), kick, drift, outer_drift);
      engine.find_broken(bodies);
      if (!engine.passing_end_) return;
      for (int b : {0, 1})
        for (int i = 0; i < bodies[b].lattice->free; ++i) {
          NodeVectors<W>& half_kicked = engine.end_[b].velocity;
          half_kicked.x(i) = 0.5 * (half_kicked.x(i) + bodies[b].velocity.x(i));
          half_kicked.y(i) = 0.5 * (half_kicked.y(i) + bodies[b].velocity.y(i));
        }
    }

    void remember() const { engine.remembered_ = bodies; }
    // Through a kick of velocities that were 0, for a unit of time.
    void evaluate(std::size_t stage) const {
      if (engine.rates_.size() <= stage) engine.rates_.resize(stage + 1);
      for (int b : {0, 1}) {
        engine.rates_[stage][b].velocity = bodies[b].velocity;
        bodies[b].velocity.resize(bodies[b].lattice->nodes());  // to zero
      }
      kick_and_drift(Lane<W>::Ones(), Lane<W>::Zero());
      for (int b : {0, 1}) engine.rates_[stage][b].acceleration = bodies[b].velocity;
    }
    void combine(const Lane<W>& h, const std::vector<double>& weights) const {
      for (int b : {0, 1}) {
        Moving<W>& body = bodies[b];
        body.position = engine.remembered_[b].position;
        body.velocity = engine.remembered_[b].velocity;
        for (std::size_t stage = 0; stage < weights.size(); ++stage) {
          if (weights[stage] == 0) continue;
          const Lane<W> by = weights[stage] * h;
          const Rates& rates = engine.rates_[stage][b];
          for (int i = 0; i < body.lattice->free; ++i) {
            body.position.x(i) += by * rates.velocity.x(i);
            body.position.y(i) += by * rates.velocity.y(i);
            body.velocity.x(i) += by * rates.acceleration.x(i);
            body.velocity.y(i) += by * rates.acceleration.y(i);
          }
        }
      }
    }
  };

  struct Motions {
    RigidMotion<W> projectile, target;
  };
  struct Energies {
    Lane<W> projectile, target, contact;  // of vibration, of contact
    typename Effects::Energies effects;
  };

  void place(int lane, const Start& start, const Scene& scene) {
    const Lattice &p = *body_[0].lattice, &t = *body_[1].lattice;
    const Vec2 centre = p.centre();
    const Points points = posed(p.points, centre, start.pose);
    for (int i = 0; i < p.nodes(); ++i) {
      body_[0].position.set(i, lane, points[i]);
      body_[0].velocity.set(i, lane, start.velocity + start.spin * perpendicular(points[i] - start.pose.centre));
      body_[0].force.set(i, lane, Vec2::Zero());
    }
    for (int i = 0; i < t.nodes(); ++i) {
      body_[1].position.set(i, lane, t.points[i]);
      body_[1].velocity.set(i, lane, Vec2::Zero());
      body_[1].force.set(i, lane, Vec2::Zero());
    }
    body_[0].stiffness[lane] = scene.projectile->numbers.stiffness;
    body_[1].stiffness[lane] = scene.target->numbers.stiffness;
    h_[lane] = start.step;
    contact_.set(lane, &start.contact);
    effects_.begin(lane, start.step, scene.effects, body_, start.pose.angle);
  }

  void copy_to_end() {
    for (int b : {0, 1})  // forces are 0 in both
    {
      end_[b].position = body_[b].position;
      end_[b].velocity = body_[b].velocity;
      end_[b].stiffness = body_[b].stiffness;
    }
  }

  // The state at the end of the last step, in end_. A multirate method has left it there when it passed.
  void go_to_step_end() {
    if (method_.multirate()) return;
    copy_to_end();
    if (!effects_.split()) fall_back(end_);
  }

  // Undoes what get_ahead had done.
  void fall_back(Bodies& bodies) {
    const Lane<W> back = -method_.ahead_drift * h_;
    for (Moving<W>& body : bodies)
      for (int i = 0; i < body.lattice->free; ++i) {
        body.position.x(i) += back * body.velocity.x(i);
        body.position.y(i) += back * body.velocity.y(i);
      }
    if (effects_.shakes()) effects_.drift_anchors(bodies[1], back);
    const Lane<W> contact_energy = contact_energy_;
    if (method_.ahead_kick != 0) Mover{*this, bodies}.kick_and_drift(-method_.ahead_kick * h_, Lane<W>::Zero());
    contact_energy_ = contact_energy;
  }

  static Motions motions_of(const Bodies& bodies) { return {rigid_motion(bodies[0]), rigid_motion(bodies[1])}; }

  Energies energies_of(const Bodies& bodies, const Motions& motions) {
    Energies e{vibration_energy(bodies[0], motions.projectile), vibration_energy(bodies[1], motions.target),
               contact_.energy(bodies[0].position, bodies[1].position), effects_.energies(bodies)};
    if (effects_.empty()) return e;
    e.projectile += effects_.spring_change(0, bodies[0]);
    e.target += effects_.spring_change(1, bodies[1]);
    const auto friction = contact_.friction_energies(bodies[0], bodies[1]);
    e.contact += friction.held;
    e.effects[Effect(Friction{}).index()] += friction.lost;
    e.effects[Effect(Adhesion{}).index()] += contact_.adhesion_energy(bodies[0].position, bodies[1].position);
    return e;
  }

  // Every lane at its own sixteenth looks, so that its neighbours do not change what it sees.
  void take_spring_bounds() {
    const auto due = [](const Run& run) { return run.scene && run.looks % looks_between_bounds == 0; };
    if (std::any_of(runs_.begin(), runs_.end(), due)) {
      const double slower = slower_by(method_);
      const auto bound_of = [&](int b) {
        if (effects_.empty()) return squared_frequency_bound(end_[b]);
        return squared_frequency_bound(end_[b], [&](int s, const Lane<W>& x) { return effects_.rest(b, s, x); });
      };
      std::array<SquaredBounds<W>, 2> bounds{bound_of(0), bound_of(1)};
      bounds[1].omega2 *= slower * slower;
      for (std::size_t lane = 0; lane < W; ++lane) {
        if (!due(runs_[lane])) continue;
        const int body = bounds[1].omega2[lane] > bounds[0].omega2[lane];
        runs_[lane].spring_bound = bounds[body].omega2[lane];
        runs_[lane].bound_node = {body, bounds[body].node[lane]};
      }
    }
    for (Run& run : runs_) ++run.looks;
  }

  Ledger ledger(int lane, const Motions& motions, const Energies& energies) const {
    const auto& [p, t] = motions;
    Ledger ledger{p.translation[lane], p.rotation[lane],      energies.projectile[lane], t.translation[lane],
                  t.rotation[lane],    energies.target[lane], energies.contact[lane]};
    for (std::size_t kind = 0; kind < effect_kinds; ++kind)
      ledger.effects += energies.effects[kind][lane] - runs_[lane].effects_before[kind];
    return ledger;
  }

  // Follows a lane; not_run means that it goes on. `energies()` and `inverted()`: those of the last step's end, taken
  // if they are asked for.
  template <class Taken, class Shares>
  Status follow(int lane, const Motions& motions, Taken&& energies, Shares&& inverted, std::string& reason) {
    Run& run = runs_[lane];
    if (run.broken) {
      reason = run.steps == 0 ? fmt::format(
                                    "{} was no longer finite at t = 0, in the first step: forces beyond every number; "
                                    "lower contact.V0, the bodies' stiffness or quartic, or the speed",
                                    described(run.broken_node))
                              : fmt::format(
                                    "{} was no longer finite at t = {:.6g}: the forces had outgrown the time step "
                                    "{:.3g} R/c; give a step half as long or a lower speed",
                                    described(run.broken_node), run.time(), run.start.step);
      return Status::not_finite;
    }
    const RigidMotion<W>&p = motions.projectile, &t = motions.target;
    const bool parted = separated(lane, p, t), late = run.time() >= run.start.time_limit;
    if (parted || late || run.looks % looks_between_ledgers == 0) {
      const double total = ledger(lane, motions, energies()).total();
      if (!std::isfinite(total)) {
        reason = fmt::format("the energy was beyond every number at t = {:.6g}; give a lower speed", run.time());
        return Status::not_finite;
      }
      run.inverted = std::max(run.inverted, inverted()[lane]);
      if (run.inverted > folded_share && std::isnan(run.inversion_time)) run.inversion_time = run.time();
      run.drift = std::max(run.drift, std::abs(total - run.energy_before) / run.energy_before);
      if (run.drift > run.scene->integration.energy_tolerance) {
        const double shorter = std::pow(run.scene->integration.energy_tolerance / (2 * run.drift),
                                        1.0 / (effects_.empty() ? method_.order : 2));
        reason = fmt::format(
            "the total energy had strayed by {:.3g} at t = {:.6g} with the time step {:.3g} R/c; give a step of {:.2g} "
            "or less",
            run.drift, run.time(), run.start.step, std::clamp(shorter, 0.125, 0.5) * run.start.step);
        return Status::energy_drift;
      }
    }
    // Contact stiffens the node it pushes; K <= 2 blockdiag(K_ii) holds for it as for a spring.
    const double lightest = std::min(body_[0].lattice->mass, body_[1].lattice->mass);
    const double contact_bound = 2 * contact_.take_stiffest(lane) / lightest;
    const double omega = std::sqrt(run.spring_bound + contact_bound);
    run.theta_most = std::max(run.theta_most, run.start.step * omega);
    if (run.start.step * omega > bound_slack * method_.stability_limit) {
      // It may rise further: to what it is if one node holds all energy in its contact, but hardly so far.
      const double highest =
          std::sqrt(run.spring_bound + 2 * std::pow(run.scene->contact.xi, 2) * run.energy_before / lightest);
      const double expected = std::max(2 * omega, std::sqrt(omega * highest));
      reason = fmt::format(
          "at t = {:.6g} the frequency bound had risen to {:.4g} c/R at {}, where {} is unstable with the time step "
          "{:.3g} R/c; give a step of {:.3g}",
          run.time(), omega,
          described(contact_bound > run.spring_bound ? contact_.stiffest_node(lane) : run.bound_node), method_.name,
          run.start.step, method_.usual / expected);
      return Status::unstable;
    }
    if (run.touches > 0)
      if (const auto intruder =
              inside_one_another(rim(0, lane), rim(1, lane), run.scene->contact.two_sided(), rim_gap_)) {
        const BodyNode node{intruder->body, body_[intruder->body].lattice->rim[intruder->place]};
        const bool unpushed = intruder->body == 1 && !run.scene->contact.two_sided();
        reason = fmt::format(
            "at t = {:.6g} {} was {}inside the {}{}", run.time(), described(node),
            unpushed ? fmt::format("{:.2g} R ", intruder->depth) : "", intruder->body == 0 ? "target" : "projectile",
            unpushed ? ": the one-sided contact pushes projectile nodes only; set contact = { sides = \"two\" }"
                     : "; raise contact.V0, lower the speed, or take a smaller step");
        return Status::tunnelled;
      }
    const double overlap = run.reference_height - (p.y[lane] - t.y[lane]);
    if (run.touches > 0 && (!run.indented || overlap > run.indentation)) measure_contact(lane, p.x[lane], overlap);
    if (parted && run.touches == 0 && effects_.empty()) {
      const double touch = std::log(run.start.contact.V0 / threshold_[lane]) / run.start.contact.xi;
      const double enough = std::max(touch / 2, 1e-4 * run.projectile_radius),
                   least = closest_approach(run.start, *body_[0].lattice, *body_[1].lattice, enough);
      if (least <= enough) {
        reason = fmt::format(
            "the projectile flew through the target and no repulsion was seen: it came within {:.2g} R of it; {}",
            least,
            touch > 0 ? fmt::format("give a step below {:.2g}", run.start.step / 4)
                      : "raise contact.V0 or lower the speed");
        return Status::tunnelled;
      }
    }
    if (parted) return run.touches > 0 ? Status::finished : no_contact(reason);
    if (late) {
      const bool rests =
          std::hypot(p.vx[lane] - t.vx[lane], p.vy[lane] - t.vy[lane]) < at_rest * run.start.velocity.norm();
      reason = fmt::format("the bodies had not parted after {:.6g} R/c; {}", run.time(),
                           rests ? "they move as one and may never part: leave out, or lower, what holds or slows them"
                                 : "raise time_limit");
      return Status::out_of_time;
    }
    return Status::not_run;
  }

  static std::string described(const BodyNode& node) {
    return fmt::format("node {} of the {}", node.node, node.body == 0 ? "projectile" : "target");
  }

  // Looks for lanes that have just broken.
  void find_broken(const Bodies& bodies) {
    const Lane<W> pulse = bodies[0].pulse + bodies[1].pulse;
    if ((pulse - pulse == 0).all()) return;
    for (int lane = 0; lane < W; ++lane) {
      Run& run = runs_[lane];
      if (!run.scene || run.broken || std::isfinite(pulse[lane])) continue;
      run.broken = true;
      run.broken_node = where_it_broke(bodies, lane);
    }
  }

  static Status no_contact(std::string& reason) {
    reason = "the projectile passes by the target";
    return Status::no_contact;
  }

  // Parted for good: no pair within reach, and clear of each other. An asperity that touched before the main contact
  // does not end the impact: the rims are not clear yet.
  bool separated(int lane, const RigidMotion<W>& p, const RigidMotion<W>& t) const {
    const Flight flight{Vec2(p.x[lane], p.y[lane]), Vec2(t.x[lane], t.y[lane]),
                        Vec2(p.vx[lane] - t.vx[lane], p.vy[lane] - t.vy[lane]), p.omega[lane]};
    return contact_.apart(lane, end_[0].position, end_[1].position) &&
           clear_for_good(rim(0, lane), rim(1, lane), flight);
  }

  // The rim of a body at the end of the last step.
  Points rim(int body, int lane) const {
    Points points;
    for (const int i : end_[body].lattice->rim) points.push_back(end_[body].position.at(i, lane));
    return points;
  }

  void measure_contact(int lane, double centre, double overlap) {
    Run& run = runs_[lane];
    std::vector<Push> pushes;
    double strongest = 0;
    contact_.each(lane, end_[0].position, end_[1].position, [&](const auto& push) {
      const int node = push.direction == 0 ? push.node : push.along < 0.5 ? push.from : push.to;
      pushes.push_back({end_[0].position.at(node, lane), push.force.norm()});
      strongest = std::max(strongest, pushes.back().force);
    });
    if (strongest * run.start.contact.reach < touch_share * run.start.energy) return;  // between two touches
    run.indentation = overlap;
    run.indented = true;
    const auto [a, b] = ends_of(pushes, strongest);
    run.contact_length = b.x() - a.x();
    run.centre_offset = std::abs(centre - a.x());
    run.tan_alpha = run.contact_length > 0 ? (b.y() - a.y()) / run.contact_length : Outcome::undefined;
  }

  void write(int lane, const Motions& motions, const Energies& energies, Outcome& o) const {
    const RigidMotion<W>&p = motions.projectile, &t = motions.target;
    const Run& run = runs_[lane];
    o.before = run.before;
    o.after = ledger(lane, motions, energies);
    if (effects_.empty()) {
      o.after.projectile_vibration += kept_beyond(method_, h_, 0, end_[0])[lane];
      o.after.target_vibration += kept_beyond(method_, h_, 1, end_[1])[lane];
    }
    for (const Effect& effect : run.scene->effects)
      o.effect_energy[effect.index()] = energies.effects[effect.index()][lane] - run.effects_before[effect.index()];
    o.effect_count = effects_.counts(lane);
    o.energy_closure = std::abs(o.after.total() - run.energy_before) / run.energy_before;
    o.energy_drift = run.drift;
    o.inverted = run.inverted;
    o.inversion_time = run.inversion_time;
    o.certified = run.start.certified;
    o.time = run.time();
    o.step = run.start.step;
    o.theta = run.start.theta;
    o.theta_most = run.theta_most;
    o.steps = static_cast<double>(run.steps);
    o.touches = run.touches;
    o.contact_time = run.touches > 0 ? run.last_touch - run.first_touch : 0.0;
    o.indentation = run.indented ? run.indentation : Outcome::undefined;
    o.contact_length = run.contact_length;
    o.centre_offset = run.centre_offset;
    o.tan_alpha = run.tan_alpha;

    // Velocities after the impact are those at parting: what acts on meanwhile would make them those of some later
    // moment.
    typename Effects::Flying after{Vec2(p.vx[lane], p.vy[lane]), p.spin[lane]},
        target_after{Vec2(t.vx[lane], t.vy[lane]), t.spin[lane]};
    if (!effects_.empty() && run.touches > 0) after = effects_.at_parting(0, after, run.time() - run.last_touch);
    if (!effects_.empty() && run.touches > 0 && !body_[1].lattice->anchored())
      target_after = effects_.at_parting(1, target_after, run.time() - run.last_touch);
    const Vec2 v = run.start.velocity, w = after.velocity - target_after.velocity;
    const double R = run.projectile_radius, omega = after.spin;
    // v_c = v - R omega x n with omega x n = (-omega, 0); the target's own surface moves too if it is free and spins.
    const Vec2 vc(v.x() + R * run.start.spin, v.y());
    const Vec2 wc(w.x() + R * omega + run.target_radius * target_after.spin, w.y());
    o.vn = w.y();
    o.vt = w.x();
    o.omega = omega;
    o.e = -w.y() / v.y();
    o.psi1 = vc.x() / -vc.y();
    o.psi2 = wc.x() / -vc.y();
    o.beta = vc.x() != 0 ? -wc.x() / vc.x() : Outcome::undefined;
    // J acts on the projectile: its own change of momentum.
    const double mass = body_[0].lattice->total_mass();
    const Vec2 impulse = mass * (after.velocity - v);
    o.impulse_n = impulse.y();
    o.impulse_t = impulse.x();
    o.mu = std::abs(impulse.x()) / impulse.y();
    if (!body_[1].lattice->anchored())
      o.momentum_residual =
          (mass * (after.velocity - v) + body_[1].lattice->total_mass() * target_after.velocity).norm() /
          (mass * v.norm());
    o.error_estimate = run.scene->error_estimate;
    if (std::isfinite(o.tan_alpha)) {
      const Vec2 n_alpha(-o.tan_alpha, 1);  // its length cancels
      o.e_alpha = -wc.dot(n_alpha) / vc.dot(n_alpha);
    }
  }

  Bodies body_, end_;                           // where the run is; at the end of a step
  std::array<NodeVectors<W>, 2> displacement_;  // of a force-gradient kick; 0 between kicks
  Bodies remembered_;                           // of a Runge-Kutta step: its beginning
  std::vector<std::array<Rates, 2>> rates_;     // [stage]
  const Method& method_;
  Multirate<W> multirate_;
  Contact<W, Effects::catalogue> contact_;
  Effects effects_;
  bool passing_end_ = false;  // a multirate method leaves the step's end in end_ when it passes
  double rim_gap_ = 0;        // the longest distance of neighbours in the projectile's rim [R]
  std::array<Run, W> runs_{};
  Lane<W> h_ = Lane<W>::Zero(), contact_energy_ = Lane<W>::Zero(), threshold_ = Lane<W>::Zero();
};

}  // namespace ricochet
