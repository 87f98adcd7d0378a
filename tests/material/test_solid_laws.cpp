// Properties of every law of solids, over decades of strain, folds and rotations.

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "material/solid_law.hpp"

using namespace ricochet;

namespace {

using F2 = Tensor<double>;

constexpr double F2::*components[] = {&F2::xx, &F2::xy, &F2::yx, &F2::yy};

// The slope along a component, by five points.
template <class Function>
double slope(Function&& f, const F2& F, double F2::*along) {
  const double h = 1e-3;
  const auto at = [&](double by) {
    F2 moved = F;
    moved.*along += by * h;
    return f(moved);
  };
  return (at(-2) - 8 * at(-1) + 8 * at(1) - at(2)) / (12 * h);
}

double determinant(const F2& F) { return F.xx * F.yy - F.xy * F.yx; }
double size(const F2& F) { return std::sqrt(F.xx * F.xx + F.xy * F.xy + F.yx * F.yx + F.yy * F.yy); }

F2 rotation(double angle) { return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)}; }

template <class Check>
void with_every_law(const Lame& lame, Check&& check) {
  for (const std::string& name : solid_law_names()) {
    CAPTURE(name);
    with_solid_law(solid_law(name, lame), 1.7, check);
  }
}

}  // namespace

TEST_CASE("stress is the slope of the energy and the tangent that of the stress, turned over or not") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  int turned_over = 0;
  for (int k = 0; k < 200; ++k) {
    const F2 F(number(random), number(random), number(random), number(random)),
        dF(number(random), number(random), number(random), number(random));
    turned_over += determinant(F) < 0;
    with_every_law(lame_of(0.3, k % 2 ? "plane_strain" : "plane_stress"), [&](const auto& law) {
      const F2 P = law.stress(F), dP = law.tangent(F, dF);
      for (auto component : components) {
        CHECK(P.*component == Catch::Detail::Approx(slope([&](const F2& G) { return law.energy(G); }, F, component))
                                  .epsilon(1e-7)
                                  .margin(1e-7));
        double change = 0;
        for (auto along : components)
          change += dF.*along * slope([&](const F2& G) { return law.stress(G).*component; }, F, along);
        CHECK(dP.*component == Catch::Detail::Approx(change).epsilon(1e-7).margin(1e-7));
      }
    });
  }
  CHECK(turned_over > 50);
}

TEST_CASE("in a body of revolution stress is the slope of the energy too, and the tangent that of the stress") {
  using F3 = AxialTensor<double>;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  const double h = 1e-3;
  const auto five_points = [&](auto&& f) { return (f(-2) - 8 * f(-1) + 8 * f(1) - f(2)) / (12 * h); };
  const auto along = [&](const F3& F, const F3& dF, double by) {
    return F3({F.plane.xx + by * h * dF.plane.xx, F.plane.xy + by * h * dF.plane.xy, F.plane.yx + by * h * dF.plane.yx,
               F.plane.yy + by * h * dF.plane.yy},
              F.zz + by * h * dF.zz);
  };
  const auto contract = [](const F3& a, const F3& b) {
    return a.plane.xx * b.plane.xx + a.plane.xy * b.plane.xy + a.plane.yx * b.plane.yx + a.plane.yy * b.plane.yy +
           a.zz * b.zz;
  };
  const auto any = [&] { return F3({number(random), number(random), number(random), number(random)}, number(random)); };
  for (int k = 0; k < 200; ++k) {
    const F3 F = any(), dF = any(), other = any();
    with_every_law(lame_of(0.3, "axisymmetric"), [&](const auto& law) {
      const double work = five_points([&](double by) { return law.energy(along(F, dF, by)); });
      CHECK(contract(law.stress(F), dF) == Catch::Detail::Approx(work).epsilon(1e-7).margin(1e-7));
      const double change = five_points([&](double by) { return contract(law.stress(along(F, dF, by)), other); });
      CHECK(contract(law.tangent(F, dF), other) == Catch::Detail::Approx(change).epsilon(1e-7).margin(1e-7));
      // A ring that keeps its length is a slice of a long cylinder.
      const F3 slice(F.plane, 1.0);
      CHECK(law.energy(slice) == Catch::Detail::Approx(law.energy(F.plane)).epsilon(1e-12));
      CHECK(law.stress(slice).plane.xy == Catch::Detail::Approx(law.stress(F.plane).xy).epsilon(1e-12).margin(1e-12));
    });
  }
}

TEST_CASE("a bar of revolution that is drawn has Young's modulus, and contracts by Poisson's ratio") {
  const double E = 1.7, nu = 0.3, strain = 1e-7, across = 1 - nu * strain;
  with_every_law(lame_of(nu, "axisymmetric"), [&](const auto& law) {
    const AxialTensor<double> P = law.stress({{across, 0, 0, 1 + strain}, across});
    CHECK(P.plane.yy == Catch::Detail::Approx(E * strain).epsilon(1e-6));
    CHECK(std::abs(P.plane.xx) < 1e-6 * E * strain);
    CHECK(std::abs(P.zz) < 1e-6 * E * strain);
  });
}

