#pragma once
// In-plane vibrations of a free disk, in plane stress. For plane strain take nu -> nu/(1 - nu), E -> E/(1 - nu^2).
// [Love 1927; Gerl & Zippelius 1999]

#include "theory/argument.hpp"

namespace ricochet::theory {

struct FreeDisk {
  double nu = 0.3, n = 2, count = 3;
  static Arguments<FreeDisk> fields();
};

/// Omega = omega R sqrt(rho (1 - nu^2)/E) of the lowest `count` modes with n nodal diameters (n = 0: the radial ones).
Numbers disk_modes(const FreeDisk& disk);

struct DiskSpectrum {
  double nu = 0.3, omega_most = 10;
  static Arguments<DiskSpectrum> fields();
};

struct DiskModeTable {
  Numbers n, l, omega, U, V, torsion;
  static Arguments<DiskModeTable> fields();
};

/// Every mode below a frequency, with what it does at the rim.
DiskModeTable disk_mode_table(const DiskSpectrum& spectrum);

}  // namespace ricochet::theory
