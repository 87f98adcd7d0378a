#pragma once
#include "material/tensor.hpp"

namespace ricochet {

/// Hooke's law between the strain of Green E = (F^T F - 1)/2 and the second stress of Piola and Kirchhoff S:
///   W = lambda/2 (tr E)^2 + mu E:E,  P = F S,  S = lambda (tr E) 1 + 2 mu E
/// It softens as it is compressed, and in uniaxial strain gives way below 1/sqrt(3) of its length: for comparison.
/// [Holzapfel, Nonlinear Solid Mechanics, 2000, section 6.5]
template <class Number>
struct StVenantKirchhoff {
  Number lambda, mu;

  Number energy(const Tensor<Number>& F) const {
    const Symmetric E = strain(F);
    const Number trace = E.xx + E.yy;
    return 0.5 * lambda * trace * trace + mu * (E.xx * E.xx + E.yy * E.yy + 2.0 * E.xy * E.xy);
  }
  [[gnu::always_inline]] Tensor<Number> stress(const Tensor<Number>& F) const {
    return times(F, second_stress(strain(F)));
  }
  Tensor<Number> tangent(const Tensor<Number>& F, const Tensor<Number>& dF) const {
    const Tensor<Number> a = times(dF, second_stress(strain(F))), b = times(F, second_stress(change(F, dF)));
    return {a.xx + b.xx, a.xy + b.xy, a.yx + b.yx, a.yy + b.yy};
  }

  Number energy(const AxialTensor<Number>& G) const {
    const Symmetric E = strain(G.plane);
    const Number zz = 0.5 * (G.zz * G.zz - 1.0), trace = E.xx + E.yy + zz;
    return 0.5 * lambda * trace * trace + mu * (E.xx * E.xx + E.yy * E.yy + zz * zz + 2.0 * E.xy * E.xy);
  }
  [[gnu::always_inline]] AxialTensor<Number> stress(const AxialTensor<Number>& G) const {
    const Symmetric E = strain(G.plane);
    const Number zz = 0.5 * (G.zz * G.zz - 1.0), pressure = lambda * (E.xx + E.yy + zz);
    return {times(G.plane, second_stress(E, pressure)), G.zz * (pressure + 2.0 * mu * zz)};
  }
  AxialTensor<Number> tangent(const AxialTensor<Number>& G, const AxialTensor<Number>& dG) const {
    const Symmetric E = strain(G.plane), dE = change(G.plane, dG.plane);
    const Number zz = 0.5 * (G.zz * G.zz - 1.0), dzz = G.zz * dG.zz;
    const Number pressure = lambda * (E.xx + E.yy + zz), dpressure = lambda * (dE.xx + dE.yy + dzz);
    const Tensor<Number> a = times(dG.plane, second_stress(E, pressure)),
                         b = times(G.plane, second_stress(dE, dpressure));
    return {{a.xx + b.xx, a.xy + b.xy, a.yx + b.yx, a.yy + b.yy},
            dG.zz * (pressure + 2.0 * mu * zz) + G.zz * (dpressure + 2.0 * mu * dzz)};
  }

 private:
  struct Symmetric {
    Number xx, yy, xy;
  };
  [[gnu::always_inline]] static Symmetric strain(const Tensor<Number>& F) {
    return {0.5 * (F.xx * F.xx + F.yx * F.yx - 1.0), 0.5 * (F.xy * F.xy + F.yy * F.yy - 1.0),
            0.5 * (F.xx * F.xy + F.yx * F.yy)};
  }
  static Symmetric change(const Tensor<Number>& F, const Tensor<Number>& dF) {
    return {F.xx * dF.xx + F.yx * dF.yx, F.xy * dF.xy + F.yy * dF.yy,
            0.5 * (F.xx * dF.xy + F.xy * dF.xx + F.yx * dF.yy + F.yy * dF.yx)};
  }
  [[gnu::always_inline]] Symmetric second_stress(const Symmetric& E) const {
    return second_stress(E, Number(lambda * (E.xx + E.yy)));
  }
  [[gnu::always_inline]] Symmetric second_stress(const Symmetric& E, const Number& pressure) const {
    const Number twice = 2.0 * mu;
    return {pressure + twice * E.xx, pressure + twice * E.yy, twice * E.xy};
  }
  [[gnu::always_inline]] static Tensor<Number> times(const Tensor<Number>& F, const Symmetric& S) {
    return {F.xx * S.xx + F.xy * S.xy, F.xx * S.xy + F.xy * S.yy, F.yx * S.xx + F.yy * S.xy, F.yx * S.xy + F.yy * S.yy};
  }
};

}  // namespace ricochet
