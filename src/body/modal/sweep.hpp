#pragma once
// Kicks and drifts of a body of modes. A drift is the exact motion of a body that nothing touches: the frame flies and
// turns, and every mode turns in its own plane (q, p).

#include <cmath>

#include "body/motion.hpp"

namespace ricochet {

namespace modal {

// Lane by lane: Eigen's own sine of four numbers has other bits than that of one.
template <int W, class Function>
Lane<W> each(const Lane<W>& of, Function&& function) {
  Lane<W> values;
  for (int lane = 0; lane < W; ++lane) values[lane] = function(of[lane]);
  return values;
}

template <int W>
Lane<W> cosine(const Lane<W>& angle) {
  return each<W>(angle, [](double x) { return std::cos(x); });
}
template <int W>
Lane<W> sine(const Lane<W>& angle) {
  return each<W>(angle, [](double x) { return std::sin(x); });
}

/// Turned counter-clockwise by the frame's angle. Written with a sum in both lines, as core/turn.hpp says.
template <int W>
Place<W, 2> turned(const Place<W, 2>& v, const Lane<W>& cosine, const Lane<W>& sine) {
  const Lane<W> back = -sine;
  return {Lane<W>(cosine * v.at[0] + back * v.at[1]), Lane<W>(sine * v.at[0] + cosine * v.at[1])};
}

/// Displacements and rates of some nodes in the frame.
template <int W>
void add_modes(ModalMotion<W>& moving, const MovedNodes& nodes) {
  const auto count = static_cast<std::size_t>(nodes.coordinates());
  moving.displacement.assign(count, Lane<W>::Zero());
  moving.rate.assign(count, Lane<W>::Zero());
  for (std::size_t k = 0; k < moving.state.q.size(); ++k) {
    const double* shape = nodes.of_mode(k);
    const Lane<W> q = moving.state.q[k], p = moving.state.p[k];
    for (std::size_t c = 0; c < count; ++c) {
      moving.displacement[c] += shape[c] * q;
      moving.rate[c] += shape[c] * p;
    }
  }
}

/// Places and velocities of some nodes, from the state.
template <int W>
void place(Motion<W>& body, const Modes& modes, const MovedNodes& nodes) {
  ModalMotion<W>& moving = body.modal;
  ModalState<W>& state = moving.state;
  state.cosine = cosine<W>(state.angle);
  state.sine = sine<W>(state.angle);
  add_modes(moving, nodes);
  Place<W, 2>*places = body.q.template places<2>(), *velocities = body.v.template places<2>();
  for (std::size_t n = 0; n < nodes.node.size(); ++n) {
    const int node = nodes.node[n];
    const Vec2& arm = modes.arm[static_cast<std::size_t>(node)];
    const Place<W, 2> at(Lane<W>(arm.x() + moving.displacement[2 * n]),
                         Lane<W>(arm.y() + moving.displacement[2 * n + 1]));
    const Place<W, 2> rate(moving.rate[2 * n], moving.rate[2 * n + 1]);
    const Place<W, 2> from_centre = turned<W>(at, state.cosine, state.sine);
    const Place<W, 2> whirl(Lane<W>(-state.spin * from_centre.at[1]), Lane<W>(state.spin * from_centre.at[0]));
    places[node] = state.centre + from_centre;
    velocities[node] = state.velocity + (whirl + turned<W>(rate, state.cosine, state.sine));
  }
}

template <int W>
const ModalTurn<W>& turn_of(ModalMotion<W>& moving, const Modes& modes, const Lane<W>& time, const Lane<W>& stiffness) {
  for (const ModalTurn<W>& turn : moving.turns)
    if ((turn.time == time && turn.stiffness == stiffness).all()) return turn;
  ModalTurn<W>& turn = moving.turns[moving.oldest];
  moving.oldest = (moving.oldest + 1) % moving.turns.size();
  turn.time = time;
  turn.stiffness = stiffness;
  const std::size_t count = modes.omega.size();
  for (auto* numbers : {&turn.cosine, &turn.sine_per_omega, &turn.minus_omega_sine}) numbers->resize(count);
  const Lane<W> root = stiffness.sqrt();
  for (std::size_t k = 0; k < count; ++k) {
    // An idle lane has no stiffness, and stays where it is.
    const Lane<W> omega = (root > 0).select(Lane<W>(modes.omega[k] * root), Lane<W>::Ones());
    const Lane<W> s = sine<W>(Lane<W>(omega * time));
    turn.cosine[k] = cosine<W>(Lane<W>(omega * time));
    turn.sine_per_omega[k] = s / omega;
    turn.minus_omega_sine[k] = -(s * omega);
  }
  return turn;
}

}  // namespace modal

/// A lane begins: the body rigid, its centre, its velocity [c] and spin [c/R], its frame turned by an angle.
template <int W>
void put_modes(Motion<W>& body, int lane, const Vec2& centre, const Vec2& velocity, double angle, double spin) {
  ModalState<W>& state = body.modal.state;
  for (int d = 0; d < 2; ++d) {
    state.centre.at[d][lane] = centre[d];
    state.velocity.at[d][lane] = velocity[d];
  }
  state.angle[lane] = angle;
  state.spin[lane] = spin;
  for (std::vector<Lane<W>>* modes : {&state.q, &state.p})
    for (Lane<W>& number : *modes) number[lane] = 0;
}

/// Brings all places and velocities of nodes up to the state; between sweeps only those of the surface are.
template <int W>
void settle(Motion<W>& body, const Modes& modes) {
  modal::place(body, modes, modes.all);
}

/// What acts on the surface's nodes, which are where the state is, changes the momenta; `f` is emptied.
template <int W>
void kick(Motion<W>& body, const Modes& modes, const Lane<W>& by) {
  ModalMotion<W>& moving = body.modal;
  ModalState<W>& state = moving.state;
  Place<W, 2>* force = body.f.template places<2>();
  const Place<W, 2>* places = body.q.template places<2>();
  const Lane<W> back = -state.sine;
  Place<W, 2> sum;
  sum.set_zero();
  Lane<W> torque = Lane<W>::Zero();
  moving.push.resize(static_cast<std::size_t>(modes.rim.coordinates()));
  moving.pushed.clear();
  for (std::size_t n = 0; n < modes.rim.node.size(); ++n) {
    Place<W, 2>& f = force[modes.rim.node[n]];
    if ((f.at[0] == 0 && f.at[1] == 0).all()) continue;
    const Place<W, 2> arm = places[modes.rim.node[n]] - state.centre;
    sum += f;
    torque += arm.at[0] * f.at[1] - arm.at[1] * f.at[0];
    const Place<W, 2> in_frame = modal::turned<W>(f, state.cosine, back);
    moving.push[2 * n] = by * in_frame.at[0];
    moving.push[2 * n + 1] = by * in_frame.at[1];
    moving.pushed.push_back(n);
    f.set_zero();
  }
  for (int d = 0; d < 2; ++d) state.velocity.at[d] += modes.per_mass * (by * sum.at[d]);
  state.spin += modes.per_inertia * (by * torque);
  for (std::size_t k = 0; k < state.p.size(); ++k) {
    const double* shape = modes.rim.of_mode(k);
    Lane<W> gained = Lane<W>::Zero();
    for (const std::size_t n : moving.pushed)
      gained += shape[2 * n] * moving.push[2 * n] + shape[2 * n + 1] * moving.push[2 * n + 1];
    state.p[k] += gained;
  }
}

/// The exact motion of the free body for a time.
template <int W>
void drift(Motion<W>& body, const Modes& modes, const Lane<W>& by) {
  ModalMotion<W>& moving = body.modal;
  ModalState<W>& state = moving.state;
  state.centre += by * state.velocity;
  state.angle += by * state.spin;
  const ModalTurn<W>& turn = modal::turn_of(moving, modes, by, body.stiffness);
  for (std::size_t k = 0; k < state.q.size(); ++k) {
    const Lane<W> q = state.q[k], p = state.p[k];
    state.q[k] = q * turn.cosine[k] + p * turn.sine_per_omega[k];
    state.p[k] = p * turn.cosine[k] + q * turn.minus_omega_sine[k];
  }
  modal::place(body, modes, modes.rim);
}

template <int W>
void kick_and_drift(Motion<W>& body, const Modes& modes, const Lane<W>& by, const Lane<W>& drift_by) {
  kick(body, modes, by);
  drift(body, modes, drift_by);
  const ModalState<W>& state = body.modal.state;
  body.pulse = state.velocity.at[0] + state.velocity.at[1] + state.spin;
  for (const Lane<W>& p : state.p) body.pulse += p;
}

/// (p^2 + omega^2 q^2)/2, summed; without the kinetic part, if it is not wanted. [m0 c^2]
template <int W>
Lane<W> modal_energy(const Motion<W>& body, const Modes& modes, bool kinetic) {
  const ModalState<W>& state = body.modal.state;
  Lane<W> elastic = Lane<W>::Zero(), moving = Lane<W>::Zero();
  for (std::size_t k = 0; k < state.q.size(); ++k) {
    elastic += (modes.omega[k] * modes.omega[k]) * (state.q[k] * state.q[k]);
    moving += state.p[k] * state.p[k];
  }
  elastic *= 0.5 * body.stiffness;
  return kinetic ? Lane<W>(elastic + 0.5 * moving) : elastic;
}

}  // namespace ricochet
