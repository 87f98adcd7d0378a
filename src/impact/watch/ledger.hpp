#pragma once
// Where the energy of a state is, in W lanes.

#include "body/rigid_motion.hpp"
#include "impact/state.hpp"
#include "impact/watch/run.hpp"

namespace ricochet {

template <int W>
using RigidMotions = std::vector<RigidMotion<W>>;

template <int W>
RigidMotions<W> rigid_motions(const Motions<W>& bodies) {
  RigidMotions<W> motions;
  for (const Motion<W>& body : bodies) motions.push_back(rigid_motion(body));
  return motions;
}

/// Of all bodies, in given places.
template <int W>
class Energies {
 public:
  Energies(State<W>& state, const Motions<W>& bodies, const RigidMotions<W>& motions) : motions_(motions) {
    for (std::size_t b = 0; b < bodies.size(); ++b) vibration_.push_back(vibration_energy(bodies[b], motions[b]));
    contact_ = state.contacts.energy(bodies);
    const ActingEffects<W>& effects = state.effects;
    effects_ = effects.energies(bodies, state.contacts, contact_);
    if (effects.empty()) return;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      vibration_[b] += effects.spring_change(static_cast<int>(b), bodies[b]);
  }

  double contact(int lane) const { return contact_[lane]; }
  double effect(std::size_t kind, int lane) const { return effects_[kind][lane]; }

  /// Of a lane, since the energies of its effects were `effects_before`.
  Ledger ledger(int lane, const std::vector<double>& effects_before) const {
    Ledger ledger;
    for (std::size_t b = 0; b < motions_.size(); ++b)
      ledger.bodies.push_back({motions_[b].translation[lane], motions_[b].rotation[lane], vibration_[b][lane]});
    ledger.contact = contact_[lane];
    for (std::size_t kind = 0; kind < effect_kinds; ++kind)
      ledger.effects += effects_[kind][lane] - effects_before[kind];
    return ledger;
  }

 private:
  const RigidMotions<W>& motions_;
  std::vector<Lane<W>> vibration_;  // [body]
  Lane<W> contact_;
  typename ActingEffects<W>::Energies effects_;
};

}  // namespace ricochet
