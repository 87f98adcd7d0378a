#pragma once
// The effects that a batch of scenes names, at work in W lanes: forces, what is taken beside the steps, and the energy
// booked for each.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/turn.hpp"
#include "force/catalogue.hpp"
#include "impact/outcome.hpp"
#include "lattice/vibration.hpp"

namespace ricochet {

template <int W>
class ActingEffects {
  template <int V>
  friend class ActingEffects;

 public:
  static constexpr bool catalogue = true;
  using Bodies = std::array<Moving<W>, 2>;
  /// Of each kind of effect, in the order of the catalogue. [m0 c^2]
  using Energies = std::array<Lane<W>, effect_kinds>;

  ActingEffects(const std::vector<Effect>& effects, const Lattice& projectile, const Lattice& target)
      : effects_(effects) {
    lost_.fill(Lane<W>::Zero());
    for (const Effect& effect : effects_)
      std::visit(
          [&]<class E>(const E& e) {
            memory_.emplace_back();
            if constexpr (SpringChange<E>)
              for (int body : {0, 1})
                if (acts_on(e.on, body))
                  memory_.back()[body].assign((body == 0 ? projectile : target).spring.size(),
                                              {Lane<W>::Zero(), Lane<W>::Zero()});
            if constexpr (AnchorMotion<E>) shakes_ = true;
          },
          effect);
    for (int body : {0, 1}) {
      const Lattice& lattice = body == 0 ? projectile : target;
      for (const Effect& effect : effects_)
        std::visit(
            [&]<class E>(const E& e) {
              if constexpr (NodeDamping<E>) rates_[body].push_back({effect.index(), e.rates(body, lattice)});
            },
            effect);
      if (!rates_[body].empty()) kept_[body].assign(static_cast<std::size_t>(lattice.free), Lane<W>::Ones());
    }
    for (const Effect& effect : effects_) split_ = split_ || is_split(effect);
  }

  bool empty() const { return effects_.empty(); }

