// The free disk's modes, and the impact of the disk that is made of them.

#include <Eigen/Eigenvalues>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/bessel_prime.hpp>
#include <boost/math/special_functions/jacobi.hpp>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <utility>

#include "theory/disk_modes.hpp"
#include "theory/free_disk.hpp"
#include "theory/modal_disk.hpp"
#include "theory/modal_impact.hpp"

using namespace ricochet;
using namespace ricochet::theory;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace {

const double pi = 3.14159265358979323846;

using Gauss = boost::math::quadrature::gauss<double, 100>;
using FineGauss = boost::math::quadrature::gauss<double, 240>;  // exact for polynomials up to r^479

template <class F>
double integral(const F& f) {
  return Gauss::integrate(f, 0.0, 1.0);
}

double bessel(int n, double x) { return boost::math::cyl_bessel_j(n, x); }
double bessel_slope(int n, double x) { return boost::math::cyl_bessel_j_prime(n, x); }

// The mode inside the disk, from what it does at the rim.
struct Shape {
  Shape(const DiskMode& mode, double nu) : n(mode.n), h(mode.omega), k(mode.omega * std::sqrt(2 / (1 - nu))) {
    const double a = h * bessel_slope(n, h), b = n * bessel(n, k), c = -n * bessel(n, h), d = -k * bessel_slope(n, k);
    if (n == 0) {
      A = mode.torsion ? 0 : mode.U / a;
      B = mode.torsion ? mode.V / d : 0;
      return;
    }
    A = (mode.U * d - mode.V * b) / (a * d - b * c);
    B = (a * mode.V - c * mode.U) / (a * d - b * c);
  }
  double radial(double r) const { return A * h * bessel_slope(n, h * r) + B * n / r * bessel(n, k * r); }
  double tangential(double r) const { return -A * n / r * bessel(n, h * r) - B * k * bessel_slope(n, k * r); }

  int n;
  double h, k, A, B;
};

double product(const Shape& one, const Shape& other) {
  return 2 * integral([&](double r) {
           return r * (one.radial(r) * other.radial(r) + one.tangential(r) * other.tangential(r));
         });
}

// Of one nu: every mode has the disk's mass, and is orthogonal to those of its n and to what moves rigidly.
void check_norms(double nu, double omega_most) {
  std::map<std::pair<int, bool>, std::vector<Shape>> families;
  for (const DiskMode& mode : free_disk_modes(nu, omega_most))
    families[{mode.n, mode.torsion}].push_back(Shape(mode, nu));
  double worst = 0;
  for (const auto& [family, shapes] : families) {
    const double mass = family.first == 0 ? 1 : 2;  // int cos^2 is half of int 1
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        worst = std::max(worst, std::abs(product(shapes[i], shapes[j]) / mass - (i == j ? 1 : 0)));
    for (const Shape& shape : shapes) {
      const double r_turn = family.second ? integral([&](double r) { return r * r * shape.tangential(r); }) : 0;
      const double shift =
          family.first == 1 ? integral([&](double r) { return r * (shape.radial(r) - shape.tangential(r)); }) : 0;
      worst = std::max({worst, std::abs(r_turn), std::abs(shift)});
    }
  }
  INFO("nu = " << nu);
  CHECK(worst < 1e-10);
}

// Omega of n > 0 below omega_most by Rayleigh and Ritz: u_r -+ u_theta = Zernike's polynomials of order n -+ 1, which
// are orthogonal, so that `terms` of them lose no digits.
std::vector<double> by_ritz(int n, double nu, double omega_most, unsigned terms) {
  const int size = 2 * static_cast<int>(terms);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size), M = K;
  const auto add = [&](double r, double weight) {
    Eigen::VectorXd ur(size), ut(size), er(size), et(size), shear(size);
    for (int i = 0; i < size; ++i) {
      const unsigned j = static_cast<unsigned>(i) % terms;
      const int sign = i < size / 2 ? -1 : 1, power = n + sign;
      const double s = 2 * r * r - 1, P = boost::math::jacobi(j, 0.0, 1.0 * power, s),
                   dP = boost::math::jacobi_derivative(j, 0.0, 1.0 * power, s, 1u);
      const double u = std::pow(r, power) * P,
                   du = (power == 0 ? 0 : power * std::pow(r, power - 1) * P) + std::pow(r, power) * 4 * r * dP;
      ur[i] = u;
      ut[i] = sign * u;
      er[i] = du;
      et[i] = (u + n * sign * u) / r;
      shear[i] = -n * u / r + sign * du - sign * u / r;
    }
    M += weight * r * (ur * ur.transpose() + ut * ut.transpose());
    K += weight * r *
         (er * er.transpose() + et * et.transpose() + nu * (er * et.transpose() + et * er.transpose()) +
          (1 - nu) / 2 * shear * shear.transpose());
  };
  for (std::size_t i = 0; i < FineGauss::abscissa().size(); ++i)
    for (const double x : {FineGauss::abscissa()[i], -FineGauss::abscissa()[i]})
      add(0.5 * (1 + x), 0.5 * FineGauss::weights()[i]);
  const Eigen::VectorXd squares = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M).eigenvalues();
  std::vector<double> found;
  for (const double square : squares)
    if (square > 1e-6 && square < omega_most * omega_most) found.push_back(std::sqrt(square));
  return found;
}

