#pragma once
// How a multirate method moves two bodies (compose.hpp): the projectile, the contact and the target's rim in its inner
// steps, the target's springs in the outer one.

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "force/springs.hpp"

namespace ricochet {

/// What is moved, in W lanes: projectile and target, what they are displaced by (0 between kicks), and their contact.
template <int W, class Contact>
struct Displaceable {
  std::array<Moving<W>, 2>& bodies;
  std::array<NodeVectors<W>, 2>& displacement;
  Contact& contact;
};

/// x -= d, d = 0.
template <int W>
void put_back(NodeVectors<W>& position, NodeVectors<W>& displacement, int node) {
  position.x(node) -= displacement.x(node);
  position.y(node) -= displacement.y(node);
  displacement.x(node).setZero();
  displacement.y(node).setZero();
}

template <int W>
class Multirate {
 public:
  Multirate(const Lattice& projectile, const Lattice& target) {
    std::copy_if(target.rim.begin(), target.rim.end(), std::back_inserter(rims_[1]),
                 [&](int i) { return i < target.free; });
    rims_[0] = projectile.rim;
    for (std::size_t b : {0, 1})
      for (auto* pushes : {&push_, &displaced_push_}) (*pushes)[b].resize(static_cast<int>(rims_[b].size()));
    place_.resize(static_cast<int>(rims_[1].size()));
  }

  // The fast part, as in compose.hpp; displace() and kick() return the contact's energy.
  template <class Contact>
  Lane<W> displace(const Displaceable<W, Contact>& moved, const Lane<W>& by) const {
    auto& [bodies, displacement, contact] = moved;
    const Lane<W> energy = push_rim(moved, by, displacement[1]);
    sweep_displacements(bodies[0], displacement[0], by);
    drift(bodies[1], rims_[1], displacement[1], Lane<W>(Lane<W>::Ones()));
    return energy;
  }
  template <class Contact>
  Lane<W> kick(const Displaceable<W, Contact>& moved, const Lane<W>& by, const Lane<W>& drift_by) const {
    auto& [bodies, displacement, contact] = moved;
    const Lane<W> energy = push_rim(moved, by, bodies[1].velocity);
    kick_and_drift(bodies[0], Lane<W>(by / bodies[0].lattice->mass), drift_by);
    drift(bodies[1], rims_[1], bodies[1].velocity, drift_by);
    return energy;
  }
  template <class Contact>
  void put_back(const Displaceable<W, Contact>& moved) const {
    auto& [bodies, displacement, contact] = moved;
    for (int i = 0; i < bodies[0].lattice->free; ++i) ricochet::put_back(bodies[0].position, displacement[0], i);
    for (const int i : rims_[1]) ricochet::put_back(bodies[1].position, displacement[1], i);
  }

