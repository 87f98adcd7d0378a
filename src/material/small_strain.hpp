#pragma once
#include "material/tensor.hpp"

namespace ricochet {

/// Hooke's law of small strains e = (F + F^T)/2 - 1:
///   W = lambda/2 (tr e)^2 + mu e:e,  P = lambda (tr e) 1 + 2 mu e
/// It is what vibration modes and theories of small strains speak of. A rotation is no small strain: a body that turns
/// by an angle sees the strain cos(angle) - 1.
template <class Number>
struct SmallStrain {
  Number lambda, mu;

  Number energy(const Tensor<Number>& F) const {
    const Number xx = F.xx - 1.0, yy = F.yy - 1.0, xy = 0.5 * (F.xy + F.yx), trace = xx + yy;
    return 0.5 * lambda * trace * trace + mu * (xx * xx + yy * yy + 2.0 * xy * xy);
  }
  [[gnu::always_inline]] Tensor<Number> stress(const Tensor<Number>& F) const {
    const Number xx = F.xx - 1.0, yy = F.yy - 1.0, shear = mu * (F.xy + F.yx);
    return of(xx, yy, shear);
  }
  Tensor<Number> tangent(const Tensor<Number>&, const Tensor<Number>& dF) const {
    return of(dF.xx, dF.yy, Number(mu * (dF.xy + dF.yx)));
  }

  Number energy(const AxialTensor<Number>& G) const {
    const Tensor<Number>& F = G.plane;
    const Number xx = F.xx - 1.0, yy = F.yy - 1.0, zz = G.zz - 1.0, xy = 0.5 * (F.xy + F.yx), trace = xx + yy + zz;
    return 0.5 * lambda * trace * trace + mu * (xx * xx + yy * yy + zz * zz + 2.0 * xy * xy);
  }
  [[gnu::always_inline]] AxialTensor<Number> stress(const AxialTensor<Number>& G) const {
    const Tensor<Number>& F = G.plane;
    const Number xx = F.xx - 1.0, yy = F.yy - 1.0, zz = G.zz - 1.0, shear = mu * (F.xy + F.yx);
    return of(xx, yy, zz, shear);
  }
  AxialTensor<Number> tangent(const AxialTensor<Number>&, const AxialTensor<Number>& dG) const {
    return of(dG.plane.xx, dG.plane.yy, dG.zz, Number(mu * (dG.plane.xy + dG.plane.yx)));
  }

 private:
  [[gnu::always_inline]] Tensor<Number> of(const Number& xx, const Number& yy, const Number& shear) const {
    const Number pressure = lambda * (xx + yy), twice = 2.0 * mu;
    return {pressure + twice * xx, shear, shear, pressure + twice * yy};
  }
  [[gnu::always_inline]] AxialTensor<Number> of(const Number& xx, const Number& yy, const Number& zz,
                                                const Number& shear) const {
    const Number pressure = lambda * (xx + yy + zz), twice = 2.0 * mu;
    return {{pressure + twice * xx, shear, shear, pressure + twice * yy}, pressure + twice * zz};
  }
};

}  // namespace ricochet
