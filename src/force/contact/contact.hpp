#pragma once
// Contact of two bodies in W lanes: per lane a list of candidate pairs with a skin, rebuilt only when a rim has moved
// too far.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "force/contact/adhesion.hpp"
#include "force/contact/candidates.hpp"
#include "force/contact/exponential_repulsion.hpp"
#include "force/contact/gaps.hpp"
#include "force/contact/grip.hpp"
#include "force/lane.hpp"
#include "lattice/lattice.hpp"

namespace ricochet {

/// A node of one of two bodies: 0 the projectile, 1 the target.
struct BodyNode {
  int body = 0, node = 0;
};

/// Nodes of one body against segments of the other, in every lane. `effects` false leaves out what adhesion and
/// friction need, for the benchmark that shows what that costs a scene without them.
template <int W, bool effects = true>
class Contact {
  template <int V, bool e>
  friend class Contact;

 public:
  /// `adhesion` and `friction` act beside every lane's repulsion; nullptr: they do not.
  Contact(const Lattice& projectile, const Lattice& target, const Adhesion* adhesion = nullptr,
          const Friction* friction = nullptr)
      : rims_{&projectile.rim, &target.rim}, adhesion_(adhesion) {
    if (friction) grip_.emplace(*friction, projectile, target);
    for (int body : {0, 1}) reference_[body].resize(static_cast<int>(rims_[body]->size()));
    allowance_.setConstant(std::numeric_limits<double>::infinity());
  }

  /// Puts a law into a lane; the next evaluation looks for candidates. No law (nullptr) leaves the lane without
  /// contact.
  void set(int lane, const ExponentialRepulsion* law) {
    law_[lane] = law;
    stiffest_[lane] = 0;
    allowance_[lane] = law ? -1.0 : std::numeric_limits<double>::infinity();
    for (auto& pairs : pairs_[lane]) pairs.clear();
    if (grip()) grip()->clear(lane);
  }

  /// Takes over what is remembered of an impact in a lane of another width, after set().
  template <int V>
  void take(int lane, const Contact<V, effects>& from, int from_lane) {
    if (grip()) grip()->take(lane, *from.grip(), from_lane);
    stiffest_[lane] = from.stiffest_[from_lane];
    stiffest_node_[lane] = from.stiffest_node_[from_lane];
  }

  /// Finds the pairs near these positions, if rims have moved too far since they were last found; each() and apart()
  /// need it, evaluations do it.
  // A list found at the reference positions holds every pair within reach until both rims together have moved
  // `allowance`.
  void update(const NodeVectors<W>& projectile, const NodeVectors<W>& target) {
    const Lane<W> moved = moved_furthest(0, projectile) + moved_furthest(1, target);
    // Written so that NaN also counts as too far: the impact is then ended by its ledger.
    if ((moved < allowance_).all()) return;
    for (int lane = 0; lane < W; ++lane)
      if (law_[lane] && !(moved[lane] < allowance_[lane])) rebuild(lane, projectile, target);
  }

  /// Adds the contact forces at the bodies' positions to their `force`; returns the energy of the repulsion in each
  /// lane. [m0 c^2]
  Lane<W> add_forces(Moving<W>& projectile, Moving<W>& target) {
    update(projectile.position, target.position);
    Lane<W> energy = Lane<W>::Zero();
    for (int lane = 0; lane < W; ++lane) {
      if (pairs_[lane][0].empty() && pairs_[lane][1].empty()) continue;
      const double xi = law_[lane]->xi;
      int node = -1;
      double on_node = 0;
      energy[lane] = each(lane, projectile.position, target.position, [&](const Push& push) {
        const double repulsion = xi * push.energy;
        on_node = push.node == node ? on_node + repulsion : repulsion;
        node = push.node;  // pairs of a node stand together
        if (xi * on_node > stiffest_[lane]) {
          stiffest_[lane] = xi * on_node;
          stiffest_node_[lane] = {push.direction, push.node};
        }
        push_apart(push, lane, projectile, target);
      });
    }
    if (grip()) hold(*grip(), projectile, target);
    return energy;
  }