void check_complete(double nu, double omega_most, unsigned terms) {
  std::map<int, std::vector<double>> table;
  for (const DiskMode& mode : free_disk_modes(nu, omega_most))
    if (mode.n > 0) table[mode.n].push_back(mode.omega);
  const int top = table.rbegin()->first;
  for (int n = 1; n <= top + 1; ++n) {
    INFO("nu = " << nu << ", n = " << n);
    const std::vector<double> expected = by_ritz(n, nu, omega_most, terms);
    REQUIRE(table[n].size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK_THAT(table[n][i], WithinRel(expected[i], 1e-9));
  }
}

std::vector<DiskMode> symmetric_modes(double nu, double omega_most) {
  std::vector<DiskMode> modes = free_disk_modes(nu, omega_most);
  std::erase_if(modes, [](const DiskMode& mode) { return mode.torsion; });
  return modes;
}

ModalImpact finished(double nu, double speed, double alpha, double omega_most, double longer = 1) {
  ModalImpact impact(symmetric_modes(nu, omega_most), speed, alpha, longer);
  impact.run();
  return impact;
}

double e_of(double nu, double speed, double alpha, double omega_most, double longer = 1) {
  return finished(nu, speed, alpha, omega_most, longer).restitution();
}

double sum(const Numbers& list) {
  double all = 0;
  for (const double x : list) all += x;
  return all;
}

std::string complaint(const ModalDisk& impact) {
  try {
    modal_disk(impact);
  } catch (const FieldError& error) {
    return error.field + ": " + error.what();
  }
  return "none";
}

struct Reference {
  double speed;
  std::array<double, 2> e, contact_time;  // nu = 0.1 and 0.33
};

// Table 1: alpha = 1000, all modes below 40. [computed by an independent program]
constexpr double table_1[][3] = {{0.01, 0.986811, 0.988642}, {0.02, 0.981691, 0.988807}, {0.05, 0.975619, 0.974787},
                                 {0.1, 0.963251, 0.943854},  {0.2, 0.9234, 0.8807},      {0.3, 0.8892, 0.8320}};

// Table 2: near the rigid wall, all modes below 80, alpha = max(100/speed, 1000).
constexpr Reference table_2[] = {{0.01, {0.9802, 0.9849}, {7.593, 7.822}}, {0.02, {0.9785, 0.9860}, {7.090, 7.405}},
                                 {0.05, {0.9748, 0.9740}, {6.424, 6.808}}, {0.1, {0.9640, 0.9450}, {5.944, 6.352}},
                                 {0.2, {0.9245, 0.8820}, {5.428, 5.847}},  {0.3, {0.8902, 0.8337}, {5.105, 5.480}}};

void check_table_1(double up_to) {
  for (const auto& [speed, softer, harder] : table_1) {
    if (speed > up_to) continue;
    INFO("speed " << speed);
    const double tolerance = speed > 0.1 ? 1e-3 : 2e-5;
    CHECK_THAT(e_of(0.1, speed, 1000, 40), WithinAbs(softer, tolerance));
    CHECK_THAT(e_of(0.33, speed, 1000, 40), WithinAbs(harder, tolerance));
  }
}

}  // namespace

