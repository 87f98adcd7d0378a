#pragma once
#include "body/interior.hpp"

namespace ricochet {

/// Three components in W lanes.
template <int W>
using Space = Place<W, 3>;

/// Momentum, angular momentum and their energies of a body, in W lanes. In the plane z and all turnings but those about
/// z are 0; a body of revolution moves along its axis alone.
template <int W>
struct RigidMotion {
  Space<W> centre, velocity;      ///< of mass
  Space<W> turning;               ///< L / I of the body as deformed
  Space<W> spin;                  ///< L / I of the body at rest: once free, it keeps its value while it vibrates
  Lane<W> translation, rotation;  ///< energies [m0 c^2]
};

template <int W>
RigidMotion<W> no_motion() {
  RigidMotion<W> none;
  for (Space<W>* v : {&none.centre, &none.velocity, &none.turning, &none.spin}) v->set_zero();
  none.translation = none.rotation = Lane<W>::Zero();
  return none;
}

/// Of a free body of modes it is that of its frame.
template <int W>
RigidMotion<W> rigid_motion_of_frame(const Motion<W>& body, const Modes& modes) {
  const ModalState<W>& state = body.modal.state;
  RigidMotion<W> motion = no_motion<W>();
  for (int d = 0; d < 2; ++d) {
    motion.centre.at[d] = state.centre.at[d];
    motion.velocity.at[d] = state.velocity.at[d];
  }
  motion.turning.at[2] = motion.spin.at[2] = state.spin;
  motion.translation = 0.5 / modes.per_mass * dot(state.velocity, state.velocity);
  motion.rotation = 0.5 / modes.per_inertia * (state.spin * state.spin);
  return motion;
}

/// A held body has no rigid motion: all its energy is vibration, its centre the mean of its nodes at rest.
template <int W>
RigidMotion<W> rigid_motion(const Motion<W>& body) {
  const Solid& solid = *body.solid;
  RigidMotion<W> motion = no_motion<W>();
  if (solid.anchored()) {
    const Vec2 centre = solid.centre();
    for (int d = 0; d < 2; ++d) motion.centre.at[d].setConstant(centre[d]);
    return motion;
  }
  if (const Modes* modes = solid.modes()) return rigid_motion_of_frame(body, *modes);
  // Where all nodes have the same mass it stands outside the sums.
  const bool uniform = solid.mass.uniform();
  const double outside = uniform ? solid.mass.each() : 1, whole = uniform ? solid.nodes() : solid.total_mass();
  const auto weight = [&](int i) { return uniform ? 1.0 : solid.mass[i]; };
  const Place<W, 2>*position = body.q.template places<2>(), *velocity = body.v.template places<2>();
  for (int i = 0; i < solid.nodes(); ++i)
    for (int d = 0; d < 2; ++d) {
      motion.centre.at[d] += weight(i) * position[i].at[d];
      motion.velocity.at[d] += weight(i) * velocity[i].at[d];
    }
  for (int d = 0; d < 2; ++d) {
    motion.centre.at[d] /= whole;
    motion.velocity.at[d] /= whole;
  }
  if (solid.axisymmetric) {
    motion.centre.at[0].setZero();
    motion.velocity.at[0].setZero();
    motion.translation = 0.5 * whole * motion.velocity.at[1] * motion.velocity.at[1];
    return motion;
  }
  Lane<W> momentum = Lane<W>::Zero(), inertia = Lane<W>::Zero();
  const Space<W>&centre = motion.centre, &mean = motion.velocity;
  for (int i = 0; i < solid.nodes(); ++i) {
    const Lane<W> dx = position[i].at[0] - centre.at[0], dy = position[i].at[1] - centre.at[1];
    momentum += weight(i) * (dx * (velocity[i].at[1] - mean.at[1]) - dy * (velocity[i].at[0] - mean.at[0]));
    inertia += weight(i) * (dx * dx + dy * dy);
  }
  motion.turning.at[2] = momentum / inertia;
  motion.spin.at[2] = solid.spin_of(Lane<W>(outside * momentum));
  motion.translation = 0.5 * solid.total_mass() * dot(mean, mean);
  motion.rotation = 0.5 * outside * momentum * motion.turning.at[2];
  return motion;
}

/// Kinetic energy relative to the rigid motion, and that of the interior. [m0 c^2]
template <int W>
Lane<W> vibration_energy(const Motion<W>& body, const RigidMotion<W>& motion) {
  const Solid& solid = *body.solid;
  if (const Modes* modes = solid.modes()) return modal_energy(body, *modes, true);
  const Place<W, 2>*position = body.q.template places<2>(), *velocity = body.v.template places<2>();
  const Lane<W> turning = motion.turning.at[2];
  // Summed as squares: no difference of large numbers.
  Lane<W> kinetic = Lane<W>::Zero();
  for (int i = 0; i < solid.free; ++i) {
    const Lane<W> dvx = velocity[i].at[0] - motion.velocity.at[0] + turning * (position[i].at[1] - motion.centre.at[1]);
    const Lane<W> dvy = velocity[i].at[1] - motion.velocity.at[1] - turning * (position[i].at[0] - motion.centre.at[0]);
    const Lane<W> square = dvx * dvx + dvy * dvy;
    kinetic += solid.mass.uniform() ? square : Lane<W>(solid.mass[i] * square);
  }
  const double outside = solid.mass.uniform() ? solid.mass.each() : 1;
  return 0.5 * outside * kinetic + interior_energy(body);
}

}  // namespace ricochet
