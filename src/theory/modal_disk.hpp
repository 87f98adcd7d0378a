#pragma once
// Head-on impact of an elastic disk on a hard smooth wall, by the disk's modes: exact within linear elasticity.
// [Gerl & Zippelius 1999]

#include "theory/argument.hpp"

namespace ricochet::theory {

/// Speed over c_P = sqrt(E/(rho (1 - nu^2))); plane stress. The wall is exp(-alpha y), and the disk all its modes with
/// Omega = omega R/c_P below omega_most.
struct ModalDisk {
  double nu = 0.3, speed = 0.1, alpha = 1000, omega_most = 40;
  static Arguments<ModalDisk> fields();
};

struct ModalRebound {
  double e, contact_time, error_modes, error_alpha, error_step, ledger, steps;
  Numbers n, l, omega, energy;
  static Arguments<ModalRebound> fields();
};

/// The impact, and three more that tell how far it is converged. With modes up to omega_most e is off by about
/// 0.07/omega_most, so that half of omega_most doubles the error and the difference of the two is the error itself; of
/// a method of second order the step's is a third of the difference from twice the step. Half of alpha is a wall twice
/// as soft. Where a step does not keep the energy to 1e-6 (the rim chatters), it is halved. Throws FieldError where
/// alpha is too hard for the modes or too soft for the speed.
ModalRebound modal_disk(const ModalDisk& impact);

}  // namespace ricochet::theory
