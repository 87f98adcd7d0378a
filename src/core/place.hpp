#pragma once
// The vector of a node in W lanes: its place, velocity or force in D dimensions, as one value.

#include "core/lane.hpp"

namespace ricochet {

/// Everything is written out, component by component: the copy that the compiler makes may move an Eigen array in
/// halves, and the full load that follows waits for both (bench_springs keeps it beside this one: on some machines it
/// costs nothing, on others it doubles the time of a sweep). And all of it is inlined, whatever the compiler's budget:
/// a call a spring did double it.
template <int W, int D>
struct Place {
  static_assert(D == 2 || D == 3);
  Lane<W> at[D];

  [[gnu::always_inline]] Place() {}
  [[gnu::always_inline]] Place(const Lane<W>& x, const Lane<W>& y) {
    at[0] = x;
    at[1] = y;
  }
  [[gnu::always_inline]] Place(const Place& other) { *this = other; }
  // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): it owns nothing
  [[gnu::always_inline]] Place& operator=(const Place& other) {
    at[0] = other.at[0];
    at[1] = other.at[1];
    if constexpr (D == 3) at[2] = other.at[2];
    return *this;
  }
  [[gnu::always_inline]] void set_zero() {
    at[0].setZero();
    at[1].setZero();
    if constexpr (D == 3) at[2].setZero();
  }
  [[gnu::always_inline]] Place& operator+=(const Place& other) {
    at[0] += other.at[0];
    at[1] += other.at[1];
    if constexpr (D == 3) at[2] += other.at[2];
    return *this;
  }
  [[gnu::always_inline]] Place& operator-=(const Place& other) {
    at[0] -= other.at[0];
    at[1] -= other.at[1];
    if constexpr (D == 3) at[2] -= other.at[2];
    return *this;
  }
  /// Adds each component to a sum, by rising component.
  [[gnu::always_inline]] void add_to(Lane<W>& sum) const {
    sum += at[0];
    sum += at[1];
    if constexpr (D == 3) sum += at[2];
  }
};

template <int W, int D>
[[gnu::always_inline]] inline Place<W, D> operator+(const Place<W, D>& a, const Place<W, D>& b) {
  Place<W, D> sum;
  sum.at[0] = a.at[0] + b.at[0];
  sum.at[1] = a.at[1] + b.at[1];
  if constexpr (D == 3) sum.at[2] = a.at[2] + b.at[2];
  return sum;
}

template <int W, int D>
[[gnu::always_inline]] inline Place<W, D> operator-(const Place<W, D>& a, const Place<W, D>& b) {
  Place<W, D> difference;
  difference.at[0] = a.at[0] - b.at[0];
  difference.at[1] = a.at[1] - b.at[1];
  if constexpr (D == 3) difference.at[2] = a.at[2] - b.at[2];
  return difference;
}

/// `by`: of each lane, or one for all.
template <int W, int D, class Number>
[[gnu::always_inline]] inline Place<W, D> operator*(const Number& by, const Place<W, D>& a) {
  Place<W, D> product;
  product.at[0] = by * a.at[0];
  product.at[1] = by * a.at[1];
  if constexpr (D == 3) product.at[2] = by * a.at[2];
  return product;
}

/// Summed by rising component: a vector whose third component is 0 has the bits of one in the plane.
template <int W, int D>
[[gnu::always_inline]] inline Lane<W> dot(const Place<W, D>& a, const Place<W, D>& b) {
  Lane<W> sum = a.at[0] * b.at[0] + a.at[1] * b.at[1];
  if constexpr (D == 3) sum += a.at[2] * b.at[2];
  return sum;
}

}  // namespace ricochet
