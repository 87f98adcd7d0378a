#pragma once
#include "material/tensor.hpp"

namespace ricochet {

/// A solid that may be strained, turned and even folded as far as one likes:
///   W = mu/2 (|F|^2 - 2) - mu (J - 1) + (lambda + mu)/2 (J - 1)^2,  J = det F
///   P = mu F + ((lambda + mu)(J - 1) - mu) cof F,  cof F = [[F_yy, -F_yx], [-F_xy, F_xx]]
/// In singular values W = mu/2 (s1 - s2)^2 + (lambda + mu)/2 (s1 s2 - 1)^2: no root, division or logarithm, so that it
/// stays finite where a triangle is turned over; linear in uniaxial strain. Written by |F|^2 - 2 J =
/// (F_xx - F_yy)^2 + (F_xy + F_yx)^2, which a rotation leaves 0 to the last digit. [here: a
/// neo-Hookean law whose resistance to a change of area is a polynomial of it]
template <class Number>
struct Polynomial {
  Number lambda, mu;

  Number energy(const Tensor<Number>& F) const {
    const Number difference = F.xx - F.yy, sum = F.xy + F.yx, swelling = F.xx * F.yy - F.xy * F.yx - 1.0;
    return 0.5 * mu * (difference * difference + sum * sum) + 0.5 * (lambda + mu) * swelling * swelling;
  }
  Tensor<Number> stress(const Tensor<Number>& F) const {
    const Number a = mu * (F.xx - F.yy), b = mu * (F.xy + F.yx);
    const Number s = (lambda + mu) * (F.xx * F.yy - F.xy * F.yx - 1.0), minus = -s;
    return {a + s * F.yy, b + minus * F.yx, b + minus * F.xy, s * F.xx - a};
  }
  Tensor<Number> tangent(const Tensor<Number>& F, const Tensor<Number>& dF) const {
    const Number da = mu * (dF.xx - dF.yy), db = mu * (dF.xy + dF.yx);
    const Number s = (lambda + mu) * (F.xx * F.yy - F.xy * F.yx - 1.0);
    const Number ds = (lambda + mu) * (F.yy * dF.xx + F.xx * dF.yy - F.yx * dF.xy - F.xy * dF.yx);
    return {da + ds * F.yy + s * dF.yy, db - ds * F.yx - s * dF.yx, db - ds * F.xy - s * dF.xy,
            ds * F.xx + s * dF.xx - da};
  }
};

}  // namespace ricochet
