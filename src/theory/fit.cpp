#include "theory/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricochet::theory {

Arguments<ImpactTable> ImpactTable::fields() {
  using S = ImpactTable;
  return {{{"psi1", "numbers", "", "tangent of the incident angle of each impact", not_negative}, &S::psi1},
          {{"psi2", "numbers", "", "its v_ct' over the normal speed before"}, &S::psi2},
          {{"e", "numbers", "", "its normal restitution"}, &S::e},
          {{"beta_x", "number", "", "1 + m R^2/I: 3 for a disk, 3.5 for a sphere", {2, 100}, "3"}, &S::beta_x}};
}

Arguments<WaltonFit> WaltonFit::fields() {
  using S = WaltonFit;
  return {{{"e", "number", "", "normal restitution coefficient, the mean"}, &S::e},
          {{"e_se", "number", "", "its standard error"}, &S::e_se},
          {{"mu", "number", "", "coefficient of friction"}, &S::mu},
          {{"mu_se", "number", "", "its standard error"}, &S::mu_se},
          {{"beta0", "number", "", "greatest tangential restitution coefficient"}, &S::beta0},
          {{"beta0_se", "number", "", "its standard error"}, &S::beta0_se},
          {{"psi1_0", "number", "", "psi1 at which the two lines cross"}, &S::psi1_0},
          {{"residual", "number", "", "standard deviation of psi2 around the lines"}, &S::residual},
          {{"sticking", "integer", "", "impacts below the break"}, &S::sticking},
          {{"sliding", "integer", "", "impacts above it"}, &S::sliding}};
}

WaltonFit fit_walton(const ImpactTable& table) {
  checked(table);
  const std::size_t n = table.psi1.size();
  for (const auto& [name, list] : {std::pair{"psi2", &table.psi2}, {"e", &table.e}})
    if (list->size() != n)
      throw FieldError(name, fmt::format("must hold as many values as psi1, {}; holds {}", n, list->size()));
  if (n < 4) throw FieldError("psi1", fmt::format("must hold four impacts or more, holds {}", n));
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return table.psi1[a] < table.psi1[b]; });

  WaltonFit best{};
  double least = std::numeric_limits<double>::infinity(), least_xx = 0;
  for (std::size_t stick = 2; stick + 2 <= n; ++stick) {
    // Impacts of one angle stay together.
    if (table.psi1[order[stick]] == table.psi1[order[stick - 1]]) continue;
    double xx = 0, xy = 0, slide = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = table.psi1[order[i]], y = table.psi2[order[i]];
      if (i < stick) {
        xx += x * x;
        xy += x * y;
      } else
        slide += (x - y) / static_cast<double>(n - stick);
    }
    if (xx == 0) continue;
    const double beta0 = -xy / xx;
    double squares = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = table.psi1[order[i]], y = table.psi2[order[i]];
      squares += std::pow(y - std::max(-beta0 * x, x - slide), 2);
    }
    if (squares >= least) continue;
    least = squares;
    least_xx = xx;
    best.beta0 = beta0;
    best.mu = slide;
    best.sticking = static_cast<double>(stick);
    best.sliding = static_cast<double>(n - stick);
  }
  if (!std::isfinite(least))
    throw FieldError(
        "psi1", "must hold impacts of two different angles or more, two impacts at least on either side of the break");

  const double count = static_cast<double>(n), slide = best.mu;
  best.e = std::accumulate(table.e.begin(), table.e.end(), 0.0) / count;
  double scatter = 0;
  for (const double e : table.e) scatter += std::pow(e - best.e, 2);
  best.e_se = std::sqrt(scatter / (count - 1) / count);
  best.residual = std::sqrt(least / (count - 2));
  best.beta0_se = best.residual / std::sqrt(least_xx);
  // mu = s/(beta_x (1 + e)).
  best.mu = slide / (table.beta_x * (1 + best.e));
  best.mu_se = std::hypot(best.residual / std::sqrt(best.sliding) / (table.beta_x * (1 + best.e)),
                          best.mu * best.e_se / (1 + best.e));
  best.psi1_0 = slide / (1 + best.beta0);
  if (!std::isfinite(best.psi1_0)) throw FieldError("psi2", "shows no sticking: beta0 is -1 and there is no break");
  return best;
}

}  // namespace ricochet::theory