TEST_CASE("a row of Bessel functions is Boost's, order by order") {
  for (const double x : {0.2, 3.0, 40.0, 100.0, 160.0}) {
    const int top = static_cast<int>(1.5 * x) + 5;
    const Numbers row = bessel_row(x, top);
    for (int n = 0; n <= top; ++n) {
      INFO("J_" << n << "(" << x << ")");
      CHECK_THAT(row[static_cast<std::size_t>(n)], WithinAbs(bessel(n, x), 1e-15));
    }
    CHECK_THAT(row.back(), WithinRel(bessel(top, x), 1e-13));
  }
}

TEST_CASE("every mode of the free disk has the disk's mass and is orthogonal to the others and to rigid motion") {
  for (const double nu : {0.1, 0.3, 0.45}) check_norms(nu, 10);
}

TEST_CASE("eight hundred modes have the disk's mass and are orthogonal", "[.slow]") {
  for (const double nu : {0.1, 0.3, 0.45}) check_norms(nu, 40);
}

TEST_CASE("frequencies and rim amplitudes of the disk's lowest modes, nu = 0.3") {
  const std::map<std::pair<int, int>, std::array<double, 3>> expected{
      {{0, 1}, {2.048850, 1.129948, 0}},          {{0, 2}, {5.389364, 1.016043, 0}},
      {{1, 1}, {1.617558, -0.483605, -1.960574}}, {{1, 2}, {3.529116, -1.407649, -0.545105}},
      {{2, 1}, {1.387653, -1.392441, 0.435470}},  {{2, 2}, {2.511179, -0.179371, -2.285905}},
      {{2, 3}, {4.520783, 1.056299, 1.186546}},   {{3, 1}, {2.130399, -1.617292, -0.045996}},
      {{4, 1}, {2.774004, -1.763702, -0.371411}}};
  const DiskModeTable table = disk_mode_table({0.3, 6});
  std::size_t seen = 0;
  for (std::size_t i = 0; i < table.n.size(); ++i) {
    const auto found = expected.find({static_cast<int>(table.n[i]), static_cast<int>(table.l[i])});
    if (found == expected.end()) continue;
    ++seen;
    INFO("n = " << table.n[i] << ", l = " << table.l[i]);
    const auto& [omega, U, V] = found->second;
    const double sign = U * table.U[i] > 0 ? 1 : -1;
    CHECK_THAT(table.omega[i], WithinAbs(omega, 1e-6));
    CHECK_THAT(sign * table.U[i], WithinAbs(U, 1e-6));
    CHECK_THAT(sign * table.V[i], WithinAbs(V, 1e-6));
  }
  CHECK(seen == expected.size());
}

TEST_CASE("torsion of the disk has the roots of J_2") {
  for (const double nu : {-0.2, 0.1, 0.45}) {
    const Numbers torsion = disk_mode_table({nu, 20}).torsion;
    REQUIRE(torsion.size() > 3);
    for (std::size_t i = 0; i < torsion.size(); ++i)
      CHECK_THAT(
          torsion[i],
          WithinRel(boost::math::cyl_bessel_j_zero(2.0, static_cast<int>(i) + 1) * std::sqrt((1 - nu) / 2), 1e-13));
  }
}

TEST_CASE("no mode of the disk is missed, and none invented: Rayleigh and Ritz find the same") {
  for (const double nu : {-0.5, 0.33, 0.5}) check_complete(nu, 12, 24);
}