TEST_CASE("a rigid rotation leaves no stress, but by the law of small strains") {
  for (const double angle : {1e-3, 0.4, 2.0, 3.1}) {
    with_every_law(lame_of(0.3, "plane_stress"), [&]<class Law>(const Law& law) {
      const double stress = size(law.stress(rotation(angle)));
      if (std::is_same_v<Law, SmallStrain<double>>)
        CHECK(stress > 0.4 * angle * angle);
      else
        CHECK(stress < 1e-12);
    });
  }
  CHECK(turns_freely(solid_law("polynomial", {})));
  CHECK(turns_freely(solid_law("st_venant_kirchhoff", {})));
  CHECK_FALSE(turns_freely(solid_law("linear", {})));
}

TEST_CASE("at small strains every law is Hooke's, of the modulus and the contraction that were asked for") {
  const double E = 1.7, nu = 0.3, strain = 1e-7;
  with_every_law(lame_of(nu, "plane_stress"), [&](const auto& law) {
    const F2 P = law.stress({1 + strain, 0, 0, 1 - nu * strain});
    CHECK(P.xx == Catch::Detail::Approx(E * strain).epsilon(1e-6));
    CHECK(std::abs(P.yy) < 1e-6 * E * strain);
  });
  // A long cylinder does not contract along its axis, so more across: nu/(1 - nu).
  with_every_law(lame_of(nu, "plane_strain"), [&](const auto& law) {
    const F2 P = law.stress({1 + strain, 0, 0, 1 - nu / (1 - nu) * strain});
    CHECK(P.xx == Catch::Detail::Approx(E / (1 - nu * nu) * strain).epsilon(1e-6));
    CHECK(std::abs(P.yy) < 1e-6 * E * strain);
  });
}

TEST_CASE("the polynomial law is linear in uniaxial strain and finite where a triangle has no area") {
  const Lame lame = lame_of(0.3, "plane_strain");
  const Polynomial<double> law{lame.lambda, lame.mu};
  for (const double strain : {-1.5, -1.0, -0.5, 0.2, 3.0})
    CHECK(law.stress({1 + strain, 0, 0, 1}).xx == Catch::Detail::Approx((lame.lambda + 2 * lame.mu) * strain));
  CHECK(std::isfinite(law.energy({0, 0, 0, 0})));
}

TEST_CASE("the pulls that the polynomial law finds by the edges alone are those of its stress") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  const Polynomial<double> law{0.7, 0.4};
  for (int k = 0; k < 100; ++k) {
    const F2 D(number(random), number(random), number(random), number(random)),
        D0(1 + 0.5 * number(random), 0.3 * number(random), 0.3 * number(random), 1 + 0.4 * number(random));
    const double area = determinant(D0), weight = 1.3 * std::abs(area) / 2;
    const F2 inverse(D0.yy / area, -D0.xy / area, -D0.yx / area, D0.xx / area);
    const F2 P = law.stress({D.xx * inverse.xx + D.xy * inverse.yx, D.xx * inverse.xy + D.xy * inverse.yy,
                             D.yx * inverse.xx + D.yy * inverse.yx, D.yx * inverse.xy + D.yy * inverse.yy});
    const auto of = [&](double a, double b, double c, double d) { return weight * (a * b + c * d); };
    const EdgeMetric metric{of(inverse.xx, inverse.xx, inverse.xy, inverse.xy),
                            of(inverse.xx, inverse.yx, inverse.xy, inverse.yy),
                            of(inverse.yx, inverse.yx, inverse.yy, inverse.yy), 1 / area, weight / area};
    const F2 H = law.edge_pulls(D, metric);
    const double margin = 1e-11 * weight * size(P) * size(inverse);
    CHECK(std::abs(H.xx - of(P.xx, inverse.xx, P.xy, inverse.xy)) < margin);
    CHECK(std::abs(H.xy - of(P.xx, inverse.yx, P.xy, inverse.yy)) < margin);
    CHECK(std::abs(H.yx - of(P.yx, inverse.xx, P.yy, inverse.xy)) < margin);
    CHECK(std::abs(H.yy - of(P.yx, inverse.yx, P.yy, inverse.yy)) < margin);
  }
}

TEST_CASE("a solid law's numbers choose it, and read back as they were written") {
  const SolidLawNumbers given = solid_law("st_venant_kirchhoff", {0.25, 0.5}), read = solid_law_of(numbers_of(given));
  CHECK(read.law == given.law);
  CHECK(read.lame.lambda == 0.25);
  CHECK(read.lame.mu == 0.5);
  const F2 F(1.1, 0.2, -0.1, 0.9);
  const double energy = with_solid_law(read, 2.0, [&](const auto& law) { return law.energy(F); });
  CHECK(energy == StVenantKirchhoff<double>{0.5, 1.0}.energy(F));
}
