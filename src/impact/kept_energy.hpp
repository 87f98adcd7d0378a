#pragma once
// The energy that a method conjugate to order 4 keeps.

#include "force/spring_memory.hpp"
#include "integrate/method.hpp"

namespace ricochet {

namespace kept_energy {

template <int W>
Lane<W> dot(const Lattice& lattice, const NodeVectors<W>& a, const NodeVectors<W>& b) {
  Lane<W> sum = Lane<W>::Zero();
  for (int i = 0; i < lattice.free; ++i) sum += a.x(i) * b.x(i) + a.y(i) * b.y(i);
  return sum;
}

template <int W>
NodeVectors<W> nothing(const Lattice& lattice) {
  NodeVectors<W> none;
  none.resize(lattice.nodes());
  return none;
}

/// The springs' forces F. [m0 c^2/R]
template <int W>
NodeVectors<W> spring_forces(const Moving<W>& body) {
  NodeVectors<W> force = nothing<W>(*body.lattice);
  each_spring(body, [&](const auto& law, int i, int, const Spring& spring, const Lane<W>& dx, const Lane<W>& dy,
                        const Lane<W>& r) {
    const Lane<W> pull = body.stiffness * spring.stiffness * law.tension(Lane<W>(r - spring.length)) / r;
    force.x(i) += pull * dx;
    force.y(i) += pull * dy;
    force.x(spring.other) -= pull * dx;
    force.y(spring.other) -= pull * dy;
  });
  return force;
}

/// K w: K the second derivatives of the springs' energy where the nodes are, w vectors of the free nodes.
template <int W>
NodeVectors<W> stiffness_times(const Moving<W>& body, const NodeVectors<W>& w) {
  const Lattice& lattice = *body.lattice;
  NodeVectors<W> product = nothing<W>(lattice);
  each_spring(body, [&](const auto& law, int i, int, const Spring& spring, const Lane<W>& dx, const Lane<W>& dy,
                        const Lane<W>& r) {
    const int j = spring.other;
    const bool free = j < lattice.free;
    const Lane<W> wx = free ? Lane<W>(w.x(j) - w.x(i)) : Lane<W>(-w.x(i)),
                  wy = free ? Lane<W>(w.y(j) - w.y(i)) : Lane<W>(-w.y(i));
    const Lane<W> x = r - spring.length, across = law.tension(x) / r,
                  along = (1.0 + 3 * lattice.quartic * (x * x) - across) * (wx * dx + wy * dy) / (r * r);
    const Lane<W> px = body.stiffness * spring.stiffness * (along * dx + across * wx),
                  py = body.stiffness * spring.stiffness * (along * dy + across * wy);
    product.x(i) -= px;
    product.y(i) -= py;
    product.x(j) += px;
    product.y(j) += py;
  });
  return product;
}

}  // namespace kept_energy

/// What a method that is conjugate to order 4 moves (takahashi_imada, multirate) differs from the solution by a
/// canonical transformation near the identity. The energy of the solution is kept to order 4; that of what is moved
/// lies this much below it and is kept to order 2 only. With the matrix S = h^2 K/m, a step that begins and ends amid a
/// kick keeps the quadratic form
///   m/2 v.(1 + S/6 + 7 S^2/360 + ...) v + 1/2 x.K (1 - S/6 + S^2/180 + ...) x
/// of small vibrations x, and one that does amid a drift
///   m/2 v.(1 - S/12 - S^2/720 + ...) v + 1/2 x.K (1 + S/12 + S^2/180 + ...) x.
/// Here -K x is the springs' force, so that the terms in S hold for springs of any law; those in S^2 are for small
/// vibrations. Without contact; beside it the fast and the slow forces of a multirate method mix. [m0 c^2] [here: the
/// invariant of such a step of an oscillator, scaled to be the Hamiltonian of the motion that passes its points]
template <int W>
Lane<W> kept_beyond(const Method& method, const Lane<W>& h, int body, const Moving<W>& moved) {
  using namespace kept_energy;
  if (method.outcome_order == method.order) return Lane<W>::Zero();
  const bool amid_kick = method.multirate() && body == 1;  // its kicks are the outer ones
  const Lattice& lattice = *moved.lattice;
  const Lane<W> step = amid_kick ? h : Lane<W>(h * method.stages.front().drift), h2 = step * step;
  const NodeVectors<W> F = spring_forces(moved), Kv = stiffness_times(moved, moved.velocity);
  const Lane<W> second = dot(lattice, F, F) / lattice.mass - dot(lattice, moved.velocity, Kv);  // d/dt sum v.F
  const Lane<W> of_v = dot(lattice, Kv, Kv) / lattice.mass,
                of_x = dot(lattice, F, stiffness_times(moved, F)) / (lattice.mass * lattice.mass);
  return amid_kick ? Lane<W>(-h2 / 12 * second + h2 * h2 * (of_v * 7 / 720 + of_x / 360))
                   : Lane<W>(h2 / 24 * second + h2 * h2 * (of_x / 360 - of_v / 1440));
}

}  // namespace ricochet
