#pragma once
// The effects that a batch of scenes names, at work in W lanes: forces, what is taken beside the steps, and the energy
// booked for each.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "body/vibration.hpp"
#include "contact/contacts.hpp"
#include "core/carrier.hpp"
#include "core/turn.hpp"
#include "effect/catalogue.hpp"
#include "effect/edges.hpp"
#include "effect/flows.hpp"
#include "effect/start/small_motions.hpp"

namespace ricochet {

/// A velocity and spin that a body has a time after it parted.
struct Flying {
  Vec3 velocity, spin;
};

template <int W>
class ActingEffects {
 public:
  /// Of each kind of effect, in the order of the catalogue. [m0 c^2]
  using Energies = std::array<Lane<W>, effect_kinds>;

  ActingEffects(const std::vector<Effect>& effects, const std::vector<const Solid*>& solids)
      : rates_(solids.size()),
        kept_(solids.size()),
        vibrations_(solids.size()),
        flows_(solids.size()),
        edges_(solids.size()) {
    lost_.fill(Lane<W>::Zero());
    for (const Effect& effect : effects) {
      acting_.push_back({effect, bodies_of(effect, static_cast<int>(solids.size())), {}});
      std::visit([&](const auto& e) { prepare(e, acting_.back(), solids); }, effect);
      split_ = split_ || is_split(effect);
    }
    for (std::size_t b = 0; b < solids.size(); ++b)
      if (!rates_[b].empty()) kept_[b].assign(static_cast<std::size_t>(solids[b]->free), Lane<W>::Ones());
  }

  bool empty() const { return acting_.empty(); }

  /// The same body at the moment when it parted: dv/dt = fall - decay v, domega/dt = -decay omega.
  Flying at_parting(int body, const Flying& later, double time) const {
    Vec3 fall = Vec3::Zero();
    double decay = 0;
    for (const Acting& acting : acting_)
      if (acting.on(body))
        std::visit(
            [&]<class E>(const E& e) {
              if constexpr (requires { e.fall(); }) fall += e.fall();
              if constexpr (requires { e.decay(); }) decay += e.decay();
            },
            acting.effect);
    const double growth = std::exp(decay * time), way = decay > 0 ? std::expm1(decay * time) / decay : time;
    return {growth * later.velocity - way * fall, growth * later.spin};
  }

  /// True if something depends on velocities: `dissipate` is then called before and after every step.
  bool split() const { return split_; }

  /// What elements that yield remember; State lets bodies know theirs.
  const Flows<W>& flows() const { return flows_; }

  /// True if anchors move.
  bool shakes() const { return shaken_ >= 0; }