TEST_CASE("no mode of the disk below 40 is missed", "[.slow]") {
  for (const double nu : {-0.3, 0.0, 0.17, 0.33, 0.45}) check_complete(nu, 40, 60);
}

TEST_CASE("the number of modes below 40 and below 80 is that of a fine scan of the determinant") {
  const std::array<std::pair<double, std::size_t>, 4> below_40{{{0.1, 675}, {0.25, 764}, {0.33, 828}, {0.45, 961}}};
  for (const auto& [nu, count] : below_40) CHECK(symmetric_modes(nu, 40).size() == count);
  CHECK(symmetric_modes(0.33, 80).size() == 3247);
}

TEST_CASE("a frequency's digits do not depend on how far the table reaches, nor on what was asked before") {
  const auto before = free_disk_modes(0.2345, 13.3), after = free_disk_modes(0.2345, 25),
             again = free_disk_modes(0.2345, 13.3);
  CHECK(before.size() < after.size());
  REQUIRE(before.size() == again.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(before[i].omega == again[i].omega);
    CHECK(before[i].V == again[i].V);
  }
}

TEST_CASE("the disk's modes give the reference restitution, alpha = 1000, modes below 40") { check_table_1(0.05); }

TEST_CASE("the disk's modes give the reference restitution up to 0.3 c", "[.slow]") { check_table_1(0.3); }

TEST_CASE("other disks and speeds rebound as an independent program has them") {
  CHECK_THAT(e_of(0.25, 0.07, 2500, 30), WithinAbs(0.966156, 2e-5));
  CHECK_THAT(e_of(0.4, 0.015, 1000, 40), WithinAbs(0.989490, 2e-5));
  CHECK_THAT(e_of(0, 0.04, 1000, 40), WithinAbs(0.973138, 2e-5));
}

TEST_CASE("near the rigid wall the disk rebounds and leaves as the reference has it", "[.slow]") {
  for (const auto& [speed, e, contact_time] : table_2)
    for (const std::size_t i : {0, 1}) {
      const double nu = i == 0 ? 0.1 : 0.33;
      INFO("speed " << speed << ", nu " << nu);
      const ModalImpact impact = finished(nu, speed, std::max(100 / speed, 1000.0), 80);
      CHECK_THAT(impact.restitution(), WithinAbs(e[i], speed > 0.1 ? 1e-3 : 7e-5));
      CHECK_THAT(impact.contact_time(), WithinAbs(contact_time[i], speed > 0.1 ? 1e-2 : 3e-3));
    }
}

TEST_CASE("what the disk loses its modes have, and half the step changes e by less than 1e-5") {
  for (const auto& [nu, speed] : {std::pair{0.33, 0.05}, {0.1, 0.02}}) {
    const ModalImpact impact = finished(nu, speed, 1000, 40);
    const double e = impact.restitution();
    CHECK_THAT(e * e + sum(impact.mode_energies()) + impact.wall_energy(), WithinAbs(1, 1e-6));
    CHECK_THAT(impact.ledger(), WithinAbs(0, 1e-6));
    CHECK_THAT(e_of(nu, speed, 1000, 40, 0.5), WithinAbs(e, 1e-5));
  }
}

