#pragma once
// The viscosity of a body of elements, beside any law: Kelvin and Voigt's solid.

#include <array>

#include "body/elements/sweep.hpp"

namespace ricochet {

/// Rates of strain D_xx, D_yy and 2 D_xy, or the impulses of stress that belong to them.
template <int W>
struct StrainRates {
  Lane<W> xx, yy, xy;
};

/// One element at places that are held: its viscous stress in W lanes.
///
/// Kirchhoff's stress is time (lambda tr D + 2 mu D), with D the rate of deformation, so that a rotation costs nothing
/// and the power lost is that stress times D, per area at rest. With d = G v the rates and s the impulse of stress in a
/// time h, the midpoint rule says s = h C (d - W s/2), W = G m^-1 G^T: it conserves momentum and angular momentum and
/// never gains energy, for every h. [the splitting: as for springs; the rule: here]
template <int W>
class ElementDashpot {
 public:
  using Gradients = std::array<Place<W, 2>, 3>;  ///< of a node's share of the velocity, in space [1/R]

  ElementDashpot(const ElementEdges<W>& d, const std::array<double, 3>& per_mass) : per_mass_(per_mass) {
    const Lane<W> per_area = 1.0 / (d.first.at[0] * d.second.at[1] - d.first.at[1] * d.second.at[0]);
    gradient_[1] = Place<W, 2>(per_area * d.second.at[1], -(per_area * d.second.at[0]));
    gradient_[2] = Place<W, 2>(-(per_area * d.first.at[1]), per_area * d.first.at[0]);
    gradient_[0] = -1.0 * (gradient_[1] + gradient_[2]);
  }

  StrainRates<W> rates(const ElementEdges<W>& w) const {
    StrainRates<W> d;
    const Place<W, 2>&g = gradient_[1], &k = gradient_[2];
    d.xx = g.at[0] * w.first.at[0] + k.at[0] * w.second.at[0];
    d.yy = g.at[1] * w.first.at[1] + k.at[1] * w.second.at[1];
    d.xy = g.at[1] * w.first.at[0] + g.at[0] * w.first.at[1] + k.at[1] * w.second.at[0] + k.at[0] * w.second.at[1];
    return d;
  }

  /// The impulse of stress in a time: `lambda`, `mu` are Lame's constants times the viscosity's time, the element's
  /// weight and h.
  StrainRates<W> impulse(const StrainRates<W>& d, const Lane<W>& lambda, const Lane<W>& mu) const {
    // (1 + C W/2) s = C d, by Cramer's rule: its determinant is at least 1.
    const StrainRates<W> cd = stress(d, lambda, mu);
    const StrainRates<W> x = stress(column(0), lambda, mu), y = stress(column(1), lambda, mu),
                         z = stress(column(2), lambda, mu);
    const Lane<W> a = 1.0 + 0.5 * x.xx, b = 0.5 * y.xx, c = 0.5 * z.xx;
    const Lane<W> e = 0.5 * x.yy, f = 1.0 + 0.5 * y.yy, g = 0.5 * z.yy;
    const Lane<W> i = 0.5 * x.xy, j = 0.5 * y.xy, k = 1.0 + 0.5 * z.xy;
    const Lane<W> A = f * k - g * j, B = g * i - e * k, C = e * j - f * i;
    const Lane<W> per = 1.0 / (a * A + b * B + c * C);
    StrainRates<W> s;
    s.xx = per * (A * cd.xx + (c * j - b * k) * cd.yy + (b * g - c * f) * cd.xy);
    s.yy = per * (B * cd.xx + (a * k - c * i) * cd.yy + (c * e - a * g) * cd.xy);
    s.xy = per * (C * cd.xx + (b * i - a * j) * cd.yy + (a * f - b * e) * cd.xy);
    return s;
  }

  /// What a node is pulled with, as an impulse.
  Place<W, 2> pull(int corner, const StrainRates<W>& s) const {
    const Place<W, 2>& g = gradient_[static_cast<std::size_t>(corner)];
    return Place<W, 2>(-(g.at[0] * s.xx + g.at[1] * s.xy), -(g.at[1] * s.yy + g.at[0] * s.xy));
  }

