#pragma once
// In-plane vibrations of a free disk, in plane stress, with n nodal diameters. [Love 1927; Gerl & Zippelius 1999]

#include "theory/argument.hpp"

namespace ricochet::theory {

struct FreeDisk {
  double nu = 0.3, n = 2, count = 3;
  static Arguments<FreeDisk> fields();
};

/// Omega = omega R sqrt(rho (1 - nu^2)/E) of the lowest `count` modes (n = 0: the radial ones). For plane strain take
/// nu -> nu/(1 - nu), E -> E/(1 - nu^2).
Numbers disk_modes(const FreeDisk& disk);

}  // namespace ricochet::theory
