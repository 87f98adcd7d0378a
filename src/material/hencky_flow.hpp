#pragma once
// A metal: an elastic law of logarithmic strains whose deviator cannot pass a yield stress.

#include <bit>
#include <cstdint>

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
///
/// Without principal values, as b has m = (b_xx + b_yy)/2 and a deviator of size r in the plane [here]:
///   tr e = ln J,  2 e_3 = ln b_zz,  e_1 - e_2 = artanh(r/m),  and d in the plane is -d_3/2 and the deviator of b times
///   artanh(r/m)/(2 r)
/// whose series are short where elastic strains are small, as those of metals are.
template <int W>
struct HenckyFlow {
  using Number = Lane<W>;
  Number lambda, mu;        // of space
  double yield, hardening;  // Y and H [m0 c^2/R^3]

  Number energy(const AxialTensor<Number>& F, const PlasticMemory<W>& memory) const {
    const Strains e = elastic_strains(F, area_of(F), memory);
    return mu * squared(e) + 0.5 * bulk() * e.trace * e.trace;
  }

  /// P at F, after what flows has flowed; adds what that loses to `lost`. [per volume at rest]
  AxialTensor<Number> stress(const AxialTensor<Number>& F, PlasticMemory<W>& memory, Number& lost) const {
    const Inverse inverse(F);
    const AxialTensor<Number> tau = flowed(F, inverse.area, memory, lost);
    return {inverse.before_transposed(tau.plane), tau.zz * inverse.zz};
  }

  /// tau in the place of P. `area`: F's determinant in the plane.
  [[gnu::always_inline]] AxialTensor<Number> flowed(const AxialTensor<Number>& F, const Number& area,
                                                    PlasticMemory<W>& memory, Number& lost) const {
    Strains e = elastic_strains(F, area, memory);
    const Number limit = root * (yield + hardening * memory.strain), twice = 2.0 * mu, size2 = squared(e);
    const Number past = twice * twice * size2 - limit * limit;
    if (any_negative(-past)) flow(F.plane, past, size2, limit, e, memory, lost);
    return kirchhoff(e);
  }

  /// The change of P by a change of F, as long as nothing flows: tau changes by Hooke's law of the strain's rate, and
  /// turns with it. Of small elastic strains, which are all that metals have; what flows is softer.
  AxialTensor<Number> tangent(const AxialTensor<Number>& F, const AxialTensor<Number>& dF,
                              const PlasticMemory<W>& memory) const {
    const Inverse inverse(F);
    const AxialTensor<Number> tau = kirchhoff(elastic_strains(F, inverse.area, memory));
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
    return kirchhoff(elastic_strains(F, area_of(F), memory));
  }

 private:
  static constexpr double root = 0.81649658092772603;  // sqrt(2/3)

  static constexpr double short_series = 0.01;  // up to which squares of artanh's arguments it is used

  /// Elastic logarithmic strains, and the deviator of b in the plane: its components and r^2.
  struct Strains {
    Number trace, third;        // of e, and d_3
    Number half, shear, size2;  // (b_xx - b_yy)/2, b_xy and r^2
    Number mean;                // m
    Number per_size;            // (e_1 - e_2)/r
  };

