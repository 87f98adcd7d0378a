#include "theory/disk_modes.hpp"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/bessel_prime.hpp>
#include <cmath>

namespace ricochet::theory {

Arguments<FreeDisk> FreeDisk::fields() {
  return {{{"nu", "number", "", "Poisson's ratio", {-0.9, 0.5}}, &FreeDisk::nu},
          {{"n", "integer", "", "number of nodal diameters", {0, 50}}, &FreeDisk::n},
          {{"count", "integer", "", "how many, from the lowest up", {1, 100}, "3"}, &FreeDisk::count}};
}

namespace {

// u = grad phi + curl psi with phi = A J_n(h r) cos(n theta), psi = B J_n(k r) sin(n theta), h = Omega, k = Omega
// sqrt(2/(1 - nu)), R = 1. Where the rim is free, sigma_rr = sigma_rtheta = 0 [here, by J'' = -J'/x - (1 - n^2/x^2) J]:
//   A [(n^2 - k^2/2) J(h) - h J'(h)] + B n [k J'(k) - J(k)] = 0
//   A n [J(h) - h J'(h)] + B [k J'(k) + (k^2/2 - n^2) J(k)] = 0
// For n = 0 the first alone: x J0(x) = (1 - nu) J1(x).
double free_rim(double omega, int n, double nu) {
  const double h = omega, k = omega * std::sqrt(2 / (1 - nu));
  const double Jh = boost::math::cyl_bessel_j(n, h), dh = h * boost::math::cyl_bessel_j_prime(n, h);
  const double radial = (n * n - k * k / 2) * Jh - dh;
  if (n == 0) return radial;
  const double Jk = boost::math::cyl_bessel_j(n, k), dk = k * boost::math::cyl_bessel_j_prime(n, k);
  // Divided by what both products fall with for omega << n, so that the sign does not drown in rounding.
  return (radial * (dk + (k * k / 2 - n * n) * Jk) - n * n * (dk - Jk) * (Jh - dh)) / (Jh * Jh + dh * dh / (n * n));
}

}  // namespace

Numbers disk_modes(const FreeDisk& disk) {
  checked(disk);
  const int n = static_cast<int>(disk.n);
  Numbers found;
  // Modes of one n are at least some tenths apart; for nu >= -0.9 there is none below 0.2 (n = 1 has a rigid motion at
  // 0). As nu -> -1 the lowest falls to 0.
  constexpr double step = 0.02;
  for (double low = 0.2; found.size() < static_cast<std::size_t>(disk.count); low += step)
    if ((free_rim(low, n, disk.nu) > 0) != (free_rim(low + step, n, disk.nu) > 0))
      found.push_back(root_between([&](double omega) { return free_rim(omega, n, disk.nu); }, low, low + step));
  return found;
}

}  // namespace ricochet::theory