TEST_CASE("e converges with modes and with the wall as the reference has it", "[.slow]") {
  const std::pair<double, double> fast[] = {{5, 0.92574}, {10, 0.93226}, {20, 0.94241}, {40, 0.94385}, {80, 0.94503}};
  const std::pair<double, double> slow[] = {{5, 0.98014}, {10, 0.98653}, {20, 0.98873}, {40, 0.98864}, {80, 0.98860}};
  for (const auto& [omega_most, e] : fast) CHECK_THAT(e_of(0.33, 0.1, 1000, omega_most, 0.5), WithinAbs(e, 5e-5));
  for (const auto& [omega_most, e] : slow) CHECK_THAT(e_of(0.33, 0.01, 1000, omega_most, 0.5), WithinAbs(e, 5e-5));
  const std::pair<double, double> fast_walls[] = {{300, 0.95146}, {1000, 0.94503}, {3000, 0.94329}, {10000, 0.94211}};
  const std::pair<double, double> slow_walls[] = {{1000, 0.98860}, {3000, 0.98605}, {1e4, 0.98493}, {3e4, 0.98463}};
  for (const auto& [alpha, e] : fast_walls) CHECK_THAT(e_of(0.33, 0.1, alpha, 80, 0.25), WithinAbs(e, 5e-5));
  for (const auto& [alpha, e] : slow_walls) CHECK_THAT(e_of(0.33, 0.01, alpha, 80, 1), WithinAbs(e, 5e-5));
}

TEST_CASE("at 0.1 c the disk's energy is left to the waves of two, three and four") {
  const ModalRebound rebound = modal_disk({0.33, 0.1, 1000, 40});
  const std::map<std::pair<int, int>, double> expected{{{2, 1}, 0.391}, {{3, 1}, 0.142}, {{4, 1}, 0.141},
                                                       {{0, 1}, 0.063}, {{6, 1}, 0.037}, {{5, 1}, 0.024},
                                                       {{8, 1}, 0.019}, {{1, 1}, 0.012}};
  const double vibration = sum(rebound.energy);
  std::array<double, 5> by_n{};
  for (std::size_t i = 0; i < rebound.n.size(); ++i) {
    const auto n = static_cast<std::size_t>(rebound.n[i]);
    if (n < by_n.size()) by_n[n] += rebound.energy[i] / vibration;
    const auto found = expected.find({static_cast<int>(n), static_cast<int>(rebound.l[i])});
    if (found != expected.end()) CHECK_THAT(rebound.energy[i] / vibration, WithinAbs(found->second, 0.002));
  }
  const std::array<double, 5> shares{0.064, 0.023, 0.403, 0.154, 0.155};
  for (std::size_t n = 0; n < shares.size(); ++n) CHECK_THAT(by_n[n], WithinAbs(shares[n], 0.002));
  CHECK_THAT(rebound.ledger, WithinAbs(0, 1e-6));
  // Twice the modes, and half the step, change e by no more than it says.
  CHECK(std::abs(e_of(0.33, 0.1, 1000, 80) - rebound.e) < rebound.error_modes);
  CHECK(std::abs(e_of(0.33, 0.1, 1000, 40, 0.5) - rebound.e) < rebound.error_step);
  CHECK(rebound.error_step < 1e-5);
  CHECK_THAT(rebound.error_alpha, WithinAbs(e_of(0.33, 0.1, 500, 40) - rebound.e, 1e-15));
}

TEST_CASE("where the rim chatters on the wall the step is halved until the energy is kept") {
  const ModalDisk impact{0, 0.1, 3600, 20};  // twice the chosen step loses it
  REQUIRE(std::abs(finished(impact.nu, impact.speed, impact.alpha, impact.omega_most, 2).ledger()) > 1e-6);
  const ModalRebound rebound = modal_disk(impact);
  CHECK_THAT(rebound.ledger, WithinAbs(0, 1e-6));
  CHECK_THAT(rebound.e * rebound.e + sum(rebound.energy), WithinAbs(1, 1e-6));
  // No step is fine enough for the digits of such an e, but they are within the error by the modes left out.
  for (const double longer : {0.25, 0.125, 0.0625})
    CHECK_THAT(e_of(impact.nu, impact.speed, impact.alpha, impact.omega_most, longer),
               WithinAbs(rebound.e, rebound.error_modes));
}

TEST_CASE("an impact turned about runs back to where it began") {
  ModalImpact impact(symmetric_modes(0.33, 20), 0.1, 1000);
  const double start = impact.height();
  impact.run();
  impact.reverse();
  const long steps = impact.steps();
  for (long i = 0; i < steps; ++i) impact.step();
  CHECK_THAT(impact.height(), WithinAbs(start, 1e-9));
  CHECK_THAT(impact.restitution(), WithinAbs(1, 1e-9));
  for (const double energy : impact.mode_energies()) CHECK(energy < 1e-18);
}