  /// F^-1.
  struct Inverse {
    Number xx, xy, yx, yy, zz;
    Number area;  // of F in the plane
    [[gnu::always_inline]] explicit Inverse(const AxialTensor<Number>& F) {
      area = area_of(F);
      const Number over = 1.0 / area;
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

  [[gnu::always_inline]] static Number area_of(const AxialTensor<Number>& F) {
    return F.plane.xx * F.plane.yy - F.plane.xy * F.plane.yx;
  }

  Number bulk() const { return lambda + 2.0 / 3 * mu; }

  // |d|^2
  [[gnu::always_inline]] static Number squared(const Strains& e) {
    return 1.5 * (e.third * e.third) + 0.5 * (e.per_size * e.per_size * e.size2);
  }

  template <double function(double)>
  [[gnu::always_inline]] static Number each(const Number& x) {
    Number y;
    const double* from = x.data();
    double* to = y.data();
#pragma GCC unroll 1  // unrolled before it is vectorised, it stays one lane after another: twice the time
    for (int lane = 0; lane < W; ++lane) to[lane] = function(from[lane]);
    return y;
  }

  // Or not a number, of either sign: cheaper than to compare.
  [[gnu::always_inline]] static bool any_negative(const Number& x) {
    std::uint64_t signs = 0;
    for (int lane = 0; lane < W; ++lane) signs |= std::bit_cast<std::uint64_t>(x[lane]);
    return signs >> 63 != 0;
  }

  [[gnu::always_inline]] static Strains elastic_strains(const AxialTensor<Number>& F, const Number& area,
                                                        const PlasticMemory<W>& memory) {
    const Tensor<Number>& G = F.plane;
    const Number xx = G.xx * memory.xx + G.xy * memory.xy, xy = G.xx * memory.xy + G.xy * memory.yy;
    const Number yx = G.yx * memory.xx + G.yy * memory.xy, yy = G.yx * memory.xy + G.yy * memory.yy;
    const Number b_xx = xx * G.xx + xy * G.xy, b_yy = yx * G.yx + yy * G.yy;
    Strains e;
    e.shear = xx * G.yx + xy * G.yy;
    e.half = 0.5 * (b_xx - b_yy);
    e.mean = 0.5 * (b_xx + b_yy);
    e.size2 = e.half * e.half + e.shear * e.shear;
    const Number volume = area * F.zz, b_zz = F.zz * F.zz * memory.zz;
    const Number per_mean = 1.0 / e.mean, v = (volume - 1.0) / (volume + 1.0), z = (b_zz - 1.0) / (b_zz + 1.0);
    const Number v2 = v * v, z2 = z * z, r2 = e.size2 * (per_mean * per_mean);
    e.trace = 2.0 * v * artanh_ratio(v2);
    e.per_size = per_mean * artanh_ratio(r2);
    const Number three = z * artanh_ratio(z2);
    e.third = three - e.trace / 3.0;
    if (any_negative(short_series - v2.max(z2).max(r2))) beyond(volume, b_zz, v2, z2, r2, e);
    return e;
  }

  // The strains of lanes that the short series do not reach.
  [[gnu::noinline]] static void beyond(const Number& volume, const Number& b_zz, const Number& v2, const Number& z2,
                                       const Number& r2, Strains& e) {
    const Number three = 0.5 * each<logarithm>(b_zz), size = e.size2.sqrt();
    const Number near_third = e.third + e.trace / 3.0;
    e.trace = (v2 <= short_series).select(e.trace, each<logarithm>(volume.abs()));
    e.third = (z2 <= short_series).select(near_third, three) - e.trace / 3.0;
    const Number ratio = size / e.mean;
    e.per_size = (r2 <= short_series).select(e.per_size, 0.5 * each<logarithm>((1.0 + ratio) / (1.0 - ratio)) / size);
  }

  /// What flowing by w d does to b = m + D in the plane and across it: exp(-2 w d) b. With y = w d_3 and x = w (e_1 -
  /// e_2), exp(y) (cosh x - sinh x/r D) and exp(-2 y).
  struct Shrinking {
    Number in_plane, across;       // exp(y), exp(-2 y)
    Number cosine, sine_per_size;  // cosh x, sinh x/r
  };

  [[gnu::always_inline]] static Shrinking shrinking(const Number& w, const Strains& e) {
    const Number y = w * e.third, slope = w * e.per_size, y2 = y * y, x2 = slope * slope * e.size2;
    const Number even = even_exponential(y2), odd = y * odd_exponential(y2), backward = even - odd;
    Shrinking by{even + odd, backward * backward, even_exponential(x2), slope * odd_exponential(x2)};
    if (any_negative(short_series - y2.max(x2))) shrink_far(y, slope, y2, x2, by);
    return by;
  }

  // What lanes that the short series do not reach do.
  [[gnu::noinline]] static void shrink_far(const Number& y, const Number& slope, const Number& y2, const Number& x2,
                                           Shrinking& by) {
    const Number x = x2.sqrt(), up = each<exponential>(x), down = each<exponential>(-x);
    by.in_plane = (y2 <= short_series).select(by.in_plane, each<exponential>(y));
    by.across = (y2 <= short_series).select(by.across, each<exponential>(-2.0 * y));
    by.cosine = (x2 <= short_series).select(by.cosine, 0.5 * (up + down));
    by.sine_per_size = (x2 <= short_series).select(by.sine_per_size, slope * (0.5 * (up - down) / x));
  }

  // `past`: above 0 where something flows. Where nothing does, w = 0 leaves every bit as it was.
  [[gnu::noinline]] void flow(const Tensor<Number>& F, const Number& past, const Number& size2, const Number& limit,
                              Strains& e, PlasticMemory<W>& memory, Number& lost) const {
    const Number size = size2.sqrt();
    const Number share = ((2.0 * mu - limit / size) / (2.0 * mu + 2.0 / 3 * hardening)).max(Number::Zero());
    Number w;
#pragma GCC unroll 1
    for (int lane = 0; lane < W; ++lane) w[lane] = past[lane] > 0 ? share[lane] : 0.0;
    const Number slip = w * size, kept = 1.0 - w;
    const Shrinking by = shrinking(w, e);
    lost += slip * (limit + hardening / 3 * slip);
    memory.strain += root * slip;
    e.third *= kept;
    e.per_size *= kept;
    // b of what is kept is a + c b, so C_p^-1 is a (F^T F)^-1 + c C_p^-1.
    const Number c = by.in_plane * (by.cosine - e.mean * by.sine_per_size);
    const Number a = by.in_plane * by.sine_per_size * (memory.xx * memory.yy - memory.xy * memory.xy);
    memory.xx = a * (F.xy * F.xy + F.yy * F.yy) + c * memory.xx;
    memory.xy = c * memory.xy - a * (F.xx * F.xy + F.yx * F.yy);
    memory.yy = a * (F.xx * F.xx + F.yx * F.yx) + c * memory.yy;
    memory.zz *= by.across;
  }

  [[gnu::always_inline]] AxialTensor<Number> kirchhoff(const Strains& e) const {
    const Number pressure = bulk() * e.trace, third = mu * e.third, mean = pressure - third;
    const Number slope = mu * e.per_size, half = slope * e.half, shear = slope * e.shear;
    return {{mean + half, shear, shear, mean - half}, pressure + 2.0 * third};
  }
};

}  // namespace ricochet
