#pragma once
#include "material/edge_metric.hpp"
#include "material/tensor.hpp"

namespace ricochet {

/// A solid that may be strained, turned and even folded as far as one likes:
///   W = mu/2 (|F|^2 - 2) - mu (J - 1) + (lambda + mu)/2 (J - 1)^2,  J = det F
///   P = mu F + ((lambda + mu)(J - 1) - mu) cof F,  cof F = [[F_yy, -F_yx], [-F_xy, F_xx]]
/// In singular values W = mu/2 (s1 - s2)^2 + (lambda + mu)/2 (s1 s2 - 1)^2: no root, division or logarithm, so that it
/// stays finite where a triangle is turned over; linear in uniaxial strain. Written by |F|^2 - 2 J =
/// (F_xx - F_yy)^2 + (F_xy + F_yx)^2, which a rotation leaves 0 to the last digit. [here: a
/// neo-Hookean law whose resistance to a change of area is a polynomial of it]
/// In a body of revolution F and J are those of space, and the first term is mu/2 (|F|^2 - 3); with A the determinant
/// in the plane, |F|^2 - 1 - 2 J = (F_xx - F_yy)^2 + (F_xy + F_yx)^2 + (F_zz - 1)(F_zz + 1 - 2 A). At F_zz = 1 it is
/// the law of the plane.
template <class Number>
struct Polynomial {
  Number lambda, mu;

  Number energy(const Tensor<Number>& F) const {
    const Number difference = F.xx - F.yy, sum = F.xy + F.yx, swelling = F.xx * F.yy - F.xy * F.yx - 1.0;
    return 0.5 * mu * (difference * difference + sum * sum) + 0.5 * (lambda + mu) * swelling * swelling;
  }
  [[gnu::always_inline]] Tensor<Number> stress(const Tensor<Number>& F) const {
    const Number a = mu * (F.xx - F.yy), b = mu * (F.xy + F.yx);
    const Number s = (lambda + mu) * (F.xx * F.yy - F.xy * F.yx - 1.0), minus = -s;
    return {a + s * F.yy, b + minus * F.yx, b + minus * F.xy, s * F.xx - a};
  }
  /// The weight times P D0^-T, column by column: what pulls the ends of the edges D = [d1 d2] back. As |F|^2 and J are
  /// functions of D without F, so is its derivative: a fifth less to compute than by the stress.
  [[gnu::always_inline]] Tensor<Number> edge_pulls(const Tensor<Number>& D, const EdgeMetric& at_rest) const {
    const Number determinant = D.xx * D.yy - D.xy * D.yx;
    const Number s = ((lambda + mu) * (determinant * at_rest.per_rest_area - 1.0) - mu) * at_rest.share, minus = -s;
    return {mu * (D.xx * at_rest.xx + D.xy * at_rest.xy) + s * D.yy,
            mu * (D.xx * at_rest.xy + D.xy * at_rest.yy) + minus * D.yx,
            mu * (D.yx * at_rest.xx + D.yy * at_rest.xy) + minus * D.xy,
            mu * (D.yx * at_rest.xy + D.yy * at_rest.yy) + s * D.xx};
  }
  Tensor<Number> tangent(const Tensor<Number>& F, const Tensor<Number>& dF) const {
    const Number da = mu * (dF.xx - dF.yy), db = mu * (dF.xy + dF.yx);
    const Number s = (lambda + mu) * (F.xx * F.yy - F.xy * F.yx - 1.0);
    const Number ds = (lambda + mu) * (F.yy * dF.xx + F.xx * dF.yy - F.yx * dF.xy - F.xy * dF.yx);
    return {da + ds * F.yy + s * dF.yy, db - ds * F.yx - s * dF.yx, db - ds * F.xy - s * dF.xy,
            ds * F.xx + s * dF.xx - da};
  }

  Number energy(const AxialTensor<Number>& G) const {
    const Tensor<Number>& F = G.plane;
    const Number difference = F.xx - F.yy, sum = F.xy + F.yx, area = F.xx * F.yy - F.xy * F.yx;
    const Number swelling = area * G.zz - 1.0;
    return 0.5 * mu * (difference * difference + sum * sum + (G.zz - 1.0) * (G.zz + 1.0 - 2.0 * area)) +
           0.5 * (lambda + mu) * swelling * swelling;
  }
  [[gnu::always_inline]] AxialTensor<Number> stress(const AxialTensor<Number>& G) const {
    const Tensor<Number>& F = G.plane;
    const Number a = mu * (F.xx - F.yy), b = mu * (F.xy + F.yx), area = F.xx * F.yy - F.xy * F.yx;
    const Number pressure = (lambda + mu) * (area * G.zz - 1.0);
    const Number s = pressure * G.zz - mu * (G.zz - 1.0), minus = -s;
    return {{a + s * F.yy, b + minus * F.yx, b + minus * F.xy, s * F.xx - a}, mu * (G.zz - area) + pressure * area};
  }
  AxialTensor<Number> tangent(const AxialTensor<Number>& G, const AxialTensor<Number>& dG) const {
    const Tensor<Number>&F = G.plane, &dF = dG.plane;
    const Number da = mu * (dF.xx - dF.yy), db = mu * (dF.xy + dF.yx), area = F.xx * F.yy - F.xy * F.yx;
    const Number darea = F.yy * dF.xx + F.xx * dF.yy - F.yx * dF.xy - F.xy * dF.yx;
    const Number pressure = (lambda + mu) * (area * G.zz - 1.0),
                 dpressure = (lambda + mu) * (darea * G.zz + area * dG.zz);
    const Number s = pressure * G.zz - mu * (G.zz - 1.0), ds = dpressure * G.zz + (pressure - mu) * dG.zz;
    return {{da + ds * F.yy + s * dF.yy, db - ds * F.yx - s * dF.yx, db - ds * F.xy - s * dF.xy,
             ds * F.xx + s * dF.xx - da},
            mu * (dG.zz - darea) + dpressure * area + pressure * darea};
  }
};

}  // namespace ricochet
