#include "theory/jackson_green.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "theory/plastic.hpp"

namespace ricochet::theory {
namespace {

using std::numbers::pi;

constexpr double hertzian = 1.9;  // w up to which Hertz's law holds
constexpr double deepest = 0.5;   // depth/R beyond which no fit is meant

/// The sphere, by what measures its depth and force.
struct Scales {
  double R, Y, C, depth, force, B;

  template <class S>
  explicit Scales(const S& of)
      : R(of.R),
        Y(of.Y),
        C(1.295 * std::exp(0.736 * of.nu)),
        depth(std::pow(pi * C * Y / (2 * of.E_star), 2) * R),
        force(4.0 / 3 * std::pow(R / of.E_star, 2) * std::pow(pi * C * Y / 2, 3)),
        B(0.14 * std::exp(23 * Y / of.E_star)) {}

  double radius(double w) const { return std::sqrt(R * depth * w * (w > hertzian ? std::pow(w / hertzian, B) : 1.0)); }

  double force_at(double w) const {
    if (w <= hertzian) return force * std::pow(w, 1.5);
    const double hardness = 2.84 * (1 - std::exp(-0.82 * std::pow(radius(w) / R, -0.7)));
    return force * (std::exp(-0.25 * std::pow(w, 5.0 / 12)) * std::pow(w, 1.5) +
                    4 * hardness / C * (1 - std::exp(-std::pow(w, 5.0 / 9) / 25)) * w);
  }

  // The integral of the force over the depth; of w = exp(x) where it is no power.
  double work(double w) const {
    const double elastic = 0.4 * force * depth * std::pow(std::min(w, hertzian), 2.5);
    if (w <= hertzian) return elastic;
    const auto by_logarithm = [&](double x) { return force_at(std::exp(x)) * std::exp(x); };
    return elastic + depth * boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                                 by_logarithm, std::log(hertzian), std::log(w), 8, 1e-12);
  }

  double residual(double w) const {
    return w <= hertzian ? 0 : depth * w * 1.02 * (1 - std::pow((w + 5.9) / 6.9, -0.54));
  }
};

template <class S>
Arguments<S> sphere() {
  return joined<S>({yielding_sphere<S>(),
                    {{{"nu", "number", "", "Poisson's ratio of the body that yields", {0, 0.5}, "0.3"}, &S::nu}}});
}

}  // namespace

Arguments<PressedSphere> PressedSphere::fields() {
  using S = PressedSphere;
  return joined<S>({sphere<S>(), {{{"h", "number", "L", "depth, at most R/2", positive}, &S::depth}}});
}

Arguments<PlasticPress> PlasticPress::fields() {
  return {{{"F", "number", "M L T^-2", "force", positive}, &PlasticPress::F},
          {{"a", "number", "L", "radius of the contact", positive}, &PlasticPress::a},
          {{"residual", "number", "L", "depth of the dent that stays"}, &PlasticPress::residual}};
}

PlasticPress jackson_green_force(const PressedSphere& at) {
  checked(at);
  if (at.depth > deepest * at.R) throw FieldError("h", "is more than half of R, for which the fit is not meant");
  const Scales of(at);
  const double w = at.depth / of.depth;
  return {of.force_at(w), of.radius(w), of.residual(w)};
}

Arguments<PressedImpact> PressedImpact::fields() {
  using S = PressedImpact;
  return joined<S>({sphere<S>(), effective_mass<S>(), {{{"v", "number", "L T^-1", "normal speed", positive}, &S::v}}});
}

Arguments<PressedRebound> PressedRebound::fields() {
  using S = PressedRebound;
  return {{{"e", "number", "", "restitution coefficient"}, &S::e},
          {{"depth", "number", "L", "greatest depth", positive}, &S::depth},
          {{"F", "number", "M L T^-2", "greatest force", positive}, &S::F},
          {{"a", "number", "L", "greatest radius of the contact", positive}, &S::a},
          {{"residual", "number", "L", "depth of the dent that stays"}, &S::residual}};
}

PressedRebound jackson_green(const PressedImpact& impact) {
  checked(impact);
  const Scales of(impact);
  const double W = 0.5 * impact.m * impact.v * impact.v, most = deepest * of.R / of.depth;
  if (!(of.work(most) > W)) throw FieldError("v", "is too high: the sphere would be pressed in by more than R/2");
  double w = std::pow(W / (0.4 * of.force * of.depth), 0.4);
  if (!(w <= hertzian)) w = root_between([&](double x) { return of.work(x) - W; }, hertzian, most);
  const double F = of.force_at(w), released = 0.4 * F * (of.depth * w - of.residual(w));
  if (!(released > 0)) throw FieldError("v", "is too high: the fit of the dent would exceed the depth");
  return {std::sqrt(std::min(1.0, released / W)), of.depth * w, F, of.radius(w), of.residual(w)};
}

}  // namespace ricochet::theory
