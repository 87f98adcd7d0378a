#pragma once
// All contacts of a scene: a list of pairs of bodies, and how far each surface has moved since it was last looked at.

#include "contact/pair.hpp"

namespace ricochet {

template <int W>
class Contacts {
 public:
  /// Every body with every later one.
  Contacts(const std::vector<const Solid*>& solids, const ContactLaws& laws) : solids_(solids) {
    for (std::size_t a = 0; a < solids.size(); ++a)
      for (std::size_t b = a + 1; b < solids.size(); ++b)
        pairs_.emplace_back(static_cast<int>(a), static_cast<int>(b), *solids[a], *solids[b], laws);
    for (const Solid* solid : solids) {
      reference_.emplace_back().resize(2 * static_cast<int>(surface_nodes(solid->surface).size()));
      moved_.push_back(Lane<W>::Zero());
    }
  }

  const std::vector<Pair<W>>& pairs() const { return pairs_; }
  std::size_t size() const { return pairs_.size(); }

  void set(int lane, const ExponentialRepulsion* law) {
    for (Pair<W>& pair : pairs_) pair.set(lane, law);
  }
  void carry(int lane, Carrier& carrier) {
    for (Pair<W>& pair : pairs_) pair.carry(lane, carrier);
  }

  /// Finds the candidates at these places, if surfaces have moved too far since they were last found; what asks a pair
  /// needs it, push() does it.
  void update(const Motions<W>& bodies) {
    for (std::size_t b = 0; b < solids_.size(); ++b) moved_[b] = moved_furthest(b, bodies[b].q);
    for (Pair<W>& pair : pairs_) {
      const auto moved = [&] { return Lane<W>(moved_[at(pair.body(0))] + moved_[at(pair.body(1))]); };
      // Written so that NaN also counts as too far: the impact is then ended by its ledger.
      if ((moved() < pair.allowance()).all()) continue;
      for (int lane = 0; lane < W; ++lane)
        if (pair.law(lane) && !(moved()[lane] < pair.allowance()[lane])) rebuild(pair, lane, bodies);
    }
  }

  /// Adds the forces of all contacts to the bodies' `f`; `energy`: of each pair's repulsion. [m0 c^2]
  void push(Motions<W>& bodies, std::vector<Lane<W>>& energy) {
    update(bodies);
    for (std::size_t p = 0; p < pairs_.size(); ++p) energy[p] = pairs_[p].push(bodies);
  }

  /// The stiffest that contact was on one node of a body in a lane since this was last asked, for each pair.
  template <class Use>
  void take_stiffest(int lane, Use&& use) {
    for (Pair<W>& pair : pairs_) use(pair, pair.take_stiffest(lane));
  }

  /// Energy of the repulsion. [m0 c^2]
  Lane<W> energy(const Motions<W>& bodies) {
    update(bodies);
    Lane<W> sum = Lane<W>::Zero();
    for (const Pair<W>& pair : pairs_) sum += pair.energy(bodies);
    return sum;
  }
  /// Of a pair force beside it, after energy() at the same places.
  Lane<W> energy_of(std::size_t force, const Motions<W>& bodies) const {
    Lane<W> sum = Lane<W>::Zero();
    for (const Pair<W>& pair : pairs_) sum += pair.energy_of(force, bodies);
    return sum;
  }
  /// Of friction, after energy() at the same places.
  typename Pair<W>::GripEnergies grip_energies(Motions<W> copies) const {
    typename Pair<W>::GripEnergies sum;
    for (const Pair<W>& pair : pairs_) {
      const auto of_pair = pair.grip_energies(copies);
      sum.lost += of_pair.lost;
      sum.held += of_pair.held;
    }
    return sum;
  }
  /// Adds the forces of contact to a lane of copies of the bodies, after energy() at their places.
  void push_copies(int lane, Motions<W>& copies) const {
    for (const Pair<W>& pair : pairs_) pair.push_copies(lane, copies);
  }

 private:
  static std::size_t at(int body) { return static_cast<std::size_t>(body); }

  Lane<W> moved_furthest(std::size_t body, const Coordinates<W>& q) const {
    Lane<W> furthest = Lane<W>::Zero();
    const std::vector<int>& nodes = surface_nodes(solids_[body]->surface);
    for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
      const int node = nodes[static_cast<std::size_t>(k)];
      const Lane<W> dx = q[2 * node] - reference_[body][2 * k], dy = q[2 * node + 1] - reference_[body][2 * k + 1];
      furthest = furthest.max(dx * dx + dy * dy);
    }
    return furthest.sqrt();
  }

  Points surface_at(std::size_t body, int lane, const Coordinates<W>& q) const {
    Points points;
    for (const int node : surface_nodes(solids_[body]->surface)) points.push_back(q.at(node, lane));
    return points;
  }

  // Both surfaces are looked at anew; what they had moved by, every other pair of theirs takes off its allowance.
  void rebuild(Pair<W>& pair, int lane, const Motions<W>& bodies) {
    const std::size_t a = at(pair.body(0)), b = at(pair.body(1));
    const PlacedSurface first(solids_[a]->surface, surface_at(a, lane, bodies[a].q));
    const PlacedSurface second(solids_[b]->surface, surface_at(b, lane, bodies[b].q));
    for (const auto& [body, surface] : {std::pair(a, &first), std::pair(b, &second)}) {
      for (Pair<W>& other : pairs_)
        if (&other != &pair && other.holds(static_cast<int>(body))) other.take_off(lane, moved_[body][lane]);
      for (std::size_t k = 0; k < surface->points().size(); ++k)
        reference_[body].set(static_cast<int>(k), lane, surface->points()[k]);
      moved_[body][lane] = 0;
    }
    pair.rebuild(lane, first, second);
  }

  std::vector<const Solid*> solids_;
  std::vector<Pair<W>> pairs_;
  std::vector<Coordinates<W>> reference_;  // [body] surface nodes of a lane when it was last looked at
  std::vector<Lane<W>> moved_;             // [body] how far its surface has moved since, at most
};

}  // namespace ricochet
