#include "theory/spline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace ricochet::theory {

namespace {

constexpr std::size_t greatest_degree = 3;
using Basis = std::array<double, greatest_degree + 1>;

// The splines of one degree that the points determine: as many as there are points.
struct Splines {
  std::size_t count, degree;
  Numbers knots;

  explicit Splines(const Numbers& x) : count(x.size()), degree(std::min(greatest_degree, x.size() - 1)) {
    knots.assign(degree + 1, x.front());
    for (std::size_t i = 1; i + degree < count; ++i) {
      const auto from = x.begin() + static_cast<std::ptrdiff_t>(i);
      const auto to = from + static_cast<std::ptrdiff_t>(degree);
      knots.push_back(std::accumulate(from, to, 0.0) / static_cast<double>(degree));
    }
    knots.insert(knots.end(), degree + 1, x.back());
  }

  // The first of the degree + 1 splines that are not zero at `where`.
  std::size_t first_at(double where) const {
    const auto inner = knots.begin() + static_cast<std::ptrdiff_t>(degree + 1);
    const auto end = knots.begin() + static_cast<std::ptrdiff_t>(count);
    return static_cast<std::size_t>(std::upper_bound(inner, end, where) - inner);
  }

  // Their values there, by the recursion of Cox and de Boor.
  Basis values_at(double where) const {
    const std::size_t span = first_at(where) + degree;
    Basis value{1}, left{}, right{};
    for (std::size_t j = 1; j <= degree; ++j) {
      left[j] = where - knots[span + 1 - j];
      right[j] = knots[span + j] - where;
      double saved = 0;
      for (std::size_t r = 0; r < j; ++r) {
        const double part = value[r] / (right[r + 1] + left[j - r]);
        value[r] = saved + right[r + 1] * part;
        saved = left[j - r] * part;
      }
      value[j] = saved;
    }
    return value;
  }

  double sum_at(double where, const Numbers& weights) const {
    const Basis value = values_at(where);
    const std::size_t first = first_at(where);
    double sum = 0;
    for (std::size_t k = 0; k <= degree; ++k) sum += value[k] * weights[first + k];
    return sum;
  }
};

// The weights with which the splines pass through (x, y). The matrix of the splines at the points is banded and totally
// positive, so elimination needs no pivots [de Boor & Pinkus 1977].
Numbers weights_through(const Splines& splines, const Numbers& x, Numbers y) {
  const std::size_t n = splines.count, reach = splines.degree, width = 2 * reach + 1;
  std::vector<Numbers> band(n, Numbers(width));  // band[i][reach + j - i]: spline j at point i
  for (std::size_t i = 0; i < n; ++i) {
    const Basis value = splines.values_at(x[i]);
    const std::size_t first = splines.first_at(x[i]);
    for (std::size_t k = 0; k <= reach; ++k) band[i][reach + first + k - i] = value[k];
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t row = i + 1; row < std::min(n, i + reach + 1); ++row) {
      const double factor = band[row][reach + i - row] / band[i][reach];
      for (std::size_t j = i; j < std::min(n, i + reach + 1); ++j)
        band[row][reach + j - row] -= factor * band[i][reach + j - i];
      y[row] -= factor * y[i];
    }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < std::min(n, i + reach + 1); ++j) y[i] -= band[i][reach + j - i] * y[j];
    y[i] /= band[i][reach];
  }
  return y;
}

}  // namespace

Numbers cubic_spline(const Numbers& x, const Numbers& y, const Numbers& at) {
  if (x.size() < 2 || x.size() != y.size())
    throw FieldError("psi1", "must hold two values or more, as many as the others");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] <= x[i - 1]) throw FieldError("psi1", fmt::format("must rise, but {:g} follows {:g}", x[i], x[i - 1]));
  const Splines splines(x);
  const Numbers weights = weights_through(splines, x, y);
  Numbers result;
  for (const double where : at) {
    if (where < x.front() || where > x.back())
      throw FieldError("at", fmt::format("must lie within {:g} and {:g}, is {:g}", x.front(), x.back(), where));
    result.push_back(splines.sum_at(where, weights));
  }
  return result;
}

}  // namespace ricochet::theory
