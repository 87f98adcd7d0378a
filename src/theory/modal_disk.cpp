#include "theory/modal_disk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "theory/modal_impact.hpp"

namespace ricochet::theory {

Arguments<ModalDisk> ModalDisk::fields() {
  using S = ModalDisk;
  return {{{"nu", "number", "", "Poisson's ratio", {-0.5, 0.5}}, &S::nu},
          {{"speed",
            "number",
            "",
            "normal speed over c_P; above 0.1 the linear theory is formal, the disk is pressed in by 0.16 R at 0.1 and "
            "by 0.39 R at 0.3",
            {1e-4, 0.3}},
           &S::speed},
          {{"alpha", "number", "", "R over the distance in which the wall's force falls by e", {50, 1e6}, "1000"},
           &S::alpha},
          {{"omega_most",
            "number",
            "",
            "all modes with omega R/c_P below it; 40 takes some 0.2 s, 80 some 2 s, a hard wall more",
            {1, 160},
            "40"},
           &S::omega_most}};
}

Arguments<ModalRebound> ModalRebound::fields() {
  using S = ModalRebound;
  return {
      {{"e", "number", "", "restitution coefficient"}, &S::e},
      {{"contact_time", "number", "", "t_c c_P/R, while the wall holds more than 1e-6 of the incident energy"},
       &S::contact_time},
      {{"error_modes", "number", "", "change of e from modes below omega_most/2: about its error by those left out"},
       &S::error_modes},
      {{"error_alpha", "number", "", "change of e from alpha/2: how far it is from that of a hard wall"},
       &S::error_alpha},
      {{"error_step", "number", "",
        "change of e from twice the step: three times its error by the step; where the rim chatters (speed "
        "above 0.1, alpha near omega_most^2 and above) that error may be as large as error_modes"},
       &S::error_step},
      {{"ledger", "number", "", "e^2 + the sum of `energy` - 1: energy that the method lost or made"}, &S::ledger},
      {{"steps", "number", "", "steps of the impact"}, &S::steps},
      {{"n", "numbers", "", "nodal diameters of every mode"}, &S::n},
      {{"l", "numbers", "", "its place among those of its n, from 1"}, &S::l},
      {{"omega", "numbers", "", "its omega R/c_P"}, &S::omega},
      {{"energy", "numbers", "", "its energy after the impact over the kinetic energy before"}, &S::energy}};
}

namespace {

// What a head-on impact excites.
std::vector<DiskMode> excited(double nu, double omega_most) {
  std::vector<DiskMode> modes = free_disk_modes(nu, omega_most);
  std::erase_if(modes, [](const DiskMode& mode) { return mode.torsion; });
  return modes;
}

// alpha of at most 4 n^2: from one crest of the highest wave to the next a round rim rises by (pi/n)^2/8, 5/alpha
// there. On a harder wall single crests strike one after another, and the cut, not the wall, makes e.
constexpr double crests_apart = 4;

void check_wall(const ModalDisk& impact, const std::vector<DiskMode>& modes) {
  if (modes.empty())
    throw FieldError("omega_most",
                     fmt::format("must be above the lowest mode of the disk: none lies below {:g}", impact.omega_most));
  if (impact.alpha * impact.speed < 1)
    throw FieldError("alpha", fmt::format("must be at least 1/speed = {:g}, is {:g}: so soft a wall gives way more "
                                          "than the disk",
                                          1 / impact.speed, impact.alpha));
  const double n_most = modes.back().n, hardest = crests_apart * n_most * n_most;
  if (impact.alpha > hardest)
    throw FieldError("omega_most",
                     fmt::format("is too small for alpha = {:g}: waves of up to {} crests round the rim take an alpha "
                                 "of at most {:g}. Take at least {:.0f}, or a softer wall",
                                 impact.alpha, n_most, hardest,
                                 std::ceil(1.1 * impact.omega_most * std::sqrt(impact.alpha / hardest))));
}

// The impact by a step of `longer` times the chosen one, halved until it keeps the energy to 1e-6.
ModalImpact kept_energy(const std::vector<DiskMode>& modes, const ModalDisk& given, double alpha, double& longer) {
  while (longer > 0.01) {
    ModalImpact impact(modes, given.speed, alpha, longer);
    impact.run();
    if (std::abs(impact.ledger()) <= 1e-6) return impact;
    longer /= 2;
  }
  throw FieldError("omega_most", fmt::format("is too small for alpha = {:g}: the rim chatters on the wall faster than "
                                             "any step can follow. Raise it, or take a softer wall",
                                             given.alpha));
}

}  // namespace

ModalRebound modal_disk(const ModalDisk& given) {
  checked(given);
  const std::vector<DiskMode> modes = excited(given.nu, given.omega_most);
  check_wall(given, modes);
  double step = 2, half = 1, soft = 1;
  const double coarse = kept_energy(modes, given, given.alpha, step).restitution();
  step /= 2;
  const ModalImpact impact = kept_energy(modes, given, given.alpha, step);
  const double e = impact.restitution();
  const double fewer = kept_energy(excited(given.nu, given.omega_most / 2), given, given.alpha, half).restitution();
  const double softer = kept_energy(modes, given, given.alpha / 2, soft).restitution();
  ModalRebound rebound{.e = e,
                       .contact_time = impact.contact_time(),
                       .error_modes = std::abs(e - fewer),
                       .error_alpha = std::abs(e - softer),
                       .error_step = std::abs(e - coarse),
                       .ledger = impact.ledger(),
                       .steps = static_cast<double>(impact.steps()),
                       .n = {},
                       .l = {},
                       .omega = {},
                       .energy = impact.mode_energies()};
  for (const DiskMode& mode : modes) {
    rebound.n.push_back(mode.n);
    rebound.l.push_back(mode.l);
    rebound.omega.push_back(mode.omega);
  }
  return rebound;
}

}  // namespace ricochet::theory
