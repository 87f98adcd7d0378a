#pragma once
// A metal: an elastic law of logarithmic strains whose deviator cannot pass a yield stress.

#include "core/exponential.hpp"
#include "core/lane.hpp"
#include "core/logarithm.hpp"
#include "material/tensor.hpp"

namespace ricochet {

/// What a piece of metal remembers, in W lanes: C_p^-1 = F_p^-1 F_p^-T of the plastic part F_p of its deformation, and
/// its plastic strain, the sum of sqrt(2/3) |d(strain)|.
template <int W>
struct PlasticMemory {
  Lane<W> xx = Lane<W>::Ones(), xy = Lane<W>::Zero(), yy = Lane<W>::Ones(), zz = Lane<W>::Ones();
  Lane<W> strain = Lane<W>::Zero();
};

/// J2 plasticity of finite strains. With b = F C_p^-1 F^T, its principal values exp(2 e_i), and d the deviator of e:
///   W = mu |d|^2 + (lambda/2 + mu/3) (tr e)^2,  tau = 2 mu d + (lambda + 2 mu/3) tr e,  P = tau F^-T
///   |2 mu d| <= sqrt(2/3) (Y + H a),  a: plastic strain
/// Past it, by f, d returns along itself: |d| -= g, a += sqrt(2/3) g, g = f/(2 mu + 2 H/3); what is lost by that is
/// g (sqrt(2/3) (Y + H a) + H g/3). Volume is kept by what flows, as tr e is. [Simo, Comput. Methods Appl. Mech. Eng.
/// 99, 61 (1992); Simo & Hughes, Computational Inelasticity, 1998, section 9.3]
template <int W>
struct HenckyFlow {
  using Number = Lane<W>;
  Number lambda, mu;        // of space
  double yield, hardening;  // Y and H [m0 c^2/R^3]

  Number energy(const AxialTensor<Number>& F, const PlasticMemory<W>& memory) const {
    const Strains e = elastic_strains(F, memory);
    return mu * squared(e) + 0.5 * bulk() * e.trace * e.trace;
  }

  /// P at F, after what flows has flowed; adds what that loses to `lost`. [per volume at rest]
  [[gnu::always_inline]] AxialTensor<Number> stress(const AxialTensor<Number>& F, PlasticMemory<W>& memory,
                                                    Number& lost) const {
    Strains e = elastic_strains(F, memory);
    const Number size = squared(e).sqrt(), limit = root * (yield + hardening * memory.strain);
    const Number excess = 2.0 * mu * size - limit;
    if ((excess > 0.0).any()) flow(F, size, limit, excess, e, memory, lost);
    return stress_of(F, e);
  }

  /// The change of P by a change of F, as long as nothing flows: tau changes by Hooke's law of the strain's rate, and
  /// turns with it. Of small elastic strains, which are all that metals have; what flows is softer.
  AxialTensor<Number> tangent(const AxialTensor<Number>& F, const AxialTensor<Number>& dF,
                              const PlasticMemory<W>& memory) const {
    const Inverse inverse(F);
    const AxialTensor<Number> tau = kirchhoff(elastic_strains(F, memory));
    const Tensor<Number> l = inverse.after(dF.plane);  // dF F^-1
    const Number hoop = dF.zz * inverse.zz, trace = l.xx + l.yy + hoop;
    const Number shear = mu * (l.xy + l.yx), spin = 0.5 * (l.xy - l.yx);
    // Hooke, w tau - tau w, - tau l^T
    Tensor<Number> change(lambda * trace + 2.0 * mu * l.xx + 2.0 * spin * tau.plane.xy,
                          shear + spin * (tau.plane.yy - tau.plane.xx), Number(), Number());
    change.yx = change.xy;
    change.yy = lambda * trace + 2.0 * mu * l.yy - 2.0 * spin * tau.plane.xy;
    change.xx -= tau.plane.xx * l.xx + tau.plane.xy * l.xy;
    change.xy -= tau.plane.xx * l.yx + tau.plane.xy * l.yy;
    change.yx -= tau.plane.xy * l.xx + tau.plane.yy * l.xy;
    change.yy -= tau.plane.xy * l.yx + tau.plane.yy * l.yy;
    const Number across = lambda * trace + 2.0 * mu * hoop - tau.zz * hoop;
    return {inverse.before_transposed(change), across * inverse.zz};
  }

  /// tau, by which the pressure and the deviator of a piece are told. [per volume at rest]
  AxialTensor<Number> kirchhoff(const AxialTensor<Number>& F, const PlasticMemory<W>& memory) const {
    return kirchhoff(elastic_strains(F, memory));
  }

 private:
  static constexpr double root = 0.81649658092772603;  // sqrt(2/3)

  /// Elastic logarithmic strains: their deviator, the trace, and the directions in the plane.
  struct Strains {
    Number first, second, third, trace;
    Number cosine, sine;  // of twice the angle of the first
  };

