#pragma once
// The energy that a method conjugate to order 4 keeps.

#include "body/interior.hpp"
#include "integrate/method.hpp"

namespace ricochet {

/// Sum of a_c b_c over the coordinates that move, node by node.
template <int W>
Lane<W> dot(const Solid& solid, const Coordinates<W>& a, const Coordinates<W>& b) {
  const Place<W, 2>*of_a = a.template places<2>(), *of_b = b.template places<2>();
  Lane<W> sum = Lane<W>::Zero();
  for (int i = 0; i < solid.free; ++i) sum += dot(of_a[i], of_b[i]);
  return sum;
}

/// a over the mass of each coordinate, or a itself where all have the same mass, which then stands outside of sums.
template <int W>
Coordinates<W> per_own_mass(const Solid& solid, Coordinates<W> a) {
  if (!solid.mass.uniform())
    for (int c = 0; c < solid.free_coordinates(); ++c)
      a[c] *= solid.mass.inverse()[static_cast<std::size_t>(c / solid.dim)];
  return a;
}

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
/// `slow`: the body is the slow one of a multirate method.
template <int W>
Lane<W> kept_beyond(const Method& method, const Lane<W>& h, bool slow, const Motion<W>& moved) {
  if (method.outcome_order == method.order) return Lane<W>::Zero();
  const bool amid_kick = method.multirate() && slow;  // its kicks are the outer ones
  const Solid& solid = *moved.solid;
  const Lane<W> step = amid_kick ? h : Lane<W>(h * method.stages.front().drift), h2 = step * step;
  const Coordinates<W> F = interior_forces(moved), Kv = stiffness_times(moved, moved.v);
  const Coordinates<W> F_per_mass = per_own_mass(solid, F), Kv_per_mass = per_own_mass(solid, Kv);
  const double mass = solid.mass.uniform() ? solid.mass.each() : 1;
  // d/dt sum v.F
  const Lane<W> second = dot(solid, F, F_per_mass) / mass - dot(solid, moved.v, Kv);
  const Lane<W> of_v = dot(solid, Kv, Kv_per_mass) / mass;
  const Lane<W> of_x = dot(solid, F_per_mass, stiffness_times(moved, F_per_mass)) / (mass * mass);
  return amid_kick ? Lane<W>(-h2 / 12 * second + h2 * h2 * (of_v * 7 / 720 + of_x / 360))
                   : Lane<W>(h2 / 24 * second + h2 * h2 * (of_x / 360 - of_v / 1440));
}

}  // namespace ricochet
