#pragma once
// The effects that a batch of scenes names, at work in W lanes: forces, what is taken beside the steps, and the energy booked for each.

#include <array>
#include <cmath>
#include <vector>

#include "force/catalogue.hpp"

namespace ricochet {

template <int W>
class ActingEffects {
  template <int V>
  friend class ActingEffects;

 public:
  using Bodies = std::array<Moving<W>, 2>;
  /// Of each kind of effect, in the order of the catalogue. [m0 c^2]
  using Energies = std::array<Lane<W>, effect_kinds>;

  ActingEffects(const std::vector<Effect>& effects, const Lattice& projectile, const Lattice& target) : effects_(effects) {
    lost_.fill(Lane<W>::Zero());
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

  /// True if something depends on velocities: `dissipate` is then called before and after every step.
  bool split() const { return split_; }

  /// An impact with steps of h begins in a lane.
  void begin(int lane, double h) {
    for (Lane<W>& lost : lost_) lost[lane] = 0;
    for (int body : {0, 1})
      for (std::size_t i = 0; i < kept_[body].size(); ++i) kept_[body][i][lane] = std::exp(-total_rate(body, i) * h / 2);
  }

  /// Takes over an impact from a lane of another width.
  template <int V>
  void take(int lane, const ActingEffects<V>& from, int from_lane) {
    for (std::size_t kind = 0; kind < effect_kinds; ++kind) lost_[kind][lane] = from.lost_[kind][from_lane];
    for (int body : {0, 1})
      for (std::size_t i = 0; i < kept_[body].size(); ++i) kept_[body][i][lane] = from.kept_[body][i][from_lane];
  }

  /// Forces of conservative effects on a body's nodes.
  void add_forces(int body, Moving<W>& moving) const {
    for (const Effect& effect : effects_)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (Conservative<E>) e.add_forces(body, moving);
          },
          effect);
  }

  /// Half a step h of everything that depends on velocities, places held. `forward` and backward are each other's mirror.
  void dissipate(Bodies& bodies, const Lane<W>& half, bool forward) {
    if (forward) damp_nodes(bodies);
    for (std::size_t k = 0; k < effects_.size(); ++k) {
      const Effect& effect = effects_[forward ? k : effects_.size() - 1 - k];
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (SpringDamping<E>)
              for (int body : {0, 1}) lost_[effect.index()] += e.damp(body, bodies[body], half, forward);
          },
          effect);
    }
    if (!forward) damp_nodes(bodies);
  }

  /// Potential energies of the conservative effects, energies lost to the others since the impact began.
  Energies energies(const Bodies& bodies) const {
    Energies energies = lost_;
    for (const Effect& effect : effects_)
      std::visit(
          [&]<class E>(const E& e) {
            if constexpr (Conservative<E>)
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
        vx *= kept, vy *= kept;
      }
    }
  }

  std::vector<Effect> effects_;
  bool split_ = false;
  std::array<std::vector<Rates>, 2> rates_;        // [body]
  std::array<std::vector<Lane<W>>, 2> kept_;       // [body][free node] share of a velocity that is left after half a step
  Energies lost_;
};

}  // namespace ricochet
