#pragma once
// How a multirate method moves two bodies (compose.hpp): the fast one, the contact and the slow one's surface in its
// inner steps, the slow one's interior in the outer one.

#include <array>
#include <vector>

#include "body/interior.hpp"
#include "integrate/method.hpp"

namespace ricochet {

/// What is moved, in W lanes: all bodies, what they are displaced by (0 between kicks), and their contacts. `push`
/// adds the contacts' forces to the bodies'.
template <int W, class Push>
struct Displaceable {
  Motions<W>& bodies;
  std::vector<Coordinates<W>>& displacement;
  Push push;
};

/// x -= d, d = 0.
template <int W>
void put_back(Coordinates<W>& q, Coordinates<W>& displacement, int coordinate) {
  q[coordinate] -= displacement[coordinate];
  displacement[coordinate].setZero();
}

/// `by` over the mass of each coordinate.
template <int W>
class PerMass {
 public:
  PerMass(const Lane<W>& by, const Solid& solid)
      : by_(solid.mass.uniform() ? Lane<W>(by / solid.mass.each()) : by), solid_(solid) {}
  Lane<W> operator[](int coordinate) const {
    const Masses& mass = solid_.mass;
    return mass.uniform() ? by_ : Lane<W>(by_ * mass.inverse()[static_cast<std::size_t>(coordinate / solid_.dim)]);
  }

 private:
  Lane<W> by_;
  const Solid& solid_;
};

template <int W>
class Multirate {
 public:
  Multirate(MultirateRoles roles, const Solid& fast, const Solid& slow)
      : fast_(roles.fast), slow_(roles.slow), rims_{moving_rim(fast), moving_rim(slow)} {
    for (std::size_t b : {0, 1})
      for (auto* pushes : {&push_, &displaced_push_}) (*pushes)[b].resize(static_cast<int>(rims_[b].size()));
    place_.resize(static_cast<int>(rims_[1].size()));
  }

  // The fast part, as in compose.hpp.
  template <class Push>
  void displace(const Displaceable<W, Push>& moved, const Lane<W>& by) const {
    push_rim(moved, by, moved.displacement[slow_]);
    sweep_displacements(moved.bodies[fast_], moved.displacement[fast_], by);
    drift_rim(moved.bodies[slow_], moved.displacement[slow_], Lane<W>(Lane<W>::Ones()));
  }
  template <class Push>
  void kick(const Displaceable<W, Push>& moved, const Lane<W>& by, const Lane<W>& drift_by) const {
    Motion<W>&fast = moved.bodies[fast_], &slow = moved.bodies[slow_];
    push_rim(moved, by, slow.v);
    kick_and_drift(fast, by, drift_by);
    drift_rim(slow, slow.v, drift_by);
  }
  template <class Push>
  void put_back(const Displaceable<W, Push>& moved) const {
    Motion<W>&fast = moved.bodies[fast_], &slow = moved.bodies[slow_];
    for (int c = 0; c < fast.solid->free_coordinates(); ++c) ricochet::put_back(fast.q, moved.displacement[fast_], c);
    for (const int c : rims_[1]) ricochet::put_back(slow.q, moved.displacement[slow_], c);
  }

