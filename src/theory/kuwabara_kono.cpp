#include "theory/kuwabara_kono.hpp"

#include <array>
#include <boost/math/special_functions/beta.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>

namespace ricochet::theory {

Arguments<ViscousImpact> ViscousImpact::fields() {
  return {{{"eta", "number", "", "dimensionless viscosity; beyond 50 the equation is stiff and e below 0.01", {0, 50}},
           &ViscousImpact::eta},
          {{"ends",
            "string",
            "",
            "contact ends where the overlap is 0, or earlier, where the force would become tensile",
            any_number,
            "overlap",
            false,
            {"overlap", "force"}},
           &ViscousImpact::ends}};
}

Arguments<ViscousRebound> ViscousRebound::fields() {
  return {{{"e", "number", "", "restitution coefficient"}, &ViscousRebound::e},
          {{"t", "number", "", "contact time in h0/v"}, &ViscousRebound::t}};
}

Arguments<SmallLoss> SmallLoss::fields() {
  return {{{"eta", "number", "", "dimensionless viscosity, well below 1", {0, 0.5}}, &SmallLoss::eta}};
}

Arguments<ViscousMaterial> ViscousMaterial::fields() {
  using S = ViscousMaterial;
  return joined<S>(
      {fields_of<S>(),
       masses_of<S>(),
       {{{"shear", "number", "M L^-1 T^-1", "shear viscosity of the sphere's material", positive}, &S::shear},
        {{"bulk", "number", "M L^-1 T^-1", "its bulk viscosity", not_negative}, &S::bulk},
        {{"shear2", "number", "M L^-1 T^-1", "shear viscosity of the other's; 0 if that is rigid", not_negative, "0"},
         &S::shear2},
        {{"bulk2", "number", "M L^-1 T^-1", "its bulk viscosity", not_negative, "0"}, &S::bulk2}}});
}

ViscousRebound kuwabara_kono(const ViscousImpact& impact) {
  checked(impact);
  using State = std::array<double, 2>;  // x, x'
  const auto force = [&](const State& s) {
    return -impact.eta * std::sqrt(std::max(0.0, s[0])) * s[1] - 1.25 * std::pow(std::max(0.0, s[0]), 1.5);
  };
  const auto rates = [&](const State& s, State& rate, double) { rate = {s[1], force(s)}; };
  // Contact goes on while this is positive; with the force criterion, sqrt(x) of the force is left out: it is 0 at the
  // start, where contact begins.
  const bool at_overlap = impact.ends == "overlap";
  const auto in_contact = [&](const State& s) { return at_overlap ? s[0] : impact.eta * s[1] + 1.25 * s[0]; };
  auto stepper =
      boost::numeric::odeint::make_dense_output(1e-13, 1e-13, boost::numeric::odeint::runge_kutta_dopri5<State>());
  // sqrt(x) has no bounded derivative at 0: the first and last 1e-6 go by x = t, and x' falls by (2/3) eta t^{3/2}
  // there.
  const double begin = 1e-6;
  stepper.initialize(State{begin, 1 - impact.eta * 2 / 3 * std::pow(begin, 1.5)}, begin, 1e-5);
  State state;
  for (;;) {
    const auto [from, to] = stepper.do_step(rates);
    if (in_contact(stepper.current_state()) > 0 || stepper.current_state()[1] > 0) continue;
    const auto left = [&](double t) {
      stepper.calc_state(t, state);
      return in_contact(state);
    };
    const double end = root_between(left, from, to);
    stepper.calc_state(end, state);
    return {-state[1], end};
  }
}

double kuwabara_kono_first_order(const SmallLoss& loss) {
  return 1 - 0.8 * boost::math::beta(0.6, 1.5) * checked(loss).eta;
}

double kuwabara_kono_series(const SmallLoss& loss) {
  const double s = checked(loss).eta / std::pow(1.25, 0.6);
  return 1 - s * (1.1534489 - s * (0.7982666 - s * 0.5229));
}

namespace {

// (1 - nu~^2)/E~ of a viscous solid: E~ = 9 K G/(3 K + G), nu~ = (3 K - 2 G)/(2 (3 K + G)); (1 - nu~^2)/E~ = (3 K + 4
// G)/(4 G (3 K + G)).
double compliance(double shear, double bulk) { return (3 * bulk + 4 * shear) / (4 * shear * (3 * bulk + shear)); }

}  // namespace

double ViscousMaterial::D_viscous() const {
  return 0.75 * (compliance(shear, bulk) + (shear2 > 0 ? compliance(shear2, bulk2) : 0));
}

double kuwabara_kono_eta(const ViscousMaterial& material) {
  checked(material);
  // The sum of both compliances is the paper's; an elastic body without loss beside a viscous one is not within it.
  if ((material.shear2 > 0) != std::isfinite(material.E2))
    throw FieldError("shear2", "must be given with E2, and only with it");
  const double kappa_viscous = 0.8 / material.D_viscous() * std::sqrt(material.R_eff());
  return 2.5 * kappa_viscous *
         std::pow(material.v / (std::pow(material.kappa(), 3) * std::pow(material.m_eff(), 2)), 0.2);
}

}  // namespace ricochet::theory
