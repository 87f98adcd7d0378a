#pragma once
#include <array>

namespace ricochet {

/// T = ka x + kb x^3, V = ka x^2 / 2 + kb x^4 / 4; x: stretch from the rest length [R], quartic = kb / ka [1/R^2].
/// All are given per unit of ka, factored: T = x (1 + quartic x^2).   [Hayakawa & Kuninaka 2003, eq. interaction]
struct Quartic {
  double quartic, inverse = 1 / quartic;
  template <class Number>
  Number energy(const Number& x) const {
    return (x * x) * (0.5 + (0.25 * quartic) * (x * x));
  }
  template <class Number>
  Number tension(const Number& x) const {
    return x * (1.0 + quartic * (x * x));
  }
  /// dT/dx
  template <class Number>
  Number tangent(const Number& x) const {
    return 1.0 + 3 * quartic * (x * x);
  }

  /// T = scale() scaled_tension(x): a sweep multiplies the body's stiffness by the scale once, and saves a
  /// multiplication a spring.
  double scale() const { return quartic; }
  template <class Number>
  Number scaled_tension(const Number& x) const {
    return x * (inverse + x * x);
  }

  /// V = series()[0] x^2 + series()[1] x^3 + series()[2] x^4
  std::array<double, 3> series() const { return {0.5, 0, quartic / 4}; }
};

}  // namespace ricochet