  /// Displaces the slow body by gradient F/m of its interior, and by `mixed` times that of the contact; the contact's
  /// gain, where the rim is displaced by `mixed` times its interior's share, kicks the fast body by `kick_by` and waits
  /// as a force for the slow one's kick.
  // Every lane goes through all of it, in contact or not: what one lane does must not depend on the others.
  template <class Push>
  void displace_slow(const Displaceable<W, Push>& moved, const Lane<W>& kick_by, const Lane<W>& gradient,
                     double mixed) {
    Motion<W>&fast = moved.bodies[fast_], &slow = moved.bodies[slow_];
    Coordinates<W>& displacement = moved.displacement[slow_];
    take_pushes(moved, push_);
    sweep_displacements(slow, displacement, gradient);
    each_of(rims_[1], [&](int k, int c) {
      place_[k] = slow.q[c];
      slow.q[c] += (mixed - 1) * displacement[c];
    });
    take_pushes(moved, displaced_push_);
    const PerMass<W> kick_per_mass(kick_by, *fast.solid), mixed_per_mass(Lane<W>(mixed * gradient), *slow.solid);
    each_of(rims_[0], [&](int k, int c) { fast.v[c] += kick_per_mass[c] * (displaced_push_[0][k] - push_[0][k]); });
    each_of(rims_[1], [&](int k, int c) {
      slow.f[c] = displaced_push_[1][k] - push_[1][k];
      const Lane<W> d = mixed_per_mass[c] * push_[1][k];
      displacement[c] += d;
      slow.q[c] = place_[k] + d;
    });
  }
  /// The slow body's kick and drift at its displaced places, which are put back; the fast body and the slow one's rim
  /// drift by `outer_drift` instead.
  template <class Push>
  void kick_slow(const Displaceable<W, Push>& moved, const Lane<W>& kick_by, const Lane<W>& drift_by,
                 const Lane<W>& outer_drift) const {
    Motion<W>& slow = moved.bodies[slow_];
    kick_and_drift(slow, kick_by, drift_by);
    for (int c = 0; c < slow.solid->free_coordinates(); ++c) ricochet::put_back(slow.q, moved.displacement[slow_], c);
    drift(moved.bodies[fast_], outer_drift);
    drift_rim(slow, slow.v, Lane<W>(outer_drift - drift_by));
  }

 private:
  // The coordinates of the surface that move.
  static std::vector<int> moving_rim(const Solid& solid) {
    std::vector<int> coordinates;
    for (const int node : surface_nodes(solid.surface))
      for (int d = 0; d < solid.dim && node < solid.free; ++d) coordinates.push_back(solid.dim * node + d);
    return coordinates;
  }

  template <class Use>
  static void each_of(const std::vector<int>& coordinates, Use&& use) {
    for (std::size_t k = 0; k < coordinates.size(); ++k) use(static_cast<int>(k), coordinates[k]);
  }

  // A kick of displacements that were 0, and a drift with them for a unit of time.
  static void sweep_displacements(Motion<W>& body, Coordinates<W>& displacement, const Lane<W>& by) {
    std::swap(body.v, displacement);
    kick_and_drift(body, by, Lane<W>(Lane<W>::Ones()));
    std::swap(body.v, displacement);
  }

  void drift_rim(Motion<W>& slow, const Coordinates<W>& velocity, const Lane<W>& by) const {
    for (const int c : rims_[1]) slow.q[c] += by * velocity[c];
  }

  // The contact's forces, of which the slow body's rim takes its part at once: v += by F/m.
  template <class Push>
  void push_rim(const Displaceable<W, Push>& moved, const Lane<W>& by, Coordinates<W>& velocity) const {
    Motion<W>& slow = moved.bodies[slow_];
    moved.push();
    const PerMass<W> per_mass(by, *slow.solid);
    for (const int c : rims_[1]) {
      velocity[c] += per_mass[c] * slow.f[c];
      slow.f[c].setZero();
    }
  }

  // The contact's forces where the bodies are.
  template <class Push>
  void take_pushes(const Displaceable<W, Push>& moved, std::array<Coordinates<W>, 2>& pushes) const {
    moved.push();
    for (std::size_t b : {0, 1}) {
      Coordinates<W>& force = moved.bodies[b == 0 ? fast_ : slow_].f;
      each_of(rims_[b], [&](int k, int c) {
        pushes[b][k] = force[c];
        force[c].setZero();
      });
    }
  }

  std::size_t fast_, slow_;
  std::array<std::vector<int>, 2> rims_;                 // [fast, slow] moving coordinates of their surfaces
  std::array<Coordinates<W>, 2> push_, displaced_push_;  // [rim coordinate] the contact's forces
  Coordinates<W> place_;                                 // [rim coordinate] of the displaced slow body
};

}  // namespace ricochet