  /// Displaces the target by gradient F/m of its springs, and by `mixed` times that of the contact; the contact's gain,
  /// where the rim is displaced by `mixed` times its springs' share, kicks the projectile by `kick_by` and waits as a
  /// force for the target's kick.
  // Every lane goes through all of it, in contact or not: what one lane does must not depend on the others.
  template <class Contact>
  void displace_slow(const Displaceable<W, Contact>& moved, const Lane<W>& kick_by, const Lane<W>& gradient,
                     double mixed) {
    std::array<NodeVectors<W>, 2>& displacement =
        moved.displacement;  // by its name: clang 14 captures no structured binding
    Moving<W>&projectile = moved.bodies[0], &target = moved.bodies[1];
    take_pushes(moved, push_);
    sweep_displacements(target, displacement[1], gradient);
    each_rim_node(1, [&](int k, int i) {
      place_.x(k) = target.position.x(i);
      place_.y(k) = target.position.y(i);
      target.position.x(i) += (mixed - 1) * displacement[1].x(i);
      target.position.y(i) += (mixed - 1) * displacement[1].y(i);
    });
    take_pushes(moved, displaced_push_);
    const Lane<W> kick_per_mass = kick_by / projectile.lattice->mass,
                  mixed_per_mass = mixed * gradient / target.lattice->mass;
    each_rim_node(0, [&](int k, int i) {
      projectile.velocity.x(i) += kick_per_mass * (displaced_push_[0].x(k) - push_[0].x(k));
      projectile.velocity.y(i) += kick_per_mass * (displaced_push_[0].y(k) - push_[0].y(k));
    });
    each_rim_node(1, [&](int k, int i) {
      target.force.x(i) = displaced_push_[1].x(k) - push_[1].x(k);
      target.force.y(i) = displaced_push_[1].y(k) - push_[1].y(k);
      const Lane<W> dx = mixed_per_mass * push_[1].x(k), dy = mixed_per_mass * push_[1].y(k);
      displacement[1].x(i) += dx;
      displacement[1].y(i) += dy;
      target.position.x(i) = place_.x(k) + dx;
      target.position.y(i) = place_.y(k) + dy;
    });
  }
  /// The target's kick and drift at its displaced places, which are put back; the projectile and the target's rim drift
  /// by `outer_drift` instead.
  template <class Contact>
  void kick_slow(const Displaceable<W, Contact>& moved, const Lane<W>& kick_by, const Lane<W>& drift_by,
                 const Lane<W>& outer_drift) const {
    auto& [bodies, displacement, contact] = moved;
    Moving<W>&projectile = bodies[0], &target = bodies[1];
    kick_and_drift(target, Lane<W>(kick_by / target.lattice->mass), drift_by);
    for (int i = 0; i < target.lattice->free; ++i) ricochet::put_back(target.position, displacement[1], i);
    for (int i = 0; i < projectile.lattice->free; ++i) {
      projectile.position.x(i) += outer_drift * projectile.velocity.x(i);
      projectile.position.y(i) += outer_drift * projectile.velocity.y(i);
    }
    drift(target, rims_[1], target.velocity, Lane<W>(outer_drift - drift_by));
  }

 private:
  template <class Use>
  void each_rim_node(std::size_t body, Use&& use) const {
    for (std::size_t k = 0; k < rims_[body].size(); ++k) use(static_cast<int>(k), rims_[body][k]);
  }

  // A kick of displacements that were 0, and a drift with them for a unit of time.
  static void sweep_displacements(Moving<W>& body, NodeVectors<W>& displacement, const Lane<W>& by) {
    std::swap(body.velocity, displacement);
    kick_and_drift(body, Lane<W>(by / body.lattice->mass), Lane<W>(Lane<W>::Ones()));
    std::swap(body.velocity, displacement);
  }

  static void drift(Moving<W>& body, const std::vector<int>& nodes, const NodeVectors<W>& velocity, const Lane<W>& by) {
    for (const int i : nodes) {
      body.position.x(i) += by * velocity.x(i);
      body.position.y(i) += by * velocity.y(i);
    }
  }

  // The contact's forces, of which the target's rim takes its part at once: v += by F/m. Returns the contact's energy.
  template <class Contact>
  Lane<W> push_rim(const Displaceable<W, Contact>& moved, const Lane<W>& by, NodeVectors<W>& velocity) const {
    auto& [bodies, displacement, contact] = moved;
    const Lane<W> energy = contact.add_forces(bodies[0], bodies[1]);
    NodeVectors<W>& force = bodies[1].force;
    const Lane<W> per_mass = by / bodies[1].lattice->mass;
    for (const int i : rims_[1]) {
      velocity.x(i) += per_mass * force.x(i);
      velocity.y(i) += per_mass * force.y(i);
      force.x(i).setZero();
      force.y(i).setZero();
    }
    return energy;
  }

  // The contact's forces where the bodies are.
  template <class Contact>
  void take_pushes(const Displaceable<W, Contact>& moved, std::array<NodeVectors<W>, 2>& pushes) const {
    moved.contact.add_forces(moved.bodies[0], moved.bodies[1]);
    for (std::size_t b : {0, 1})
      each_rim_node(b, [&](int k, int i) {
        NodeVectors<W>& force = moved.bodies[b].force;
        pushes[b].x(k) = force.x(i);
        pushes[b].y(k) = force.y(i);
        force.x(i).setZero();
        force.y(i).setZero();
      });
  }

  std::array<std::vector<int>, 2> rims_;                 // the projectile's rim, the target's moving rim
  std::array<NodeVectors<W>, 2> push_, displaced_push_;  // [rim node] the contact's forces
  NodeVectors<W> place_;                                 // [rim node] of the displaced target
};

}  // namespace ricochet