  /// F^-1.
  struct Inverse {
    Number xx, xy, yx, yy, zz;
    [[gnu::always_inline]] explicit Inverse(const AxialTensor<Number>& F) {
      const Number over = 1.0 / (F.plane.xx * F.plane.yy - F.plane.xy * F.plane.yx);
      xx = F.plane.yy * over;
      xy = -F.plane.xy * over;
      yx = -F.plane.yx * over;
      yy = F.plane.xx * over;
      zz = 1.0 / F.zz;
    }
    /// A F^-1
    Tensor<Number> after(const Tensor<Number>& A) const {
      return {A.xx * xx + A.xy * yx, A.xx * xy + A.xy * yy, A.yx * xx + A.yy * yx, A.yx * xy + A.yy * yy};
    }
    /// A F^-T
    [[gnu::always_inline]] Tensor<Number> before_transposed(const Tensor<Number>& A) const {
      return {A.xx * xx + A.xy * xy, A.xx * yx + A.xy * yy, A.yx * xx + A.yy * xy, A.yx * yx + A.yy * yy};
    }
  };

  Number bulk() const { return lambda + 2.0 / 3 * mu; }

  static Number squared(const Strains& e) { return e.first * e.first + e.second * e.second + e.third * e.third; }

  template <double function(double)>
  [[gnu::always_inline]] static Number each(const Number& x) {
    Number y;
    const double* from = x.data();
    double* to = y.data();
#pragma GCC unroll 1  // unrolled before it is vectorised, it stays one lane after another: twice the time
    for (int lane = 0; lane < W; ++lane) to[lane] = function(from[lane]);
    return y;
  }

  [[gnu::always_inline]] static Strains elastic_strains(const AxialTensor<Number>& F, const PlasticMemory<W>& memory) {
    const Tensor<Number>& G = F.plane;
    const Number xx = G.xx * memory.xx + G.xy * memory.xy, xy = G.xx * memory.xy + G.xy * memory.yy;
    const Number yx = G.yx * memory.xx + G.yy * memory.xy, yy = G.yx * memory.xy + G.yy * memory.yy;
    const Number b_xx = xx * G.xx + xy * G.xy, b_xy = xx * G.yx + xy * G.yy, b_yy = yx * G.yx + yy * G.yy;
    const Number mean = 0.5 * (b_xx + b_yy), half = 0.5 * (b_xx - b_yy), radius = (half * half + b_xy * b_xy).sqrt();
    const Number largest = mean + radius;
    const auto round = radius > 1e-15 * mean;  // else any direction will do
    const Number over = 1.0 / round.select(radius, Number::Ones());
    Strains e;
    e.cosine = round.select(half * over, Number::Ones());
    e.sine = round.select(b_xy * over, Number::Zero());
    const Number one = 0.5 * each<logarithm>(largest), both = 0.5 * each<logarithm>(b_xx * b_yy - b_xy * b_xy);
    const Number three = 0.5 * each<logarithm>(F.zz * F.zz * memory.zz), two = both - one;
    e.trace = both + three;
    const Number third = e.trace / 3.0;
    e.first = one - third;
    e.second = two - third;
    e.third = three - third;
    return e;
  }

  [[gnu::noinline]] void flow(const AxialTensor<Number>& F, const Number& size, const Number& limit,
                              const Number& excess, Strains& e, PlasticMemory<W>& memory, Number& lost) const {
    const auto flows = excess > 0.0;
    const Number slip = flows.select(excess / (2.0 * mu + 2.0 / 3 * hardening), Number::Zero());
    const Number kept = 1.0 - slip / flows.select(size, Number::Ones());
    lost += slip * (limit + hardening / 3 * slip);
    memory.strain += root * slip;
    e.first *= kept;
    e.second *= kept;
    e.third *= kept;
    const Number third = e.trace / 3.0;
    const Number one = each<exponential>(2.0 * (e.first + third)), two = each<exponential>(2.0 * (e.second + third)),
                 three = each<exponential>(2.0 * (e.third + third));
    const Number mean = 0.5 * (one + two), half = 0.5 * (one - two);
    const Inverse inverse(F);
    const Tensor<Number> b(mean + half * e.cosine, half * e.sine, half * e.sine, mean - half * e.cosine);
    const Number xx = inverse.xx * b.xx + inverse.xy * b.yx, xy = inverse.xx * b.xy + inverse.xy * b.yy;
    const Number yx = inverse.yx * b.xx + inverse.yy * b.yx, yy = inverse.yx * b.xy + inverse.yy * b.yy;
    memory.xx = flows.select(xx * inverse.xx + xy * inverse.xy, memory.xx);
    memory.xy = flows.select(xx * inverse.yx + xy * inverse.yy, memory.xy);
    memory.yy = flows.select(yx * inverse.yx + yy * inverse.yy, memory.yy);
    memory.zz = flows.select(three * inverse.zz * inverse.zz, memory.zz);
  }

  [[gnu::always_inline]] AxialTensor<Number> kirchhoff(const Strains& e) const {
    const Number pressure = bulk() * e.trace, twice = 2.0 * mu;
    const Number mean = pressure + mu * (e.first + e.second), half = mu * (e.first - e.second);
    const Number shear = half * e.sine;
    return {{mean + half * e.cosine, shear, shear, mean - half * e.cosine}, pressure + twice * e.third};
  }

  [[gnu::always_inline]] AxialTensor<Number> stress_of(const AxialTensor<Number>& F, const Strains& e) const {
    const Inverse inverse(F);
    const AxialTensor<Number> tau = kirchhoff(e);
    return {inverse.before_transposed(tau.plane), tau.zz * inverse.zz};
  }
};

}  // namespace ricochet
