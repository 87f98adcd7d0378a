#pragma once
// The free disk's in-plane vibrations in plane stress: every mode below a frequency, with what it does at the rim.
// Lengths in R, speeds in c_P = sqrt(E/(rho (1 - nu^2))), so that Omega = omega R/c_P. [Love 1927; Gerl & Zippelius
// 1999]
//
// u_r = U(r) cos(n theta), u_theta = V(r) sin(n theta); turned by a quarter of a wave it is another mode of the same
// Omega. For n = 0 what is radial (V = 0) and what is torsion (U = 0) part.

#include <vector>

#include "theory/argument.hpp"

namespace ricochet::theory {

/// J_0(x), ..., J_top(x), to some 1e-15 of the greatest of them. x >= 0.1, and top so far above x at most that J_top(x)
/// is a number of normal size.
Numbers bessel_row(double x, int top);

/// Modes of n nodal diameters; those of n = 0 are radial or of torsion.
struct ModeFamily {
  int n = 0;
  bool torsion = false;
};

/// Omega of the modes of a family in the order of frequency: all below `below` at least, and none left out. Each
/// interval searched is proved complete by the count that rim_at() in the source describes; std::logic_error if one
/// cannot be. -0.9 <= nu <= 0.5, n <= 50 if nu < -0.5.
Numbers frequencies(const ModeFamily& family, double nu, double below);

struct DiskMode {
  int n, l;      ///< nodal diameters; the place in its family, from 1
  double omega;  ///< Omega
  double U, V;   ///< u_r/cos(n theta) and u_theta/sin(n theta) at the rim, where the mode's mass is the disk's
  bool torsion = false;
};

/// Every mode with Omega < omega_most, by n and then by Omega, torsion last; -0.5 <= nu <= 0.5, omega_most <= 160.
/// Tabulated once for each nu and kept; from any thread.
std::vector<DiskMode> free_disk_modes(double nu, double omega_most);

}  // namespace ricochet::theory