TEST_CASE("a modal disk that cannot be computed says which field to change, and how") {
  CHECK(complaint({0.3, 0.005, 100, 40}).starts_with("alpha: must be at least 1/speed = 200, is 100"));
  CHECK(complaint({0.3, 0.1, 2e5, 40}).starts_with("omega_most: is too small for alpha = 200000"));
  CHECK(complaint({0.3, 0.1, 1000, 1.2}).starts_with("omega_most: must be above the lowest mode"));
  CHECK(complaint({0.3, 0.31, 1000, 40}).starts_with("speed: must be at least 0.0001 and at most 0.3, is 0.31"));
  CHECK(complaint({0.3, 0, 1000, 40}).starts_with("speed: must be"));
  CHECK(complaint({0.6, 0.1, 1000, 40}).starts_with("nu: must be"));
}

TEST_CASE("within its ranges the modal disk keeps its energy, or names the field that is wrong") {
  std::mt19937_64 engine(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  int computed = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const ModalDisk impact{uniform(-0.5, 0.5), std::exp(uniform(std::log(1e-4), std::log(0.3))),
                           std::exp(uniform(std::log(50), std::log(3000))), uniform(1, 15)};
    INFO("nu = " << impact.nu << ", speed = " << impact.speed << ", alpha = " << impact.alpha
                 << ", omega_most = " << impact.omega_most);
    try {
      const ModalRebound rebound = modal_disk(impact);
      ++computed;
      CHECK((rebound.e > 0 && rebound.e < 1 && rebound.contact_time > 0));
      CHECK_THAT(rebound.ledger, WithinAbs(0, 1e-6));
    } catch (const FieldError& error) {
      CHECK((error.field == "alpha" || error.field == "omega_most"));
    }
  }
  CHECK(computed > 10);
}

TEST_CASE("how long the disk's modes and impacts take", "[.benchmark]") {
  auto seconds = [start = std::chrono::steady_clock::now()]() mutable {
    const auto before = std::exchange(start, std::chrono::steady_clock::now());
    return std::chrono::duration<double>(start - before).count();
  };
  const std::size_t modes = free_disk_modes(0.31, 80).size();
  std::printf("%zu modes below 80: %.3f s\n", modes, seconds());
  free_disk_modes(0.31, 40);
  seconds();
  const double e = e_of(0.31, 0.1, 1000, 40);
  std::printf("impact of %zu modes at 0.1 c: e = %.6f, %.3f s\n", symmetric_modes(0.31, 40).size(), e, seconds());
  const double again = modal_disk({0.31, 0.1, 1000, 40}).e;
  std::printf("the same with its three errors: %.3f s\n", seconds());
  CHECK(again == e);
}

TEST_CASE("tables of the disk's restitution and contact time", "[.table]") {
  std::printf("alpha = 1000, modes below 40, then near the rigid wall: modes below 80, alpha = max(100/speed, 1000)\n");
  std::printf("%8s %8s %10s %12s %10s %8s %18s\n", "speed", "nu", "e", "error_step", "e", "t_c", "pi sqrt(ln 4c/v)");
  for (const auto& row : table_1)
    for (const double nu : {0.1, 0.33}) {
      const double speed = row[0];
      const ModalRebound soft = modal_disk({nu, speed, 1000, 40});
      const ModalImpact hard = finished(nu, speed, std::max(100 / speed, 1000.0), 80);
      CHECK_THAT(soft.ledger, WithinAbs(0, 1e-6));
      std::printf("%8g %8g %10.6f %12.1e %10.5f %8.4f %18.3f\n", speed, nu, soft.e, soft.error_step, hard.restitution(),
                  hard.contact_time(), pi * std::sqrt(std::log(4 / speed)));
    }
}