  /// An impact with steps of h begins in a lane: `own` are its scene's effects, which may differ from the batch's in
  /// what OwnNumbers names. `turns`: by how much each body was turned from its place at rest.
  void begin(int lane, double h, const std::vector<Effect>& own, Motions<W>& bodies, const std::vector<Turn>& turns) {
    for (Lane<W>& lost : lost_) lost[lane] = 0;
    for (std::size_t b = 0; b < kept_.size(); ++b)
      for (std::size_t i = 0; i < kept_[b].size(); ++i) kept_[b][i][lane] = std::exp(-total_rate(b, i) * h / 2);
    for (Acting& acting : acting_)
      for (auto& springs : acting.memory)
        for (SpringMemory<W>& m : springs) m[0][lane] = m[1][lane] = 0;
    flows_.begin(lane);
    edges_.begin(lane, h / 2, bodies);
    time_[lane] = 0;
    for (const Effect& effect : own)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (AnchorMotion<E>) start_shaken(lane, e, bodies[at(shaken_)]);
          },
          effect);
    for (const Effect& effect : own)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (AtStart<E>)
              for (const int b : bodies_of(effect, static_cast<int>(bodies.size())))
                start_warm(lane, e, b, bodies[at(b)], turns[at(b)]);
          },
          effect);
  }

  /// Passes on what is remembered of an impact.
  void carry(int lane, Carrier& carrier) {
    for (Lane<W>& lost : lost_) carrier.pass(lost[lane]);
    for (auto& nodes : kept_)
      for (Lane<W>& kept : nodes) carrier.pass(kept[lane]);
    for (Acting& acting : acting_)
      for (auto& springs : acting.memory)
        for (SpringMemory<W>& m : springs)
          for (Lane<W>& number : m) carrier.pass(number[lane]);
    flows_.carry(lane, carrier);
    edges_.carry(lane, carrier);
    carrier.pass(time_[lane]);
  }
  /// How the anchors of an impact move, which is passed on as it is.
  const std::optional<AnchorCourse>& anchor_course(int lane) const { return course_[at(lane)]; }
  void set_anchor_course(int lane, const std::optional<AnchorCourse>& course) { course_[at(lane)] = course; }

  /// Forces of effects on the bodies; what springs remember changes with the places that they are evaluated at.
  void add_forces(Motions<W>& bodies) {
    for (Acting& acting : acting_)
      std::visit(
          [&]<class E>(const E& e) {
            for (const int b : acting.bodies) {
              Motion<W>& body = bodies[at(b)];
              if constexpr (NodeForce<E>) e.add_forces(body);
              if constexpr (SpringChange<E>)
                if (!acting.memory[at(b)].empty())
                  lost(acting) += add_changed_forces<2>(e, body, *body.solid->springs(), acting.memory[at(b)]);
            }
          },
          acting.effect);
  }

  /// Before an evaluation, if anchors move: what is pushed and pulled on them in it alone is wanted.
  void release_anchors(Motions<W>& bodies) const {
    Motion<W>& body = bodies[at(shaken_)];
    for (int c = body.solid->free_coordinates(); c < body.solid->coordinates(); ++c) body.f[c].setZero();
  }

  /// After an evaluation and its kick, if anchors move: books the work on them. (After dissipation `f` holds impulses
  /// and `kick` is 1.)
  void book_anchors(const Motions<W>& bodies, const Lane<W>& kick) {
    const Motion<W>& body = bodies[at(shaken_)];
    const Place<W, 2>*force = body.f.template places<2>(), *velocity = body.v.template places<2>();
    for (int i = body.solid->free; i < body.solid->nodes(); ++i) lost_[shaking_] += kick * dot(force[i], velocity[i]);
  }

  /// Moves the anchors on in time.
  void drift_anchors(Motions<W>& bodies, const Lane<W>& by) {
    time_ += by;
    for (int lane = 0; lane < W; ++lane)
      if (course_[at(lane)]) place_anchors(lane, bodies[at(shaken_)]);
  }

  /// Half a step h of everything that depends on velocities, places held. `forward` and backward are each other's
  /// mirror.
  void dissipate(Motions<W>& bodies, const Lane<W>& half, bool forward) {
    if (shakes()) release_anchors(bodies);
    if (forward) damp_nodes(bodies);
    for (std::size_t k = 0; k < acting_.size(); ++k) {
      const Acting& acting = acting_[forward ? k : acting_.size() - 1 - k];
      std::visit([&](const auto& e) { damp_inside(e, acting, bodies, half, forward); }, acting.effect);
    }
    if (shakes()) book_anchors(bodies, Lane<W>::Ones());
    if (forward) return;
    damp_nodes(bodies);
    for (Acting& acting : acting_)
      std::visit([&](const auto& e) { change_at_step_end(e, acting, bodies); }, acting.effect);
  }

  /// True if springs of a body remember.
  bool changes_springs(int body) const {
    return std::any_of(acting_.begin(), acting_.end(), [&](const Acting& acting) { return acting.remembers(body); });
  }

  /// What is left of spring s of a body at a stretch.
  SpringRest<Lane<W>> rest(int body, int s, const Lane<W>& stretch) const {
    for (const Acting& acting : acting_)
      if (acting.remembers(body))
        return std::visit(
            [&]<class E>(const E& e) -> SpringRest<Lane<W>> {
              if constexpr (SpringChange<E>)
                return e.rest(stretch, acting.memory[at(body)][at(s)]);
              else
                return {stretch, Lane<W>::Ones()};
            },
            acting.effect);
    return {stretch, Lane<W>::Ones()};
  }

  /// By how much the energy of a body's springs differs from that of springs without a past. [m0 c^2]
  Lane<W> spring_change(int body, const Motion<W>& motion) const {
    Lane<W> sum = Lane<W>::Zero();
    for (const Acting& acting : acting_)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (SpringChange<E>)
              if (acting.remembers(body))
                sum += spring_energy_change<2>(e, motion, *motion.solid->springs(), acting.memory[at(body)]);
          },
          acting.effect);
    return sum;
  }

  /// How many springs or elements of a lane an effect of those has changed, by kind; NaN for other kinds.
  std::array<double, effect_kinds> counts(int lane) const {
    std::array<double, effect_kinds> counts;
    counts.fill(std::numeric_limits<double>::quiet_NaN());
    for (const Acting& acting : acting_)
      std::visit(
          [&]<class E>(const E&) {
            if constexpr (ElementFlow<E>) counts[acting.effect.index()] = flows_.count(lane);
            if constexpr (SpringChange<E>) {
              double& count = counts[acting.effect.index()];
              if (std::isnan(count)) count = 0;
              for (const auto& springs : acting.memory)
                for (const SpringMemory<W>& m : springs) count += E::counted(m)[lane];
            }
          },
          acting.effect);
    return counts;
  }

  /// Potential energies of forces on nodes and between surfaces, energies lost to the others since the impact began.
  /// `held`: what friction's springs hold of the contact's energy.
  Energies energies(const Motions<W>& bodies, const Contacts<W>& contacts, Lane<W>& held) const {
    Energies energies = lost_;
    std::size_t pair_forces = 0;
    for (const Acting& acting : acting_)
      std::visit(
          [&]<class E>(const E& e) {
            Lane<W>& energy = energies[acting.effect.index()];
            if constexpr (NodeForce<E>)
              for (const int b : acting.bodies) energy += e.energy(bodies[at(b)]);
            if constexpr (ElementFlow<E>) flows_.add_lost(acting.bodies, energy);
            if constexpr (PairForceEffect<E>) energy += contacts.energy_of(pair_forces++, bodies);
            if constexpr (PairMemory<E>) {
              const auto grip = contacts.grip_energies(bodies);
              held += grip.held;
              energy += grip.lost;
            }
          },
          acting.effect);
    return energies;
  }

 private:
  struct Acting {
    Effect effect;
    std::vector<int> bodies;
    std::vector<std::vector<SpringMemory<W>>> memory;  // [body][spring]; empty where it changes no springs

    bool on(int body) const { return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); }
    bool remembers(int body) const { return !memory.empty() && !memory[at(body)].empty(); }
  };
  struct Rates {
    std::size_t kind;
    std::vector<double> rate;  // [free node]
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  Lane<W>& lost(const Acting& acting) { return lost_[acting.effect.index()]; }

  template <class E>
  void prepare(const E& e, Acting& acting, const std::vector<const Solid*>& solids) {
    if constexpr (SpringChange<E>) acting.memory.resize(solids.size());
    for (const int b : acting.bodies) {
      const Solid& solid = *solids[at(b)];
      if constexpr (SpringChange<E>)
        if (const Springs* springs = solid.springs())
          acting.memory[at(b)].assign(springs->list.size(), {Lane<W>::Zero(), Lane<W>::Zero()});
      if constexpr (ElementFlow<E>)
        if (const Elements* elements = solid.elements()) flows_.let(at(b), *elements, e.yield, e.hardening);
      if constexpr (EdgeDamping<E>) edges_.let(at(b), e.dashpots(solid));
      if constexpr (NodeDamping<E>) rates_[at(b)].push_back({acting.effect.index(), e.rates(solid)});
      if constexpr (AnchorMotion<E>) {
        shaken_ = b;
        shaking_ = acting.effect.index();
      }
    }
  }

  double total_rate(std::size_t body, std::size_t node) const {
    double sum = 0;
    for (const Rates& r : rates_[body]) sum += r.rate[node];
    return sum;
  }

  // v -> v exp(-rate h/2); what is lost is booked in proportion to the rates.
  void damp_nodes(Motions<W>& bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      Place<W, 2>* velocity = bodies[b].v.template places<2>();
      for (std::size_t i = 0; i < kept_[b].size(); ++i) {
        const double rate = total_rate(b, i);
        if (rate == 0) continue;
        const Lane<W>& kept = kept_[b][i];
        const double mass = bodies[b].solid->mass[static_cast<int>(i)];
        const Lane<W> lost = (0.5 * mass) * dot(velocity[i], velocity[i]) * (1.0 - kept * kept);
        for (const Rates& r : rates_[b]) lost_[r.kind] += (r.rate[i] / rate) * lost;
        for (Lane<W>& v : velocity[i].at) v *= kept;
      }
    }
  }

  // The effect whose springs may be gone, on a body.
  const Acting* breaking(int body) const {
    for (const Acting& acting : acting_)
      if (acting.remembers(body) && std::visit(
                                        []<class E>(const E&) {
                                          return requires { E::breaks; };
                                        },
                                        acting.effect))
        return &acting;
    return nullptr;
  }

  template <class E>
  void damp_inside(const E& e, const Acting& acting, Motions<W>& bodies, const Lane<W>& half, bool forward) {
    if constexpr (EdgeDamping<E>)
      for (const int b : acting.bodies) lost(acting) += edges_.damp(bodies[at(b)], at(b));
    if constexpr (SpringDamping<E>)
      for (const int b : acting.bodies) {
        Motion<W>& body = bodies[at(b)];
        if constexpr (ElementDamping<E>)
          if (const Elements* elements = body.solid->elements()) lost(acting) += e.damp(body, *elements, half, forward);
        const Springs* springs = body.solid->springs();
        if (!springs) continue;
        const auto damp = [&](auto&& whole) { lost(acting) += e.damp(body, *springs, half, forward, whole); };
        if (breaking(b))
          damp([&](int s) { return rest(b, s, Lane<W>::Zero()).share; });
        else
          damp([](int) { return 1.0; });
      }
  }

  template <class E>
  void change_at_step_end(const E& e, Acting& acting, const Motions<W>& bodies) {
    if constexpr (SpringChange<E>)
      if constexpr (E::changes_at_step_ends)
        for (const int b : acting.bodies)
          if (acting.remembers(b)) {
            const Motion<W>& body = bodies[at(b)];
            lost(acting) += change_springs<2>(e, body, *body.solid->springs(), acting.memory[at(b)]);
          }
  }

  // The body starts displaced and moving as a whole.
  template <class E>
  void start_shaken(int lane, const E& e, Motion<W>& body) {
    course_[at(lane)] = AnchorCourse(e);
    place_anchors(lane, body);
    for (int i = 0; i < body.solid->free; ++i) {
      body.q.add(i, lane, e.displacement(0));
      body.v.add(i, lane, e.velocity(0));
    }
  }

  void place_anchors(int lane, Motion<W>& body) {
    const Vec2 a = course_[at(lane)]->displacement(time_[lane]), v = course_[at(lane)]->velocity(time_[lane]);
    for (int i = body.solid->free; i < body.solid->nodes(); ++i) {
      body.q.set(i, lane, body.solid->points[at(i)] + a);
      body.v.set(i, lane, v);
    }
  }

  template <class E>
  void start_warm(int lane, const E& warm, int b, Motion<W>& body, const Turn& turn) {
    const Solid& solid = *body.solid;
    if (!solid.springs() && !solid.elements()) return;
    if (!vibrations_[at(b)]) vibrations_[at(b)] = std::make_shared<Vibrations>(solid);
    const Vibrations::Sample sample = vibrations_[at(b)]->draw(warm.temperature, body.stiffness[lane], warm.seed, b);
    check_small_motions(solid, sample.displacement, warm.temperature);
    for (int i = 0; i < solid.free; ++i) {
      body.q.add(i, lane, turn(sample.displacement[at(i)]));
      body.v.add(i, lane, turn(sample.velocity[at(i)]));
    }
  }

  std::vector<Acting> acting_;
  bool split_ = false;
  int shaken_ = -1;          // the body whose anchors move
  std::size_t shaking_ = 0;  // the kind of effect that moves them
  std::array<std::optional<AnchorCourse>, W> course_;
  Lane<W> time_ = Lane<W>::Zero();          // since the impact began, where the places are
  std::vector<std::vector<Rates>> rates_;   // [body]
  std::vector<std::vector<Lane<W>>> kept_;  // [body][free node] share of a velocity that is left after half a step
  std::vector<std::shared_ptr<const Vibrations>> vibrations_;  // [body] factorised when first wanted
  Flows<W> flows_;
  Edges<W> edges_;
  Energies lost_;
};

}  // namespace ricochet
