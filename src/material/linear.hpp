#pragma once
#include <array>

namespace ricochet {

/// T = k x, V = k x^2 / 2; x: stretch from the rest length [R]. All are given per unit of k.
struct Linear {
  template <class Number>
  Number energy(const Number& x) const {
    return 0.5 * x * x;
  }
  template <class Number>
  Number tension(const Number& x) const {
    return x;
  }
  /// dT/dx
  template <class Number>
  Number tangent(const Number& x) const {
    return 0.0 * x + 1.0;
  }

  /// T = scale() scaled_tension(x): a sweep multiplies the body's stiffness by the scale once.
  double scale() const { return 1; }
  template <class Number>
  Number scaled_tension(const Number& x) const {
    return x;
  }

  /// V = series()[0] x^2 + series()[1] x^3 + series()[2] x^4
  std::array<double, 3> series() const { return {0.5, 0, 0}; }
};

}  // namespace ricochet