  /// A velocity and spin that a body has a time after it parted from the other, taken back to that moment: dv/dt = fall
  /// - decay v, domega/dt = -decay omega.
  struct Flying {
    Vec2 velocity;
    double spin;
  };
  Flying at_parting(int body, const Flying& later, double time) const {
    Vec2 fall = Vec2::Zero();
    double decay = 0;
    for (const Effect& effect : effects_)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (requires { e.fall(body); }) fall += e.fall(body);
            if constexpr (requires { e.decay(body); }) decay += e.decay(body);
          },
          effect);
    const double growth = std::exp(decay * time), way = decay > 0 ? std::expm1(decay * time) / decay : time;
    return {growth * later.velocity - way * fall, growth * later.spin};
  }

  /// True if something depends on velocities: `dissipate` is then called before and after every step.
  bool split() const { return split_; }

  /// True if anchors move.
  bool shakes() const { return shakes_; }

  /// An impact with steps of h begins in a lane: `own` are its scene's effects, which may differ from the batch's in
  /// what OwnNumbers names.
  void begin(int lane, double h, const std::vector<Effect>& own, Bodies& bodies, double angle) {
    for (Lane<W>& lost : lost_) lost[lane] = 0;
    for (int body : {0, 1})
      for (std::size_t i = 0; i < kept_[body].size(); ++i)
        kept_[body][i][lane] = std::exp(-total_rate(body, i) * h / 2);
    for (auto& of_bodies : memory_)
      for (auto& springs : of_bodies)
        for (SpringMemory<W>& m : springs) m[0][lane] = m[1][lane] = 0;
    time_[lane] = 0;
    if (const MovingAnchor* shaken = find_effect<MovingAnchor>(own)) {
      own_motion_[lane] = *shaken;
      place_anchors(lane, bodies[1]);
      for (int i = 0; i < bodies[1].lattice->free; ++i) {
        bodies[1].position.add(i, lane, shaken->displacement(0));
        bodies[1].velocity.add(i, lane, shaken->velocity(0));
      }
    }
    for (const Effect& effect : own)
      if (const Thermal* warm = std::get_if<Thermal>(&effect)) start_warm(lane, *warm, bodies, angle);
  }

  /// Takes over an impact from a lane of another width.
  template <int V>
  void take(int lane, const ActingEffects<V>& from, int from_lane) {
    for (std::size_t kind = 0; kind < effect_kinds; ++kind) lost_[kind][lane] = from.lost_[kind][from_lane];
    for (int body : {0, 1})
      for (std::size_t i = 0; i < kept_[body].size(); ++i) kept_[body][i][lane] = from.kept_[body][i][from_lane];
    for (std::size_t k = 0; k < memory_.size(); ++k)
      for (int body : {0, 1})
        for (std::size_t s = 0; s < memory_[k][body].size(); ++s)
          for (std::size_t n : {0, 1}) memory_[k][body][s][n][lane] = from.memory_[k][body][s][n][from_lane];
    time_[lane] = from.time_[from_lane];
    own_motion_[lane] = from.own_motion_[from_lane];
  }

  /// Forces of effects on a body's nodes; what springs remember changes with the places that they are evaluated at.
  void add_forces(int body, Moving<W>& moving) {
    for (std::size_t k = 0; k < effects_.size(); ++k)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (NodeForce<E>) e.add_forces(body, moving);
            if constexpr (SpringChange<E>)
              if (!memory_[k][body].empty())
                lost_[effects_[k].index()] += add_changed_forces(e, moving, memory_[k][body]);
          },
          effects_[k]);
  }

  /// Before an evaluation, if anchors move: what is pushed and pulled on them in it alone is wanted.
  void release_anchors(Moving<W>& target) const {
    for (int i = target.lattice->free; i < target.lattice->nodes(); ++i) {
      target.force.x(i).setZero();
      target.force.y(i).setZero();
    }
  }

  /// After an evaluation and its kick, if anchors move: books the work on them. (After dissipation `force` holds
  /// impulses and `kick` is 1.)
  void book_anchors(const Moving<W>& target, const Lane<W>& kick) {
    Lane<W>& given = lost_[Effect(MovingAnchor{}).index()];
    for (int i = target.lattice->free; i < target.lattice->nodes(); ++i)
      given += kick * (target.force.x(i) * target.velocity.x(i) + target.force.y(i) * target.velocity.y(i));
  }

  /// Moves the anchors on in time.
  void drift_anchors(Moving<W>& target, const Lane<W>& by) {
    time_ += by;
    for (int lane = 0; lane < W; ++lane)
      if (own_motion_[lane]) place_anchors(lane, target);
  }

  /// Half a step h of everything that depends on velocities, places held. `forward` and backward are each other's
  /// mirror.
  void dissipate(Bodies& bodies, const Lane<W>& half, bool forward) {
    if (shakes_) release_anchors(bodies[1]);
    if (forward) damp_nodes(bodies);
    for (std::size_t k = 0; k < effects_.size(); ++k) {
      const Effect& effect = effects_[forward ? k : effects_.size() - 1 - k];
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (SpringDamping<E>)
              for (int body : {0, 1}) {
                const auto* broken = broken_in(body);
                const auto damp = [&](auto&& whole) {
                  lost_[effect.index()] += e.damp(body, bodies[body], half, forward, whole);
                };
                if (broken)
                  damp([&](int s) -> Lane<W> { return 1.0 - (*broken)[static_cast<std::size_t>(s)][0]; });
                else
                  damp([](int) { return 1.0; });
              }
          },
          effect);
    }
    if (shakes_) book_anchors(bodies[1], Lane<W>::Ones());
    if (forward) return;
    damp_nodes(bodies);
    for (std::size_t k = 0; k < effects_.size(); ++k)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (SpringChange<E>)
              if constexpr (E::changes_at_step_ends)
                for (int body : {0, 1})
                  if (!memory_[k][body].empty())
                    lost_[effects_[k].index()] += change_springs(e, bodies[body], memory_[k][body]);
          },
          effects_[k]);
  }

  /// True if springs of a body remember.
  bool changes_springs(int body) const {
    return std::any_of(memory_.begin(), memory_.end(), [&](const auto& of_bodies) { return !of_bodies[body].empty(); });
  }

  /// What is left of spring s of a body at a stretch.
  SpringRest<Lane<W>> rest(int body, int s, const Lane<W>& stretch) const {
    for (std::size_t k = 0; k < effects_.size(); ++k)
      if (!memory_[k][body].empty())
        return std::visit(
            [&]<class E>(const E& e) -> SpringRest<Lane<W>> {
              if constexpr (SpringChange<E>)
                return e.rest(stretch, memory_[k][body][static_cast<std::size_t>(s)]);
              else
                return {stretch, Lane<W>::Ones()};
            },
            effects_[k]);
    return {stretch, Lane<W>::Ones()};
  }

  /// By how much the energy of a body's springs differs from spring_energy. [m0 c^2]
  Lane<W> spring_change(int body, const Moving<W>& moving) const {
    Lane<W> sum = Lane<W>::Zero();
    for (std::size_t k = 0; k < effects_.size(); ++k)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (SpringChange<E>)
              if (!memory_[k][body].empty()) sum += spring_energy_change(e, moving, memory_[k][body]);
          },
          effects_[k]);
    return sum;
  }

  /// How many springs of a lane an effect of springs has changed, by kind; NaN for other kinds.
  std::array<double, effect_kinds> counts(int lane) const {
    std::array<double, effect_kinds> counts;
    counts.fill(Outcome::undefined);
    for (std::size_t k = 0; k < effects_.size(); ++k)
      std::visit(
          [&]<class E>(const E&) {
            if constexpr (SpringChange<E>) {
              double& count = counts[effects_[k].index()];
              if (std::isnan(count)) count = 0;
              for (const auto& springs : memory_[k])
                for (const SpringMemory<W>& m : springs) count += E::counted(m)[lane];
            }
          },
          effects_[k]);
    return counts;
  }

  /// Potential energies of forces on nodes, energies lost to the others since the impact began.
  Energies energies(const Bodies& bodies) const {
    Energies energies = lost_;
    for (const Effect& effect : effects_)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (NodeForce<E>)
              for (int body : {0, 1}) energies[effect.index()] += e.energy(body, bodies[body]);
          },
          effect);
    return energies;
  }

 private:
  struct Rates {
    std::size_t kind;
    std::vector<double> rate;  // [free node]
  };

  double total_rate(int body, std::size_t node) const {
    double sum = 0;
    for (const Rates& r : rates_[body]) sum += r.rate[node];
    return sum;
  }

  // v -> v exp(-rate h/2); what is lost is booked in proportion to the rates.
  void damp_nodes(Bodies& bodies) {
    for (int body : {0, 1}) {
      Moving<W>& moving = bodies[body];
      for (std::size_t i = 0; i < kept_[body].size(); ++i) {
        const double rate = total_rate(body, i);
        if (rate == 0) continue;
        const Lane<W>& kept = kept_[body][i];
        Lane<W>&vx = moving.velocity.x(static_cast<int>(i)), &vy = moving.velocity.y(static_cast<int>(i));
        const Lane<W> lost = (0.5 * moving.lattice->mass) * (vx * vx + vy * vy) * (1.0 - kept * kept);
        for (const Rates& r : rates_[body]) lost_[r.kind] += (r.rate[i] / rate) * lost;
        vx *= kept;
        vy *= kept;
      }
    }
  }

  const std::vector<SpringMemory<W>>* broken_in(int body) const {
    for (std::size_t k = 0; k < effects_.size(); ++k)
      if (std::holds_alternative<Breaking>(effects_[k]) && !memory_[k][body].empty()) return &memory_[k][body];
    return nullptr;
  }

  void place_anchors(int lane, Moving<W>& target) {
    const Vec2 a = own_motion_[lane]->displacement(time_[lane]), v = own_motion_[lane]->velocity(time_[lane]);
    for (int i = target.lattice->free; i < target.lattice->nodes(); ++i) {
      target.position.set(i, lane, target.lattice->points[i] + a);
      target.velocity.set(i, lane, v);
    }
  }

  // The linearised lattice holds while no spring is stretched by a large part of its length.
  static void check_small(const Lattice& lattice, const Points& displacement, double temperature) {
    const auto moved = [&](int i) {
      return i < lattice.free ? displacement[static_cast<std::size_t>(i)] : Vec2(Vec2::Zero());
    };
    for (int i = 0; i < lattice.free; ++i)
      for (int s = lattice.first[i]; s < lattice.first[i + 1]; ++s) {
        const double share = (moved(lattice.spring[s].other) - moved(i)).norm() / lattice.spring[s].length;
        if (share > 0.5)
          throw FieldError("effects",
                           fmt::format("thermal: at a temperature of {:g} m0 c^2 a spring's ends move by {:.2g} of its "
                                       "length, and the vibration is drawn for small motions; lower the temperature",
                                       temperature, share));
      }
  }

  void start_warm(int lane, const Thermal& warm, Bodies& bodies, double angle) {
    for (int body : {0, 1}) {
      if (!acts_on(warm.on, body)) continue;
      Moving<W>& moving = bodies[body];
      if (!vibrations_[body]) vibrations_[body] = std::make_shared<Vibrations>(*moving.lattice);
      const Vibrations::Sample sample =
          vibrations_[body]->draw(warm.temperature, moving.stiffness[lane], warm.seed, body);
      const double c = std::cos(body == 0 ? angle : 0.0), s = std::sin(body == 0 ? angle : 0.0);
      check_small(*moving.lattice, sample.displacement, warm.temperature);
      for (int i = 0; i < moving.lattice->free; ++i) {
        moving.position.add(i, lane, turned(sample.displacement[i], c, s));
        moving.velocity.add(i, lane, turned(sample.velocity[i], c, s));
      }
    }
  }

  std::vector<Effect> effects_;
  bool split_ = false, shakes_ = false;
  std::vector<std::array<std::vector<SpringMemory<W>>, 2>>
      memory_;  // [effect][body][spring]; empty for effects that have none
  std::array<std::optional<MovingAnchor>, W> own_motion_;
  Lane<W> time_ = Lane<W>::Zero();                               // since the impact began, where the places are
  std::array<std::shared_ptr<const Vibrations>, 2> vibrations_;  // [body] factorised when first wanted
  std::array<std::vector<Rates>, 2> rates_;                      // [body]
  std::array<std::vector<Lane<W>>, 2> kept_;  // [body][free node] share of a velocity that is left after half a step
  Energies lost_;
};

}  // namespace ricochet
