#pragma once
// A free elastic disk, as the sum of its modes, against an exponential wall. [Gerl & Zippelius 1999]
//
//   H = P^2/2M + sum (p^2/2M + M omega^2 Q^2/2) + V0 int exp(-alpha y(theta)) dtheta,
//   y = Y - cos(theta) (1 + sum U Q cos(n theta)) + sin(theta) sum V Q sin(n theta),
//
// theta from the lowest point, Y the height of the centre. R = c_P = rho = 1, M = pi; energies in that of the incident
// disk, E_0. A head-on impact on a smooth wall excites one of each pair of modes, and no torsion.

#include <vector>

#include "theory/free_disk.hpp"

namespace ricochet::theory {

class ModalImpact {
 public:
  /// `modes` in the order of free_disk_modes(), without torsion. The disk comes down at `speed`, at rest within itself,
  /// from where V is 1e-12. The wall's place (V0 only shifts it) is so that the round disk has V = 1e-6 at Y = 1.
  /// The step is that which gives e to 1e-5 up to a speed of 0.1, times `longer`.
  ModalImpact(const std::vector<DiskMode>& modes, double speed, double alpha, double longer = 1);

  /// Kick, rotate, kick: every oscillator is turned exactly, so that none limits the step.
  void step();

  /// Until the disk is off the wall: V below 1e-12, the centre rising and above where it touched. Too long a step for
  /// the wall ends it too, by more energy than there is: see ledger().
  void run();

  /// Every velocity turned about: the steps that follow retrace those before.
  void reverse();

  double restitution() const { return rise_ / speed_; }
  double height() const { return height_; }
  double wall_energy() const;
  Numbers mode_energies() const;  ///< in the order of `modes`
  double ledger() const;          ///< all energy less that of the incident disk: 0 but for what the step loses
  double contact_time() const { return last_touch_ - first_touch_; }  ///< while V > 1e-6, the soft wall's tail included
  long steps() const { return steps_; }

 private:
  // Of a mode: omega Q, dQ/dt and how they turn in a step; Q adds lower Q to wave `below` of the rim's height and upper
  // Q to wave `above`.
  struct Oscillator {
    double omega, x, v, cosine, sine, lower, upper;
    std::size_t below, above;
  };

  void tabulate(double n_most);
  void push();
  void kick(double time);
  void drift();
  void watch(double before);

  double speed_, alpha_, step_ = 0;
  double height_, rise_;  // Y, dY/dt
  std::vector<Oscillator> modes_;
  std::size_t waves_ = 0, points_ = 0;
  double strength_ = 0;                                   // acceleration of the disk by a point at y = 0
  Numbers by_wave_, by_point_;                            // cos(m theta) as [wave][point] and as [point][wave]
  Numbers height_waves_, heights_, pushes_, push_waves_;  // y and the acceleration, at the points and as cosines
  double first_touch_ = 0, last_touch_ = 0;
  bool touched_ = false;
  long steps_ = 0;
};

}  // namespace ricochet::theory