  /// The greatest stiffness, xi F and that of friction, that contact put on one node in any evaluation since this was
  /// last asked. [m0 c^2/R^2]
  double take_stiffest(int lane) {
    const double stiffest = std::exchange(stiffest_[lane], 0.0);
    return stiffest > 0 && grip() ? stiffest + grip()->stiffness(lane) : stiffest;
  }

  /// Which node that was.
  BodyNode stiffest_node(int lane) const { return stiffest_node_[lane]; }

  /// Energy of the repulsion in each lane at given positions. [m0 c^2]
  Lane<W> energy(const NodeVectors<W>& projectile, const NodeVectors<W>& target) {
    update(projectile, target);
    Lane<W> sum = Lane<W>::Zero();
    for (int lane = 0; lane < W; ++lane) sum[lane] = each(lane, projectile, target, [](const Push&) {});
    return sum;
  }

  /// Energy of adhesion, after energy() at the same positions. [m0 c^2]
  Lane<W> adhesion_energy(const NodeVectors<W>& projectile, const NodeVectors<W>& target) const {
    Lane<W> sum = Lane<W>::Zero();
    if (adhesion())
      for (int lane = 0; lane < W; ++lane)
        each(lane, projectile, target, [&](const Push& push) {
          const NodeVectors<W>&nodes = push.direction == 0 ? projectile : target,
                &chain = push.direction == 0 ? target : projectile;
          sum[lane] += adhesion()->energy(
              closest(nodes.at(push.node, lane), chain.at(push.from, lane), chain.at(push.to, lane)).distance);
        });
    return sum;
  }

  /// Adds the forces of contact, friction included, to a lane of copies of the bodies, after energy() at their
  /// positions; nothing else changes.
  void add_forces_to_copies(int lane, Moving<W>& projectile, Moving<W>& target) const {
    each(lane, projectile.position, target.position,
         [&](const Push& push) { push_apart(push, lane, projectile, target); });
    if (!grip()) return;
    Grip<W> copy = *grip();
    hold(copy, projectile, target);
  }

  struct FrictionEnergies {
    Lane<W> lost = Lane<W>::Zero(), held = Lane<W>::Zero();
  };
  /// What friction would have taken if it were evaluated in these places. The bodies are copies: they collect forces
  /// that nobody reads.
  FrictionEnergies friction_energies(Moving<W> projectile, Moving<W> target) const {
    if (!grip()) return {};
    Grip<W> copy = *grip();
    hold(copy, projectile, target);
    return {copy.lost(), copy.held()};
  }

  /// One push of a segment on a node: direction 0 is a projectile node off a target segment, 1 the reverse.
  struct Push {
    int direction, node, from, to;  ///< node numbers in their lattices
    double along;                   ///< 0: the segment's end `from` takes the reaction, 1: `to`
    Vec2 force;                     ///< on the node, adhesion included
    double energy;                  ///< of the repulsion
  };

