#pragma once

namespace ricochet {

/// T = k x, V = k x^2 / 2; x: stretch from the rest length [R]. Both are given per unit of k.
struct Linear {
  template <class Number>
  Number tension(const Number& x) const {
    return x;
  }
  template <class Number>
  Number energy(const Number& x) const {
    return 0.5 * x * x;
  }

  double scale() const { return 1; }
  template <class Number>
  Number scaled_tension(const Number& x) const {
    return x;
  }
};

}  // namespace ricochet
