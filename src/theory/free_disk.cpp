#include "theory/free_disk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace ricochet::theory {

Numbers bessel_row(double x, int top) {
  // J_(n-1) = (2n/x) J_n - J_(n+1), downward, where it is stable, from an order so far above x and top that J is 1e-17
  // of J_top there. Then 1 = J_0 + 2 (J_2 + J_4 + ...). [Miller; Abramowitz & Stegun 1964, 9.12]
  const double reach = std::max(x, static_cast<double>(top));
  const int first = 2 * (static_cast<int>(reach + 12 * std::cbrt(reach)) / 2) + 12;
  Numbers row(static_cast<std::size_t>(top) + 1);
  double above = 0, here = 1e-290, sum = 0;
  for (int n = first; n >= 0; --n) {
    if (n <= top) row[static_cast<std::size_t>(n)] = here;
    if (n % 2 == 0) sum += n == 0 ? here : 2 * here;
    above = std::exchange(here, 2 * n / x * here - above);
  }
  for (double& J : row) J /= sum;
  return row;
}

namespace {

// J_n(x) and x J_n'(x).
struct BesselAt {
  double J, slope;
};

BesselAt bessel_at(const Numbers& row, int n, double x) {
  const auto i = static_cast<std::size_t>(n);
  return {row[i], n * row[i] - x * row[i + 1]};
}

double shear_number(double omega, double nu) { return omega * std::sqrt(2 / (1 - nu)); }

// u = grad phi + curl psi with phi = A J_n(h r) cos(n theta), psi = B J_n(k r) sin(n theta), h = Omega, k = Omega
// sqrt(2/(1 - nu)), R = 1. At the rim (u_r, u_theta) = D (A, B) and (sigma_rr, sigma_rtheta)/(2G) = T (A, B), by
// J'' = -J'/x - (1 - n^2/x^2) J [here]. The columns are scaled by positive numbers, so that nothing drowns where
// Omega << n.
struct RimMatrices {
  double D[2][2], T[2][2];
};

RimMatrices rim_matrices(int n, double k, const BesselAt& P, const BesselAt& S) {
  const double nn = static_cast<double>(n) * n, half = k * k / 2;
  const double a = 1 / std::hypot(n * P.J, P.slope), b = 1 / std::hypot(n * S.J, S.slope);
  return {{{a * P.slope, b * n * S.J}, {-a * n * P.J, -b * S.slope}},
          {{a * ((nn - half) * P.J - P.slope), b * n * (S.slope - S.J)},
           {a * n * (P.J - P.slope), b * (S.slope + (half - nn) * S.J)}}};
}

double determinant(const double (&m)[2][2]) { return m[0][0] * m[1][1] - m[0][1] * m[1][0]; }

// A free rim vibrates where `free` = det T is 0, a clamped one where `clamped` = det D is 0. K = T D^-1, symmetric, is
// the force that a rim's displacement takes; its eigenvalues fall with Omega (dK/dOmega = -2 Omega int rho u u / u u).
// One passes 0 at every frequency of the free rim and jumps from -infinity to +infinity at every one of the clamped.
// So between two frequencies  free ones - clamped ones = the change of the number of negative eigenvalues.
// [Wittrick & Williams 1971]
struct RimAt {
  double free, clamped;
  int negative;
};

RimAt rim_at(const ModeFamily& family, double k, const BesselAt& P, const BesselAt& S) {
  const auto [D, T] = rim_matrices(family.n, k, P, S);
  if (family.n == 0) {
    const int i = family.torsion ? 1 : 0;
    return {T[i][i], D[i][i], T[i][i] / D[i][i] < 0 ? 1 : 0};
  }
  const double free = determinant(T), clamped = determinant(D);
  const double trace = (T[0][0] * D[1][1] - T[0][1] * D[1][0] + T[1][1] * D[0][0] - T[1][0] * D[0][1]) / clamped;
  return {free, clamped, free / clamped < 0 ? 1 : trace < 0 ? 2 : 0};
}

// One family of one disk, looked at one frequency after another.
class Search {
 public:
  Search(const ModeFamily& family, double nu) : family_(family), nu_(nu) {}

  // The first frequency must lie below every vibration: only what moves rigidly, at frequency 0, may lie below it.
  void begin(double omega, const RimAt& rim) {
    const int rigid = family_.n == 1 || family_.torsion ? 1 : 0;
    if (rim.negative != rigid)
      throw std::logic_error(fmt::format("free disk: nu = {}, n = {} vibrates below {}", nu_, family_.n, omega));
    last_ = omega;
    at_last_ = rim;
  }

  void advance(double omega, const RimAt& rim) {
    search(last_, at_last_, omega, rim);
    last_ = omega;
    at_last_ = rim;
  }

  RimAt at(double omega) const {
    const double k = shear_number(omega, nu_);
    const int n = family_.n;
    return rim_at(family_, k, bessel_at(bessel_row(omega, n + 1), n, omega), bessel_at(bessel_row(k, n + 1), n, k));
  }

  bool begun() const { return last_ > 0; }
  const ModeFamily& family() const { return family_; }
  const Numbers& found() const { return found_; }

