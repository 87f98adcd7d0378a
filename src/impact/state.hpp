#pragma once
// W runs that share their solids: where every body is, what acts between them and on them.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "body/interior.hpp"
#include "effect/acting.hpp"
#include "impact/launch/start.hpp"
#include "integrate/method.hpp"

namespace ricochet {

template <int W>
struct State {
  /// `threads`: how many share the sweeps over large bodies; one run alone can have several.
  State(const Solids& of, const Method& by, const std::vector<Effect>& beside, int threads = 1)
      : solids(of),
        method(by),
        contacts(of, contact_laws(beside)),
        contact_energy(contacts.size(), Lane<W>::Zero()),
        effects(beside, of) {
    if (threads > 1) share_sweeps(threads);
    for (const Solid* solid : solids) {
      bodies.push_back(at_rest<W>(*solid));  // idle lanes rest
      bodies.back().flow = effects.flows().of(bodies.size() - 1);
      if (const auto shared = sharings.find(solid); shared != sharings.end()) bodies.back().sharing = &shared->second;
      displacement.emplace_back().resize(solid->coordinates());
    }
    end = bodies;
  }

  void share_sweeps(int threads) {
    for (std::size_t b = 0; b < solids.size(); ++b) {
      const Solid* solid = solids[b];
      if (!worth_sharing(*solid) || effects.flows().of(b) || sharings.contains(solid)) continue;
      if (!team) team = std::make_unique<Team>(threads);
      sharings.emplace(solid, sharing_of(*solid, *team));
    }
  }

  /// Puts the bodies of a run into a lane.
  void place(int lane, const Start& start, const std::vector<Effect>& own) {
    std::vector<Turn> turns;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      put(bodies[b], lane, start.bodies[b]);
      bodies[b].stiffness[lane] = start.stiffness[b];
      turns.push_back(start.bodies[b].turn);
    }
    set_laws(lane, start);
    effects.begin(lane, start.step, own, bodies, turns);
  }

  /// A lane without a run: its bodies stay where they are.
  void clear(int lane) {
    h[lane] = 0;
    contacts.set(lane, nullptr);
    broken[static_cast<std::size_t>(lane)].reset();
  }

  /// Passes on a run between two steps.
  void carry(int lane, Carrier& carrier) {
    for (Motion<W>& body : bodies) {
      for (Coordinates<W>* values : {&body.q, &body.v})
        for (int c = 0; c < values->size(); ++c) carrier.pass((*values)[c][lane]);
      for (int c = 0; c < body.f.size(); ++c) body.f[c][lane] = 0;  // as after every kick
      carrier.pass(body.stiffness[lane]);
      body.modal.state.carry(lane, carrier);
    }
    for (Lane<W>& energy : contact_energy) carrier.pass(energy[lane]);
    contacts.carry(lane, carrier);
    effects.carry(lane, carrier);
  }
  void set_laws(int lane, const Start& start) {
    h[lane] = start.step;
    law[static_cast<std::size_t>(lane)] = start.contact;
    contacts.set(lane, &law[static_cast<std::size_t>(lane)]);
  }

  /// Energy of the contacts' repulsion at the last evaluation. [m0 c^2]
  Lane<W> all_contact_energy() const {
    Lane<W> sum = Lane<W>::Zero();
    for (const Lane<W>& energy : contact_energy) sum += energy;
    return sum;
  }

  /// Energy of a pair's repulsion in a lane at the end of the last step, of which a run is ahead by a drift. [m0 c^2]
  double contact_energy_at_end(std::size_t pair, int lane) const {
    return contacts.pairs()[pair].energy_before(lane, bodies, effects.split() ? 0 : method.ahead_drift * h[lane]);
  }

  Solids solids;
  std::unique_ptr<Team> team;                ///< that shares sweeps
  std::map<const Solid*, Sharing> sharings;  ///< of the bodies that are large enough
  const Method& method;
  Motions<W> bodies, end;                    ///< where the run is; at the end of a step
  std::vector<Coordinates<W>> displacement;  ///< [body] of a force-gradient kick; 0 between kicks
  Contacts<W> contacts;
  std::vector<Lane<W>> contact_energy;  ///< [pair] of the repulsion at the last evaluation
  ActingEffects<W> effects;
  Lane<W> h = Lane<W>::Zero();  ///< step; 0 in idle lanes, which then stay as they are, bit for bit
  std::array<ExponentialRepulsion, W> law;
  std::array<std::optional<BodyNode>, W> broken;  ///< where a lane ceased to be finite
};

}  // namespace ricochet
