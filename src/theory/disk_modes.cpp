#include "theory/disk_modes.hpp"

#include "theory/free_disk.hpp"

namespace ricochet::theory {

Arguments<FreeDisk> FreeDisk::fields() {
  return {{{"nu", "number", "", "Poisson's ratio", {-0.9, 0.5}}, &FreeDisk::nu},
          {{"n", "integer", "", "number of nodal diameters", {0, 50}}, &FreeDisk::n},
          {{"count", "integer", "", "how many, from the lowest up", {1, 100}, "3"}, &FreeDisk::count}};
}

Numbers disk_modes(const FreeDisk& disk) {
  checked(disk);
  const auto count = static_cast<std::size_t>(disk.count);
  Numbers found;
  for (double below = disk.n + 4; found.size() < count; below *= 1.5)
    found = frequencies({.n = static_cast<int>(disk.n)}, disk.nu, below);
  found.resize(count);
  return found;
}

Arguments<DiskSpectrum> DiskSpectrum::fields() {
  return {
      {{"nu", "number", "", "Poisson's ratio", {-0.5, 0.5}}, &DiskSpectrum::nu},
      {{"omega_most", "number", "", "all modes with omega R/c_P below it", {1, 160}, "10"}, &DiskSpectrum::omega_most}};
}

Arguments<DiskModeTable> DiskModeTable::fields() {
  using S = DiskModeTable;
  return {{{"n", "numbers", "", "nodal diameters"}, &S::n},
          {{"l", "numbers", "", "place among those of the same n, from 1"}, &S::l},
          {{"omega", "numbers", "", "Omega = omega R/c_P"}, &S::omega},
          {{"U", "numbers", "", "radial amplitude at the rim, of a mode of the disk's mass"}, &S::U},
          {{"V", "numbers", "", "tangential amplitude there"}, &S::V},
          {{"torsion", "numbers", "", "Omega of the modes of torsion, for which U = 0 and V = 1"}, &S::torsion}};
}

DiskModeTable disk_mode_table(const DiskSpectrum& spectrum) {
  checked(spectrum);
  DiskModeTable table;
  for (const DiskMode& mode : free_disk_modes(spectrum.nu, spectrum.omega_most)) {
    if (mode.torsion) {
      table.torsion.push_back(mode.omega);
      continue;
    }
    table.n.push_back(mode.n);
    table.l.push_back(mode.l);
    table.omega.push_back(mode.omega);
    table.U.push_back(mode.U);
    table.V.push_back(mode.V);
  }
  return table;
}

}  // namespace ricochet::theory
