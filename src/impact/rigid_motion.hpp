#pragma once
#include "force/springs.hpp"

namespace ricochet {

/// Momentum, angular momentum and their energies of a body, in W lanes.
template <int W>
struct RigidMotion {
  Lane<W> x, y, vx, vy, omega;    ///< centre of mass, its velocity, L / I of the body as deformed
  Lane<W> spin;                   ///< L / I of the body at rest: once free, it keeps its value while the body vibrates
  Lane<W> translation, rotation;  ///< energies [m0 c^2]
};

/// An anchored body has no rigid motion: all its energy is vibration, its centre the mean of its nodes at rest.
template <int W>
RigidMotion<W> rigid_motion(const Moving<W>& body) {
  const Lattice& lattice = *body.lattice;
  const NodeVectors<W>& position = body.position;
  RigidMotion<W> motion;
  motion.x = motion.y = motion.vx = motion.vy = motion.omega = motion.spin = Lane<W>::Zero();
  motion.translation = motion.rotation = Lane<W>::Zero();
  if (lattice.anchored()) {
    const Vec2 centre = lattice.centre();
    motion.x.setConstant(centre.x());
    motion.y.setConstant(centre.y());
  } else {
    const int n = lattice.nodes();
    for (int i = 0; i < n; ++i) {
      motion.x += position.x(i);
      motion.y += position.y(i);
      motion.vx += body.velocity.x(i);
      motion.vy += body.velocity.y(i);
    }
    motion.x /= n;
    motion.y /= n;
    motion.vx /= n;
    motion.vy /= n;
    Lane<W> momentum = Lane<W>::Zero(), inertia = Lane<W>::Zero();
    for (int i = 0; i < n; ++i) {
      const Lane<W> dx = position.x(i) - motion.x, dy = position.y(i) - motion.y;
      momentum += dx * (body.velocity.y(i) - motion.vy) - dy * (body.velocity.x(i) - motion.vx);
      inertia += dx * dx + dy * dy;
    }
    motion.omega = momentum / inertia;
    motion.spin = lattice.mass * momentum / lattice.inertia();
    motion.translation = 0.5 * lattice.total_mass() * (motion.vx * motion.vx + motion.vy * motion.vy);
    motion.rotation = 0.5 * lattice.mass * momentum * motion.omega;
  }
  return motion;
}

/// Kinetic energy relative to the rigid motion, and that of the springs. [m0 c^2]
template <int W>
Lane<W> vibration_energy(const Moving<W>& body, const RigidMotion<W>& motion) {
  const Lattice& lattice = *body.lattice;
  const NodeVectors<W>& position = body.position;
  // Summed as squares: no difference of large numbers.
  Lane<W> kinetic = Lane<W>::Zero();
  for (int i = 0; i < lattice.free; ++i) {
    const Lane<W> dvx = body.velocity.x(i) - motion.vx + motion.omega * (position.y(i) - motion.y);
    const Lane<W> dvy = body.velocity.y(i) - motion.vy - motion.omega * (position.x(i) - motion.x);
    kinetic += dvx * dvx + dvy * dvy;
  }
  return 0.5 * lattice.mass * kinetic + spring_energy(body);
}

}  // namespace ricochet