  /// Calls `use(push)` for every pair of a lane within reach, in a fixed order; returns their energy.
  template <class Use>
  double each(int lane, const NodeVectors<W>& projectile, const NodeVectors<W>& target, Use&& use) const {
    if (!law_[lane]) return 0;
    double sum = 0;
    for (int direction = 0; direction < 2; ++direction) {
      const NodeVectors<W>& nodes = direction == 0 ? projectile : target;
      const NodeVectors<W>& chain = direction == 0 ? target : projectile;
      const std::vector<Pair>& pairs = pairs_[lane][direction];
      if (pairs.empty()) continue;
      gaps_.resize(pairs.size());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Ends ends = ends_of(pairs[i], direction);
        gaps_.px[i] = nodes.x(ends.node)[lane];
        gaps_.py[i] = nodes.y(ends.node)[lane];
        gaps_.ax[i] = chain.x(ends.from)[lane];
        gaps_.ay[i] = chain.y(ends.from)[lane];
        gaps_.bx[i] = chain.x(ends.to)[lane];
        gaps_.by[i] = chain.y(ends.to)[lane];
      }
      measure(gaps_, *law_[lane], adhesion());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (gaps_.energy[i] == 0) continue;
        sum += gaps_.energy[i];
        const Ends ends = ends_of(pairs[i], direction);
        use(Push{direction, ends.node, ends.from, ends.to, gaps_.along[i], Vec2(gaps_.fx[i], gaps_.fy[i]),
                 gaps_.energy[i]});
      }
    }
    return sum;
  }

  /// True if no pair of the lane is within reach.
  bool apart(int lane, const NodeVectors<W>& projectile, const NodeVectors<W>& target) const {
    bool any = false;
    each(lane, projectile, target, [&](const Push&) { any = true; });
    return !any;
  }

 private:
  static void push_apart(const Push& push, int lane, Moving<W>& projectile, Moving<W>& target) {
    Moving<W>& a = push.direction == 0 ? projectile : target;
    Moving<W>& b = push.direction == 0 ? target : projectile;
    a.force.add(push.node, lane, push.force);
    b.force.add(push.from, lane, -(1 - push.along) * push.force);
    b.force.add(push.to, lane, -push.along * push.force);
  }

  const Adhesion* adhesion() const { return effects ? adhesion_ : nullptr; }
  const Grip<W>* grip() const { return effects && grip_ ? &*grip_ : nullptr; }
  Grip<W>* grip() { return effects && grip_ ? &*grip_ : nullptr; }

  Lane<W> moved_furthest(int body, const NodeVectors<W>& position) const {
    Lane<W> furthest = Lane<W>::Zero();
    const std::vector<int>& rim = *rims_[body];
    for (int k = 0; k < static_cast<int>(rim.size()); ++k) {
      const Lane<W> dx = position.x(rim[k]) - reference_[body].x(k), dy = position.y(rim[k]) - reference_[body].y(k);
      furthest = furthest.max(dx * dx + dy * dy);
    }
    return furthest.sqrt();
  }

  void rebuild(int lane, const NodeVectors<W>& projectile, const NodeVectors<W>& target) {
    std::array<Points, 2> rim;
    for (int body : {0, 1}) {
      const NodeVectors<W>& position = body == 0 ? projectile : target;
      for (int k = 0; k < static_cast<int>(rims_[body]->size()); ++k) {
        rim[body].push_back(position.at((*rims_[body])[k], lane));
        reference_[body].set(k, lane, rim[body].back());
      }
    }
    const double reach = law_[lane]->reach, skin = 0.5 * reach;
    const double box_gap = box_distance(rim[0], rim[1]) - reach;
    for (auto& pairs : pairs_[lane]) pairs.clear();
    allowance_[lane] = box_gap > skin ? box_gap : skin;
    if (box_gap > skin) return;
    pairs_[lane][0] = pairs_within(rim[0], rim[1], reach + skin);
    if (law_[lane]->two_sided()) pairs_[lane][1] = pairs_within(rim[1], rim[0], reach + skin);
  }

  // Friction at the bodies' positions, whose pairs are known.
  void hold(Grip<W>& grip, Moving<W>& projectile, Moving<W>& target) const {
    for (int lane = 0; lane < W; ++lane) {
      if (!law_[lane]) continue;
      grip.begin();
      each(lane, projectile.position, target.position, [&](const Push& p) {
        grip.add({p.direction, p.node, p.from, p.to, p.along, law_[lane]->xi * p.energy});
      });
      grip.end(lane, projectile, target);
    }
  }

  struct Ends {
    int node, from, to;
  };

  Ends ends_of(const Pair& pair, int direction) const {
    const std::vector<int>& chain = *rims_[1 - direction];
    return {(*rims_[direction])[pair.node], chain[pair.segment],
            chain[pair.segment + 1 < static_cast<int>(chain.size()) ? pair.segment + 1 : 0]};
  }

  std::array<const std::vector<int>*, 2> rims_;
  std::array<NodeVectors<W>, 2> reference_;  // rim positions when a lane's list was built
  Lane<W> allowance_;
  std::array<const ExponentialRepulsion*, W> law_{};
  std::array<std::array<std::vector<Pair>, 2>, W> pairs_;  // [lane][direction]
  Lane<W> stiffest_ = Lane<W>::Zero();
  std::array<BodyNode, W> stiffest_node_{};
  const Adhesion* adhesion_;
  std::optional<Grip<W>> grip_;
  mutable Gaps gaps_;  // of the lane at hand; kept for its memory
};

}  // namespace ricochet
