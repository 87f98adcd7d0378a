#pragma once
// exp(x) from additions, multiplications and one table-free scaling: the same bits on every machine and C library, and
// a loop over it vectorises. Fewer than 2 units in the last place of error (tests/core/test_exponential.cpp).

#include <bit>
#include <cstdint>

namespace ricochet {

/// exp(x) for x in [-700, 700]; the caller bounds x.
[[gnu::always_inline]] inline double exponential(double x) {
  // x = k ln 2 + r, |r| <= ln 2 / 2; ln 2 in two parts, so that k ln2_high is exact (Cody & Waite 1980).
  constexpr double inverse_ln2 = 1.4426950408889634074;
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  constexpr double shifter = 0x1.8p52;  // adding it rounds to an integer, kept in the low bits
  const double shifted = x * inverse_ln2 + shifter;
  const double k = shifted - shifter;
  const double r = (x - k * ln2_high) - k * ln2_low;
  // Taylor to r^13 / 13!: the next term is below 2^-58 for |r| <= 0.347.
  double p = 1.0 / 6227020800.0;
  p = p * r + 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  p = p * r * r + r;  // exp(r) - 1: adding the 1 last keeps its digits
  const std::uint64_t exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023) << 52;
  return (p + 1.0) * std::bit_cast<double>(exponent);
}

/// cosh(x) and sinh(x)/x of z = x^2 <= 0.01, of numbers or of lanes: exp(x) is the one and x times the other. The terms
/// left out are below 2^-55.
template <class Number>
[[gnu::always_inline]] inline Number even_exponential(const Number& z) {
  return (1.0 + z * (1.0 / 2)) + z * z * (1.0 / 24 + z * (1.0 / 720 + z * (1.0 / 40320)));
}
template <class Number>
[[gnu::always_inline]] inline Number odd_exponential(const Number& z) {
  return (1.0 + z * (1.0 / 6)) + z * z * (1.0 / 120 + z * (1.0 / 5040 + z * (1.0 / 362880)));
}

}  // namespace ricochet
