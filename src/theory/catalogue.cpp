#include "theory/catalogue.hpp"

#include <fmt/format.h>

#include <cmath>

#include "theory/disk.hpp"
#include "theory/disk_modes.hpp"
#include "theory/fit.hpp"
#include "theory/jackson_green.hpp"
#include "theory/kuwabara_kono.hpp"
#include "theory/maw.hpp"
#include "theory/maw_hertz.hpp"
#include "theory/modal_disk.hpp"
#include "theory/oblique.hpp"
#include "theory/plastic.hpp"
#include "theory/radiation.hpp"
#include "theory/rods.hpp"
#include "theory/tilted.hpp"
#include "theory/wu_li_thornton.hpp"
#include "theory/zener.hpp"

namespace ricochet::theory {
namespace {

// What is not finite is no result, nor is what cannot be, such as a time of 0: something on the way was too large or
// too small for a number. Only an optional result may be undefined.
Value result(const Field& field, Value value) {
  const auto good = [&](double x) {
    return (std::isfinite(x) && field.range.contains(x) && (x == 0 || std::isnormal(x))) ||
           (field.optional && std::isnan(x));
  };
  bool all = true;
  if (const double* number = std::get_if<double>(&value))
    all = good(*number);
  else
    for (const double element : std::get<Numbers>(value)) all = all && good(element);
  if (!all)
    throw Error(
        fmt::format("'{}' is too large or too small for a number at these values; measure in other units", field.name));
  return value;
}

template <class Struct, class Returned>
Theory made(std::string name, std::string says, std::string valid, std::string source, std::string example,
            Returned (*function)(const Struct&), Field single = {}) {
  Theory theory{std::move(name), std::move(says), std::move(valid), std::move(source), std::move(example), {}, {}, {}};
  for (const auto& a : Struct::fields()) theory.arguments.push_back(a.field);
  constexpr bool is_table = requires { Returned::fields(); };
  if constexpr (is_table)
    for (const auto& a : Returned::fields()) theory.results.push_back(a.field);
  else
    theory.results.push_back(single);
  theory.evaluate = [function, single](const std::map<std::string, Value>& given) {
    Struct arguments;
    for (const auto& a : Struct::fields())
      if (const auto found = given.find(a.field.name); found != given.end())
        std::visit(
            [&](auto place) {
              arguments.*place = std::get<std::remove_reference_t<decltype(arguments.*place)>>(found->second);
            },
            a.place);
    const Returned returned = function(arguments);
    std::vector<Value> values;
    if constexpr (is_table)
      for (const auto& a : Returned::fields()) {
        const auto* one = std::get_if<double Returned::*>(&a.place);
        values.push_back(
            result(a.field, one ? Value(returned.**one) : Value(returned.*std::get<Numbers Returned::*>(a.place))));
      }
    else
      values.push_back(result(single, returned));
    return values;
  };
  return theory;
}

Field number(const std::string& doc, const std::string& unit = "", const Range& range = any_number) {
  return {"value", "number", unit, doc, range};
}

void add_normal(std::vector<Theory>& list) {
  list.push_back(made(
      "hertz_force",
      "Force F = h^(3/2) sqrt(R_eff)/D and radius a = (F D R_eff)^(1/3) of the contact of two spheres, or of a sphere "
      "and a plane.",
      "h << R, no friction, no adhesion", "hertz1882; hayakawa2003, eq. hertz",
      "ricochet.theory.hertz_force { R = 0.01, E = 20e9, nu = 0.25, R2 = 0.01, E2 = 20e9, nu2 = 0.25, h = 1e-4 }.F",
      hertz_force));
  list.push_back(made("hertz",
                      "Elastic impact of two spheres, or of a sphere on a plane: greatest compression h0 = "
                      "(m_eff/kappa)^(2/5) v^(4/5), contact time t_c = 2.9432752 "
                      "(m_eff^2/(kappa^2 v))^(1/5), greatest force.",
                      "quasi-static: v far below the speed of sound", "hertz1882; hayakawa2003, eqs. 2-ene_cons and tc",
                      "ricochet.theory.hertz { R = 0.1, E = 40e9, nu = 0.35, m = 7.54, v = 0.2 }.t_c", hertz));
  list.push_back(made(
      "kuwabara_kono", "Impact of viscous spheres, x'' + eta sqrt(x) x' + (5/4) x^(3/2) = 0, integrated.",
      "quasi-static; eta is that of kuwabara_kono_eta", "kuwabara1987; schwager2008 for `ends`; hayakawa2003, eq. kk-9",
      "ricochet.theory.kuwabara_kono { eta = 0.1, ends = \"force\" }.e", kuwabara_kono));
  list.push_back(made("kuwabara_kono_first_order", "e = 1 - 1.00890979 eta.", "eta << 1", "kuwabara1987; hayakawa2003",
                      "ricochet.theory.kuwabara_kono_first_order { eta = 0.01 }", kuwabara_kono_first_order,
                      number("restitution coefficient")));
  list.push_back(made("kuwabara_kono_series",
                      "e = 1 - C1 s + C2 s^2 - C3 s^3, s = eta/(5/4)^(3/5), contact ending at x = 0.", "s << 1",
                      "ramirez1999, with C3 corrected here", "ricochet.theory.kuwabara_kono_series { eta = 0.1 }",
                      kuwabara_kono_series, number("restitution coefficient")));
  list.push_back(made(
      "kuwabara_kono_eta", "eta = (5/2) kappa~ (v/(kappa^3 m_eff^2))^(1/5) from the materials' viscosities.",
      "as printed; three quarters of it where the viscous stress is tau times the rate of the elastic one; equal "
      "viscous and elastic Poisson's ratios",
      "kuwabara1987; hayakawa2003, eq. kk-9",
      "ricochet.theory.kuwabara_kono_eta { R = 0.01, E = 1e9, nu = 0.3, m = 1e-3, v = 1, shear = 100, bulk = 200 }",
      kuwabara_kono_eta, number("dimensionless viscosity", "", positive)));
  list.push_back(made("disk_force", "Disk on a wall: F = pi E* (h + tau0 dh/dt)/ln(4R/h), per unit thickness.",
                      "h << R", "gerl1999; hayakawa2003",
                      "ricochet.theory.disk_force { R = 1, E = 1e4, nu = 0.3, h = 0.01 }", disk_force,
                      number("repulsive force per unit thickness", "M L T^-2")));
  list.push_back(
      made("disk_log_law", "Disk on a wall: t_c = (pi R/c) sqrt(ln(4c/v)), e = 1 - (pi/2)(tau0 c/R)/sqrt(ln(4c/v)).",
           "v << c: within 2 % of disk_impact up to 0.02 c, 4 % at 0.1 c; tau0 << R/c",
           "hayakawa2003, eq. t_c; its e corrected here",
           "ricochet.theory.disk_log_law { R = 1, E = 1.1e4, nu = 0.3, rho = 255, v = 0.1 }.t_c", disk_log_law));
  list.push_back(made("disk_on_plane",
                      "Disk pressed on a rigid plane: a = sqrt(4FR/(pi E*)), delta = (F/(pi E*)) [2 ln(4R/a) - 1].",
                      "a << R", "johnson1985, section 5.6",
                      "ricochet.theory.disk_on_plane { R = 1, E = 1e4, nu = 0.3, F = 10 }.delta", disk_on_plane));
  list.push_back(made("disk_impact", "Impact of a disk on a rigid plane by disk_on_plane, by quadrature.",
                      "quasi-static: v << c", "johnson1985, section 5.6; integrated here",
                      "ricochet.theory.disk_impact { R = 1, E = 1.1e4, nu = 0.3, rho = 255, v = 0.1 }.t_c",
                      disk_impact));
  list.push_back(made(
      "disk_modes", "Omega = omega R sqrt(rho (1 - nu^2)/E) of the free disk's in-plane modes, plane stress.",
      "any nu; plane strain by nu -> nu/(1 - nu), E -> E/(1 - nu^2)", "love1927; gerl1999",
      "ricochet.theory.disk_modes { nu = 0.3, n = 2 }[1]", disk_modes, {"value", "numbers", "", "the lowest modes"}));
  list.push_back(made(
      "disk_mode_table",
      "Every in-plane mode of the free disk below a frequency: u_r = U cos(n theta), u_theta = V sin(n theta) at the "
      "rim, its mass that of the disk; (U^2 + V^2 - (1 - nu^2)(U + nV)^2/Omega^2)/2 = 1, for n = 0 without the "
      "half.",
      "plane stress; plane strain as disk_modes; a mode with n > 0 has a twin turned by a quarter of a wave",
      "love1927; gerl1999; normalisation here", "ricochet.theory.disk_mode_table { nu = 0.3, omega_most = 5 }.U",
      disk_mode_table));
  list.push_back(made(
      "modal_disk",
      "Head-on impact of an elastic disk on a smooth wall with the energy exp(-alpha y) along the rim: all the disk's "
      "modes below omega_most, each turned exactly, and the energy that each keeps.",
      "linear elasticity, plane stress: speed up to 0.1, formal above; a hard wall is omega_most and alpha raised "
      "together, until error_modes and error_alpha are small",
      "gerl1999", "ricochet.theory.modal_disk { nu = 0.3, speed = 0.1, omega_most = 20 }.e", modal_disk));
  list.push_back(made("rods", "Coaxial rods of one material and cross-section: e = L_short/L_long, t_c = 2 L_short/c.",
                      "thin rods, v << c", "saintvenant1867; goldsmith1960; hayakawa2003, section II A",
                      "ricochet.theory.rods { L = 1, L2 = 2, c = 5000, v = 1 }.e", rods));
}

void add_losses(std::vector<Theory>& list) {
  list.push_back(
      made("radiation_pattern", "Amplitudes Theta1 of P and |Theta2| of S waves from a point force on a half-space.",
           "far away; the force acts on an area small beside the wavelength", "miller1954; hayakawa2003, section II C",
           "ricochet.theory.radiation_pattern { nu = 0.25, theta = 0.5 }.Theta1", radiation_pattern));
  list.push_back(made("radiation_shares",
                      "Shares of P, S and Rayleigh waves in what a force on a half-space radiates, and T of energy = "
                      "T/(2 pi G c_P) int (dF/dt)^2 dt.",
                      "as radiation_pattern", "miller1954; miller1955; T_rayleigh here",
                      "ricochet.theory.radiation_shares { nu = 0.25 }.rayleigh", radiation_shares));
  list.push_back(made(
      "radiation_loss",
      "Energy radiated in the impact of a sphere on a half-space with Hertz's force: 1 - e ~ v^(3/5).",
      "v far below the speed of sound, 1 - e << 1", "miller1955; hunter1957; constant here",
      "ricochet.theory.radiation_loss { R = 1, m = 4.2, E = 1, nu = 0.3, E2 = 1, nu2 = 0.3, rho2 = 1, v = 1e-3 }.e",
      radiation_loss));
  list.push_back(made("hunter_coefficient",
                      "C of 1 - e^2 = C (v/sqrt(E/rho))^(3/5), sphere and half-space of one material.",
                      "as radiation_loss", "hunter1957; constant here",
                      "ricochet.theory.hunter_coefficient { nu = 0.25 }", hunter_coefficient, number("C")));
  list.push_back(made(
      "radiation_printed",
      "The paper's printed law, 1 - e = 0.5827 kappa^(6/5) v^(1/5)/(rho m^(1/5) E^(3/2)), nu = 1/4.",
      "nowhere: its dimensions fail and its exponent contradicts its own loss of energy; see ricochet theory errata",
      "hayakawa2003, eq. new",
      "ricochet.theory.radiation_printed { R = 1, m = 4.2, E = 1, E2 = 1, rho = 1, v = 1e-3 }.one_minus_e",
      radiation_printed));
  list.push_back(made(
      "zener",
      "Impact of a sphere on a large thin plate whose flexural waves take energy: s'' + (1 + lambda d/dt) s^(3/2) = 0, "
      "lambda = m v/(8 S sqrt(D rho2 h)), S = (m v^2/k)^(2/5), k = (4/3) E* sqrt(R), D = E2 h^3/(12 (1 - nu2^2)).",
      "waves long against the thickness h, which is large against the contact, and none back from the plate's rim",
      "zener1941; solved as kuwabara1987, here",
      "ricochet.theory.zener { R = 1, m = 4.2, E = 1, nu = 0.3, E2 = 1, nu2 = 0.3, rho2 = 1, thickness = 0.5, "
      "v = 1e-3 }.e",
      zener));
}

void add_plastic(std::vector<Theory>& list) {
  list.push_back(made("plastic", "Fully plastic impact: e^2 = 3.55 (p_d/E*) (2 p_d R^3/(m v^2))^(1/4), e ~ v^(-1/4).",
                      "v far above the yield speed, a < R", "johnson1985, eq. 11.41; hayakawa2003, section II D",
                      "ricochet.theory.plastic { R = 0.01, E_star = 1e11, m = 0.03, Y = 5e8, v = 10 }.e", plastic));
  list.push_back(
      made("yield_speed",
           "Speed at which p0 = (6 F E*^2/(pi^3 R^2))^(1/3) reaches 1.60 Y: m v^2/2 = pi^5 R^3 p0^5/(60 E*^4).",
           "Mises' condition, nu = 0.3", "johnson1985, eqs. 6.9 and 11.38",
           "ricochet.theory.yield_speed { R = 0.01, E_star = 1e11, m = 0.03, Y = 5e8 }.v", yield_speed));
  list.push_back(
      made("wu_li_thornton",
           "e = 2.08 (v/v_y)^(-1/4) up to v = 0.0079 (E*/Y)^2 v_y, and 0.62 (v Y/(v_y E*))^(-1/2) from there on.",
           "perfectly plastic sphere, v >= 18.7 v_y; finite elements within 4 % from 200 v_y on, but 11 % near where "
           "the two meet",
           "wu2003", "ricochet.theory.wu_li_thornton { R = 0.01, E_star = 1e11, m = 0.03, Y = 5e8, v = 10 }.e",
           wu_li_thornton));
  list.push_back(made("jackson_green_force",
                      "Force, contact radius and dent of a sphere that is pressed in by h: a fit to finite elements.",
                      "perfectly plastic sphere, quasi-static, h <= R/2; finite elements within 4 %",
                      "jackson2005; jackson2005residual",
                      "ricochet.theory.jackson_green_force { R = 0.01, E_star = 1e11, Y = 5e8, h = 1e-4 }.F",
                      jackson_green_force));
  list.push_back(made("jackson_green",
                      "e^2 = (2/5) F (h - dent)/(m v^2/2) at the depth h where jackson_green_force has done that work.",
                      "as jackson_green_force; e of finite elements within 2 % up to 13 v_y, 10 % greater at 135 v_y",
                      "jackson2005; jackson2005residual",
                      "ricochet.theory.jackson_green { R = 0.01, E_star = 1e11, m = 0.03, Y = 5e8, v = 1 }.e",
                      jackson_green));
}

void add_oblique(std::vector<Theory>& list) {
  list.push_back(made("walton", "beta = min(beta0, -1 + mu (1 + e) beta_x cot(gamma)).",
                      "rigid bodies, constant e, mu and beta0", "walton1992; hayakawa2003, eq. walton32",
                      "ricochet.theory.walton { psi1 = 2, mu = 0.3, e = 0.9, beta0 = 0.5 }.beta", walton));
  list.push_back(made(
      "maw",
      "beta of a contact with a tangential spring and friction, in three regimes: sticks at first, "
      "slides and sticks, slides.",
      "constant e and mu; small contact; bilinear springs instead of Hertz's; e near 1: against Thornton's elements at "
      "e = 0.25 it misses by up to 2.3 where the contact sticks",
      "maw1976; stronge2000; hayakawa2003, section III B, corrected here",
      "ricochet.theory.maw { psi1 = 1, mu = 0.3, e = 0.9, nu = 0.3 }.beta", maw));
  list.push_back(made("maw_integrated", "The same contact integrated step by step.",
                      "as maw; error of the order of 1/steps^2", "here",
                      "ricochet.theory.maw_integrated { psi1 = 1, mu = 0.3, e = 0.9, nu = 0.3 }.beta", maw_integrated));
  list.push_back(made(
      "maw_hertz",
      "Oblique impact of a sphere with Hertz's contact, of which parts stick and parts slip: integrated as a row of "
      "springs, each with its own friction.",
      "quasi-static; like materials; no spin out of the plane",
      "maw1976; jaeger1995; popov2015; lyashenko2015; e by e^2 of the force in restitution, here",
      "ricochet.theory.maw_hertz { psi1 = 0.2, mu = 0.1, e = 0.98, nu = 0.22 }.beta", maw_hertz));
  list.push_back(made(
      "tilted_surface",
      "e of an impact on a surface tilted by the contact: theta, tan(alpha), mu_alpha, Psi1_alpha, Psi2_alpha and e.",
      "quasi-static slip of a disk on a soft wall", "louge2002; kuninaka2004; hayakawa2003, eqs. ratio1 to CORmod2",
      "ricochet.theory.tilted_surface { psi1 = 4, mu = 0.3, e_alpha = 0.8, offset = 0.5, nu = 0.3 }.e",
      tilted_surface));
  list.push_back(
      made("tilted_curve",
           "tilted_surface at each of a list of measured mu, e_alpha and |x_c - x_a|, joined by a cubic spline.",
           "within the measured angles", "hayakawa2003, section V C",
           "ricochet.theory.tilted_curve { psi1 = {0, 2, 4, 6}, mu = {0, 0.3, 0.3, 0.2}, e_alpha = {0.7, 0.8, 0.8, "
           "0.8}, offset = {0.5, 0.5, 0.4, 0.3}, nu = "
           "0.3, at = {1, 3} }.e",
           tilted_curve));
  list.push_back(made("fit_walton",
                      "e, mu and beta0 from a table of impacts, with standard errors: least squares of psi2 = "
                      "max(-beta0 psi1, psi1 - beta_x mu (1 + e)).",
                      "independent impacts, two or more on either side of the break", "foerster1994; here",
                      "ricochet.theory.fit_walton { psi1 = {0.5, 1, 4, 5}, psi2 = {-0.2, -0.5, 2.2, 3.3}, e = {0.9, "
                      "0.9, 0.9, 0.9} }.mu",
                      fit_walton));
}

}  // namespace

std::span<const Theory> theories() {
  static const std::vector<Theory> list = [] {
    std::vector<Theory> all;
    add_normal(all);
    add_losses(all);
    add_plastic(all);
    add_oblique(all);
    return all;
  }();
  return list;
}

}  // namespace ricochet::theory
