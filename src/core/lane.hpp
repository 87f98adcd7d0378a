#pragma once
// A lane is one of W impacts that advance together; a Lane<W> holds one quantity of all of them and is written like a
// number. Every operation on it is element by element and IEEE exact or correctly rounded, so an impact has the same
// bits alone (W = 1) and in any batch. A vector of the compiler's own, with the few operations that are needed: a
// library's expressions, found anew at every one of them, were half of what compiling the engine took.

#include <cmath>
#include <type_traits>

namespace ricochet {

/// A register's numbers, and what comparing them gives: -1 where true, else 0. Written out: GCC 12 forgets the
/// attribute where it depends on a template's parameter.
template <int W>
struct Register;
template <>
struct Register<1> {
  using Numbers = double;
  using Truths = bool;
};
template <>
struct Register<2> {
  using Numbers = double __attribute__((vector_size(16)));
  using Truths = long long __attribute__((vector_size(16)));
};
template <>
struct Register<4> {
  using Numbers = double __attribute__((vector_size(32)));
  using Truths = long long __attribute__((vector_size(32)));
};
template <>
struct Register<8> {
  using Numbers = double __attribute__((vector_size(64)));
  using Truths = long long __attribute__((vector_size(64)));
};

template <int W>
struct Lane;

/// What a comparison gives: true or false in each lane.
template <int W>
struct Truth {
  using Truths = typename Register<W>::Truths;
  Truths v;

  bool operator[](int lane) const {
    if constexpr (W == 1)
      return v;
    else
      return reinterpret_cast<const long long*>(&v)[lane] != 0;
  }
  bool any() const {
    bool found = false;
    for (int lane = 0; lane < W; ++lane) found |= (*this)[lane];
    return found;
  }
  bool all() const { return !(!*this).any(); }
  /// That of `yes` where true, else that of `no`.
  Lane<W> select(const Lane<W>& yes, const Lane<W>& no) const { return Lane<W>(v ? yes.v : no.v); }

  friend Truth operator&&(const Truth& a, const Truth& b) { return {Truths(a.v & b.v)}; }
  friend Truth operator||(const Truth& a, const Truth& b) { return {Truths(a.v | b.v)}; }
  Truth operator!() const {
    if constexpr (W == 1)
      return {!v};
    else
      return {~v};
  }
};

template <int W>
struct Lane {
  using Numbers = typename Register<W>::Numbers;
  Numbers v;

  Lane() = default;
  [[gnu::always_inline]] explicit Lane(const Numbers& numbers) : v(numbers) {}
  [[gnu::always_inline]] static Lane Constant(double value) {
    if constexpr (W == 1)
      return Lane(value);
    else
      return Lane(Numbers{} + value);
  }
  static Lane Zero() { return Constant(0); }
  static Lane Ones() { return Constant(1); }
  /// In every lane.
  Lane& operator=(double value) { return *this = Constant(value); }
  void setConstant(double value) { *this = Constant(value); }
  void setZero() { v = Numbers{}; }

  /// The lanes' numbers lie one behind the other.
  double* data() { return reinterpret_cast<double*>(&v); }
  const double* data() const { return reinterpret_cast<const double*>(&v); }
  [[gnu::always_inline]] double& operator[](int lane) { return data()[lane]; }
  [[gnu::always_inline]] const double& operator[](int lane) const { return data()[lane]; }

  [[gnu::always_inline]] Lane sqrt() const {
    Lane root;
    for (int lane = 0; lane < W; ++lane) root[lane] = std::sqrt((*this)[lane]);
    return root;
  }
  Lane abs() const {
    if constexpr (W == 1)
      return Lane(std::abs(v));
    else
      return Lane((Numbers)((typename Register<W>::Truths)v & 0x7fffffffffffffff));  // without the sign's bit
  }
  Lane max(const Lane& other) const { return (*this < other).select(other, *this); }
  Lane min(const Lane& other) const { return (other < *this).select(other, *this); }

  Lane operator-() const { return Lane(-v); }
  Lane& operator+=(const Lane& b) {
    v += b.v;
    return *this;
  }
  Lane& operator-=(const Lane& b) {
    v -= b.v;
    return *this;
  }
  Lane& operator*=(const Lane& b) {
    v *= b.v;
    return *this;
  }
  Lane& operator/=(const Lane& b) {
    v /= b.v;
    return *this;
  }
  Lane& operator+=(double b) {
    v += b;
    return *this;
  }
  Lane& operator-=(double b) {
    v -= b;
    return *this;
  }
  Lane& operator*=(double b) {
    v *= b;
    return *this;
  }
  Lane& operator/=(double b) {
    v /= b;
    return *this;
  }

  friend Lane operator+(const Lane& a, const Lane& b) { return Lane(a.v + b.v); }
  friend Lane operator-(const Lane& a, const Lane& b) { return Lane(a.v - b.v); }
  friend Lane operator*(const Lane& a, const Lane& b) { return Lane(a.v * b.v); }
  friend Lane operator/(const Lane& a, const Lane& b) { return Lane(a.v / b.v); }
  friend Lane operator+(const Lane& a, double b) { return Lane(a.v + b); }
  friend Lane operator-(const Lane& a, double b) { return Lane(a.v - b); }
  friend Lane operator*(const Lane& a, double b) { return Lane(a.v * b); }
  friend Lane operator/(const Lane& a, double b) { return Lane(a.v / b); }
  friend Lane operator+(double a, const Lane& b) { return Lane(a + b.v); }
  friend Lane operator-(double a, const Lane& b) { return Lane(a - b.v); }
  friend Lane operator*(double a, const Lane& b) { return Lane(a * b.v); }
  friend Lane operator/(double a, const Lane& b) { return Lane(a / b.v); }

  friend Truth<W> operator<(const Lane& a, const Lane& b) { return {a.v < b.v}; }
  friend Truth<W> operator>(const Lane& a, const Lane& b) { return {a.v > b.v}; }
  friend Truth<W> operator<=(const Lane& a, const Lane& b) { return {a.v <= b.v}; }
  friend Truth<W> operator>=(const Lane& a, const Lane& b) { return {a.v >= b.v}; }
  friend Truth<W> operator==(const Lane& a, const Lane& b) { return {a.v == b.v}; }
  friend Truth<W> operator!=(const Lane& a, const Lane& b) { return {a.v != b.v}; }
  friend Truth<W> operator<(const Lane& a, double b) { return a < Constant(b); }
  friend Truth<W> operator>(const Lane& a, double b) { return a > Constant(b); }
  friend Truth<W> operator<=(const Lane& a, double b) { return a <= Constant(b); }
  friend Truth<W> operator>=(const Lane& a, double b) { return a >= Constant(b); }
  friend Truth<W> operator==(const Lane& a, double b) { return a == Constant(b); }
  friend Truth<W> operator!=(const Lane& a, double b) { return a != Constant(b); }
};

/// W, chosen when the project is configured. 4 doubles fill an AVX2 register.
inline constexpr int lanes = RICOCHET_LANES;

}  // namespace ricochet
