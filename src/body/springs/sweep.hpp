#pragma once
// Sweeps over all springs of a body, written once for every law, in D dimensions.

#include "body/motion.hpp"
#include "body/springs/springs.hpp"

namespace ricochet {

/// v += kick F/m, x += drift v of the free nodes, in one sweep over the springs; F holds what `f` held, and empties it.
/// Compiled by itself for the plane (sweep.cpp): its time is that of an impact. Its definition: sweep_kernel.hpp.
template <int D, int W>
void kick_and_drift(Motion<W>& body, const Springs& springs, const Lane<W>& kick, const Lane<W>& drift);

/// Calls `use(law, i, s, spring, d, r)` for every spring, by rising s: d the vector from node i to the other end, r its
/// length.
template <int D, int W, class Use>
void each_spring(const Motion<W>& body, const Springs& springs, Use&& use) {
  const Place<W, D>* position = body.q.template places<D>();
  with_spring_law(springs.law, [&](const auto& law) {
    each_spring(springs, body.solid->free, [&](int i, int s, const Spring& spring) {
      const Place<W, D> d = position[spring.other] - position[i];
      use(law, i, s, spring, d, Lane<W>(dot(d, d).sqrt()));
    });
  });
}

/// Potential energy of all springs, above that at rest. [m0 c^2]
template <int D, int W>
Lane<W> spring_energy(const Motion<W>& body, const Springs& springs) {
  Lane<W> sum = Lane<W>::Zero();
  each_spring<D>(body, springs,
                 [&](const auto& law, int, int, const Spring& spring, const Place<W, D>&, const Lane<W>& r) {
                   sum += spring.stiffness * law.energy(Lane<W>(r - spring.length));
                 });
  return body.stiffness * (sum - springs.rest_energy);
}

/// force += F of the springs. [m0 c^2/R]
template <int D, int W>
void add_spring_forces(const Motion<W>& body, const Springs& springs, Coordinates<W>& force) {
  Place<W, D>* sum = force.template places<D>();
  each_spring<D>(body, springs,
                 [&](const auto& law, int i, int, const Spring& spring, const Place<W, D>& d, const Lane<W>& r) {
                   const Lane<W> pull = body.stiffness * spring.stiffness * law.tension(Lane<W>(r - spring.length)) / r;
                   const Place<W, D> pulled = pull * d;
                   sum[i] += pulled;
                   sum[spring.other] -= pulled;
                 });
}

/// product += K w: K the second derivatives of the springs' energy where the nodes are; held nodes count as 0.
template <int D, int W>
void add_stiffness_times(const Motion<W>& body, const Springs& springs, const Coordinates<W>& w,
                         Coordinates<W>& product) {
  const Place<W, D>* given = w.template places<D>();
  Place<W, D>* sum = product.template places<D>();
  each_spring<D>(body, springs,
                 [&](const auto& law, int i, int, const Spring& spring, const Place<W, D>& d, const Lane<W>& r) {
                   Place<W, D> apart;
                   apart.set_zero();
                   if (spring.other < body.solid->free) apart += given[spring.other];
                   apart -= given[i];
                   const Lane<W> x = r - spring.length, across = law.tension(x) / r;
                   const Lane<W> along = (law.tangent(x) - across) * dot(apart, d) / (r * r);
                   const Lane<W> k = body.stiffness * spring.stiffness;
                   const Place<W, D> pull = k * (along * d + across * apart);
                   sum[i] -= pull;
                   sum[spring.other] += pull;
                 });
}

}  // namespace ricochet
