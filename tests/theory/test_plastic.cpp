// Spheres that yield, by fits to finite elements.

#include <catch2/catch.hpp>
#include <cmath>

#include "theory/jackson_green.hpp"
#include "theory/plastic.hpp"
#include "theory/wu_li_thornton.hpp"

using namespace ricochet;
using namespace ricochet::theory;
using Catch::WithinRel;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double R = 1, nu = 0.3, E_star = 1 / (1 - nu * nu), m = 4 * pi / 3;  // E = rho = 1, so speeds are in c0

double yield_speed_of(double Y) { return yield_speed({R, E_star, m, Y}).v; }

}  // namespace

TEST_CASE("Wu, Li & Thornton's e has two exponents, which meet at 0.0079 (E*/Y)^2 yield speeds") {
  const double Y = 0.0011;
  const auto at = [&](double x) { return wu_li_thornton({R, E_star, m, Y, x * yield_speed_of(Y)}); };
  const double window = at(100).window;
  CHECK_THAT(window, WithinRel(0.0079 * std::pow(E_star / Y, 2), 2e-3));
  CHECK_THAT(at(100).over_yield, WithinRel(100.0, 1e-12));
  CHECK_THAT(at(1600).e, WithinRel(at(100).e / 2, 1e-12));
  CHECK_THAT(at(4 * 1.01 * window).e, WithinRel(at(1.01 * window).e / 2, 1e-12));
  CHECK_THAT(at(window * (1 + 1e-9)).e, WithinRel(at(window * (1 - 1e-9)).e, 1e-8));
  CHECK(at(18.72).e <= 1);
  CHECK_THROWS_AS(at(18.71), FieldError);
}

TEST_CASE("Wu, Li & Thornton's e is that of finite elements far above the yield speed") {
  CHECK_THAT(wu_li_thornton({R, E_star, m, 0.0011, 1e-4}).e, WithinRel(0.433, 0.04));
  CHECK_THAT(wu_li_thornton({R, E_star, m, 0.0011, 3e-4}).e, WithinRel(0.323, 0.04));
  CHECK_THAT(wu_li_thornton({R, E_star, m, 0.005, 1e-2}).e, WithinRel(0.254, 0.04));
}

TEST_CASE("Jackson & Green's force is Hertz's where nothing yields, rises, and has no step above half a percent") {
  const double Y = 0.005, onset = 1.9 * std::pow(pi * 1.295 * std::exp(0.736 * nu) * Y / (2 * E_star), 2);
  const auto at = [&](double depth) { return jackson_green_force({R, E_star, nu, Y, depth}); };
  for (const double depth : {0.01 * onset, 0.99 * onset}) {
    CHECK_THAT(at(depth).F, WithinRel(4.0 / 3 * E_star * std::pow(depth, 1.5), 1e-12));
    CHECK_THAT(at(depth).a, WithinRel(std::sqrt(depth), 1e-12));
    CHECK(at(depth).residual == 0);
  }
  CHECK_THAT(at(onset * (1 + 1e-9)).F, WithinRel(at(onset * (1 - 1e-9)).F, 6e-3));
  double before = 0, dent = 0;
  for (double depth = onset; depth < 0.4; depth *= 1.1) {
    const PlasticPress now = at(depth);
    CHECK(now.F > before);
    CHECK(now.residual > dent);
    CHECK(now.residual < depth);
    before = now.F;
    dent = now.residual;
  }
  CHECK_THROWS_AS(at(0.51), FieldError);
}

TEST_CASE("Jackson & Green's sphere is pressed in until the force has done the work of its energy") {
  for (const double v : {1e-6, 1e-4, 1e-2}) {
    const PressedRebound impact = jackson_green({R, E_star, nu, m, 0.005, v});
    double work = 0;
    constexpr int parts = 20000;
    for (int k = 0; k < parts; ++k)
      work += jackson_green_force({R, E_star, nu, 0.005, impact.depth * (k + 0.5) / parts}).F * impact.depth / parts;
    CHECK_THAT(work, WithinRel(0.5 * m * v * v, 2e-4));
  }
  CHECK_THAT(jackson_green({R, E_star, nu, m, 0.005, 1e-6}).e, WithinRel(1.0, 1e-9));
  CHECK_THROWS_AS(jackson_green({R, E_star, nu, m, 0.005, 1.0}), FieldError);
}

TEST_CASE("Jackson & Green's impacts have the force, depth and e of another program of the same formulas") {
  struct Row {
    double Y, v, F, depth, e;
  };
  for (const Row& row : {Row{0.005, 1e-4, 4.51e-5, 1.100e-3, 0.798}, Row{0.005, 3e-4, 1.549e-4, 2.812e-3, 0.658},
                         Row{0.005, 1e-3, 5.74e-4, 8.12e-3, 0.499}}) {
    const PressedRebound impact = jackson_green({R, E_star, nu, m, row.Y, row.v});
    CHECK_THAT(impact.F, WithinRel(row.F, 2e-3));
    CHECK_THAT(impact.depth, WithinRel(row.depth, 1e-3));
    CHECK_THAT(impact.e, WithinRel(row.e, 2e-3));
    CHECK(impact.residual < impact.depth);
  }
}
