#pragma once
// ln(x) from additions, multiplications and one division: the same bits on every machine and C library, and a loop over
// it vectorises. Fewer than 2 units in the last place of error, also near 1 (tests/core/test_exponential.cpp).

#include <bit>
#include <cstdint>

namespace ricochet {

/// ln(x) of a normal x > 0 below 2^1023; no number else.
[[gnu::always_inline]] inline double logarithm(double x) {
  // x = 2^k m with sqrt(1/2) <= m < sqrt(2), to a unit in the last place of the bounds.
  constexpr std::uint64_t least = 0x3fe6a09e667f3bcd, mantissa = (std::uint64_t{1} << 52) - 1;
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x), above = bits - least;
  const double m = std::bit_cast<double>((above & mantissa) + least);
  // k + 1022 as the low bits of a double whose unit is 1, which a subtraction then leaves alone.
  const std::uint64_t whole = ((above + (std::uint64_t{1022} << 52)) >> 52) | std::uint64_t{0x4330000000000000};
  const double k = std::bit_cast<double>(whole) - (0x1p52 + 1022);
  // ln m = 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1)/(m + 1): the term after s^23/23 is below 2^-62 of it.
  const double s = (m - 1.0) / (m + 1.0), z = s * s;
  double p = 1.0 / 23.0;
  p = p * z + 1.0 / 21.0;
  p = p * z + 1.0 / 19.0;
  p = p * z + 1.0 / 17.0;
  p = p * z + 1.0 / 15.0;
  p = p * z + 1.0 / 13.0;
  p = p * z + 1.0 / 11.0;
  p = p * z + 1.0 / 9.0;
  p = p * z + 1.0 / 7.0;
  p = p * z + 1.0 / 5.0;
  p = p * z + 1.0 / 3.0;
  const double of_mantissa = 2.0 * (p * z * s + s);
  const double sum = k * ln2_high + (of_mantissa + k * ln2_low);
  return x > 0 && x < 0x1p1023 ? sum : (x - x) / (x - x);
}

/// artanh(s)/s of z = s^2 <= 0.01, of numbers or of lanes; ln x = 2 artanh((x - 1)/(x + 1)).
template <class Number>
[[gnu::always_inline]] inline Number artanh_ratio(const Number& z) {
  // 1 + z/3 + z^2/5 + ...: the term after z^7/15 is below 2^-57. In halves, which do not wait for each other.
  const Number z2 = z * z;
  const Number low = (1.0 + z * (1.0 / 3)) + z2 * (1.0 / 5 + z * (1.0 / 7));
  const Number high = (1.0 / 9 + z * (1.0 / 11)) + z2 * (1.0 / 13 + z * (1.0 / 15));
  return low + z2 * z2 * high;
}

}  // namespace ricochet