  /// What the motion loses. [m0 c^2]
  Lane<W> lost(const StrainRates<W>& d, const StrainRates<W>& s) const {
    const StrainRates<W> x = column(0), y = column(1), z = column(2);
    const auto half = [&](const Lane<W>& before, const Lane<W>& by_x, const Lane<W>& by_y, const Lane<W>& by_z) {
      return Lane<W>(before - 0.5 * (by_x * s.xx + by_y * s.yy + by_z * s.xy));
    };
    return s.xx * half(d.xx, x.xx, y.xx, z.xx) + s.yy * half(d.yy, x.yy, y.yy, z.yy) +
           s.xy * half(d.xy, x.xy, y.xy, z.xy);
  }

 private:
  static StrainRates<W> stress(const StrainRates<W>& d, const Lane<W>& lambda, const Lane<W>& mu) {
    StrainRates<W> s;
    const Lane<W> swelling = lambda * (d.xx + d.yy);
    s.xx = swelling + 2.0 * mu * d.xx;
    s.yy = swelling + 2.0 * mu * d.yy;
    s.xy = mu * d.xy;
    return s;
  }

  // Of W = G m^-1 G^T.
  StrainRates<W> column(int c) const {
    StrainRates<W> sum{Lane<W>::Zero(), Lane<W>::Zero(), Lane<W>::Zero()};
    for (std::size_t a = 0; a < 3; ++a) {
      const Lane<W>&x = gradient_[a].at[0], &y = gradient_[a].at[1];
      const double per = per_mass_[a];
      if (c == 0) sum.xx += per * (x * x);
      if (c == 1) sum.yy += per * (y * y);
      if (c == 2) {
        sum.xx += per * (x * y);
        sum.yy += per * (x * y);
        sum.xy += per * (x * x + y * y);
      } else {
        sum.xy += per * (x * y);
      }
    }
    return sum;
  }

  std::array<double, 3> per_mass_;  // 0 of held nodes
  Gradients gradient_;
};

/// The viscosity of all elements for a time h; returns the energy lost. [m0 c^2] `time`: viscosity over stiffness
/// [R/c]. Elements follow one another, forward through their list or backward, each the other's mirror. What held nodes
/// are pulled with is left in `f`, as an impulse.
template <int W>
Lane<W> damp_elements(Motion<W>& body, const Elements& elements, double time, const Lane<W>& h, bool forward) {
  Lane<W> lost = Lane<W>::Zero();
  const Solid& solid = *body.solid;
  const auto viscous = [&](double lame) { return Lane<W>((time * lame) * body.stiffness * h); };
  Lane<W> lambda = viscous(elements.law.lame.lambda), mu = viscous(elements.law.lame.mu);
  const Place<W, 2>* position = body.q.template places<2>();
  Place<W, 2>*velocity = body.v.template places<2>(), *impulse = body.f.template places<2>();
  for (int n = 0; n < elements.size(); ++n) {
    const auto e = static_cast<std::size_t>(forward ? n : elements.size() - 1 - n);
    const auto& [i, j, k] = elements.nodes[e];
    const auto per_mass = [&](int node) { return node < solid.free ? 1 / solid.mass[node] : 0.0; };
    const ElementDashpot<W> dashpot({position[j] - position[i], position[k] - position[i]},
                                    {per_mass(i), per_mass(j), per_mass(k)});
    const StrainRates<W> d = dashpot.rates({velocity[j] - velocity[i], velocity[k] - velocity[i]});
    const double weight = elements.weight[e];
    if (!elements.lame.empty()) {
      lambda = viscous(elements.lame[e].lambda);
      mu = viscous(elements.lame[e].mu);
    }
    const StrainRates<W> s = dashpot.impulse(d, weight * lambda, weight * mu);
    for (int corner = 0; corner < 3; ++corner) {
      const int node = elements.nodes[e][static_cast<std::size_t>(corner)];
      const Place<W, 2> pull = dashpot.pull(corner, s);
      if (node < solid.free)
        velocity[node] += (1 / solid.mass[node]) * pull;
      else
        impulse[node] += pull;
    }
    lost += dashpot.lost(d, s);
  }
  return lost;
}

}  // namespace ricochet