 private:
  void search(double low, const RimAt& at_low, double high, const RimAt& at_high) {
    const bool free = (at_low.free > 0) != (at_high.free > 0);
    const bool clamped = (at_low.clamped > 0) != (at_high.clamped > 0);
    if (at_high.negative - at_low.negative == free - clamped) {
      if (free) found_.push_back(root_between([&](double omega) { return at(omega).free; }, low, high));
      return;
    }
    const double middle = 0.5 * (low + high);
    if (high - low < 1e-9)
      throw std::logic_error(fmt::format("free disk: nu = {}, n = {} near {}: lost count", nu_, family_.n, middle));
    const RimAt at_middle = at(middle);
    search(low, at_low, middle, at_middle);
    search(middle, at_middle, high, at_high);
  }

  ModeFamily family_;
  double nu_, last_ = 0;
  RimAt at_last_{};
  Numbers found_;
};

// Neighbours in one family are some tenths apart; what is closer is told apart by the count.
constexpr double stride = 0.04;

// Below every vibration of n waves, as begin() proves. Rayleigh waves round the rim are the slowest, Omega -> n c_R/c_P
// with c_R > 0.68 c_S; below nu = 0 a conformal map is softer still, and costs nothing as nu -> -1.
double lowest_searched(int n, double nu) {
  return n < 3 ? 0.2 : 0.45 * n * std::sqrt((1 - nu) / 2 * std::min(1.0, 1 + nu));
}

// Every search up to `below`, rounded up to whole strides so that no digit of a frequency depends on how far one asks.
void run(std::vector<Search>& searches, double nu, double below) {
  const int last = static_cast<int>(std::ceil(below / stride));
  for (int i = 1; i <= last; ++i) {
    const double omega = i * stride, k = shear_number(omega, nu);
    int top = -1;
    for (const Search& search : searches)
      if (omega >= lowest_searched(search.family().n, nu)) top = std::max(top, search.family().n);
    if (top < 0) continue;
    const Numbers P = bessel_row(omega, top + 1), S = bessel_row(k, top + 1);
    for (Search& search : searches) {
      const int n = search.family().n;
      if (omega < lowest_searched(n, nu)) continue;
      const RimAt rim = rim_at(search.family(), k, bessel_at(P, n, omega), bessel_at(S, n, k));
      if (search.begun())
        search.advance(omega, rim);
      else
        search.begin(omega, rim);
    }
  }
}

// The rim's amplitudes where int |u|^2 dA = pi R^2. By the change of Omega with R [here]:
//   n > 0: (U^2 + V^2 - (1 - nu^2) (U + nV)^2/Omega^2)/2 = 1;  radial: U^2 (1 - (1 - nu^2)/Omega^2) = 1;  torsion: V =
//   1
DiskMode mode_at(const ModeFamily& family, int l, double omega, double nu) {
  const int n = family.n;
  const double stretch = (1 - nu * nu) / (omega * omega);
  if (family.torsion) return {n, l, omega, 0, 1, true};
  if (n == 0) return {n, l, omega, 1 / std::sqrt(1 - stretch), 0};
  const double k = shear_number(omega, nu);
  const auto [D, T] =
      rim_matrices(n, k, bessel_at(bessel_row(omega, n + 1), n, omega), bessel_at(bessel_row(k, n + 1), n, k));
  // T (A, B) = 0: from the row that says more.
  const int row = std::abs(T[0][0]) + std::abs(T[0][1]) > std::abs(T[1][0]) + std::abs(T[1][1]) ? 0 : 1;
  const double A = -T[row][1], B = T[row][0];
  const double U = A * D[0][0] + B * D[0][1], V = A * D[1][0] + B * D[1][1];
  const double by = 1 / std::sqrt(0.5 * (U * U + V * V - stretch * (U + n * V) * (U + n * V)));
  return {n, l, omega, by * U, by * V};
}

std::vector<DiskMode> tabulated(double nu, double omega_most) {
  std::vector<Search> searches;
  for (int n = 0; lowest_searched(n, nu) < omega_most; ++n) searches.emplace_back(ModeFamily{n, false}, nu);
  searches.emplace_back(ModeFamily{0, true}, nu);
  run(searches, nu, omega_most);
  std::vector<DiskMode> modes;
  for (const Search& search : searches) {
    int l = 0;
    for (const double omega : search.found()) modes.push_back(mode_at(search.family(), ++l, omega, nu));
  }
  return modes;
}

}  // namespace

Numbers frequencies(const ModeFamily& family, double nu, double below) {
  std::vector<Search> one{Search(family, nu)};
  run(one, nu, below);
  return one[0].found();
}

std::vector<DiskMode> free_disk_modes(double nu, double omega_most) {
  struct Table {
    double omega_most = 0;
    std::vector<DiskMode> modes;
  };
  static std::map<double, Table> tables;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  Table& table = tables[nu];
  if (table.omega_most < omega_most) table = {omega_most, tabulated(nu, omega_most)};
  std::vector<DiskMode> below;
  for (const DiskMode& mode : table.modes)
    if (mode.omega < omega_most) below.push_back(mode);
  return below;
}

}  // namespace ricochet::theory
