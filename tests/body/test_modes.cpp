// The spectrum of any body: against exact modes, against itself, and whole against parts.

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "body/kept_solids.hpp"
#include "body/modes.hpp"
#include "body/tangent.hpp"
#include "core/error.hpp"
#include "core/turn.hpp"
#include "scenes.hpp"
#include "theory/free_disk.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

/// omega R/c_P of the slowest vibrations of a disk of unit radius in plane stress, each as often as it occurs.
std::vector<double> exact_disk(double nu, std::size_t count) {
  std::vector<double> exact;
  for (const theory::DiskMode& mode : theory::free_disk_modes(nu, 8)) {
    exact.push_back(mode.omega);
    if (mode.n > 0) exact.push_back(mode.omega);
  }
  std::sort(exact.begin(), exact.end());
  exact.resize(count);
  return exact;
}

std::vector<double> frequencies_of(const Solid& solid, double stiffness, int count) {
  std::vector<double> omega;
  for (const Mode& mode : slowest_modes(solid, stiffness, count)) omega.push_back(mode.omega);
  return omega;
}

Body plate_with_hole(double h) {
  Body plate{box(2, 1), element_numbers(0, 1e4, 0.3), {}, {}};
  plate.numbers.h_min = plate.numbers.h_max = h;
  Points hole = circle(0.25, 60);
  for (Vec2& p : hole) p += Vec2(0.3, -0.45);
  std::reverse(hole.begin(), hole.end());
  plate.holes = {hole};
  return plate;
}

Body ellipse(double h) {
  Body body{circle(1, 400), element_numbers(0, 1e4, 0.2), {}, {}};
  for (Vec2& p : body.outline) p.y() *= 0.7;
  body.numbers.h_min = body.numbers.h_max = h;
  return body;
}

}  // namespace

TEST_CASE("modes: nine slowest of a disk of 800 nodes of elements are the exact ones, and pairs stay together") {
  const double nu = 1.0 / 3, c_P = std::sqrt(1e4 / ((1 - nu * nu) * usual_density));
  const auto solid = build_solid(Body{circle(1, 6000), element_numbers(800, 1e4, nu), {}, {}});
  const std::vector<double> exact = exact_disk(nu, 9), found = frequencies_of(*solid, 1e4, 9);
  for (std::size_t k = 0; k < exact.size(); ++k) {
    CAPTURE(k, found[k] / c_P, exact[k]);
    CHECK(std::abs(found[k] / c_P / exact[k] - 1) < 5e-3);
    if (k > 0 && exact[k] == exact[k - 1]) CHECK(found[k] / found[k - 1] - 1 < 1e-3);
  }
}

TEST_CASE("modes: a random lattice splits the pairs of a disk by some per cent, a triangular one by less") {
  const auto splitting = [](const char* placement) {
    double mean = 0;
    for (int seed = 1; seed <= 8; ++seed) {
      const auto solid = build_solid(Body{circle(1, 6000), numbers(800, 1e4, 0, seed, placement), {}, {}});
      const std::vector<double> omega = frequencies_of(*solid, 1e4, 2);
      mean += (omega[1] / omega[0] - 1) / 8;
    }
    return mean;
  };
  const double random = splitting("uniform"), even = splitting("triangular");
  CAPTURE(random, even);
  CHECK(random > 3 * even);
  CHECK(random < 0.15);
  CHECK(even < 5e-3);
}

TEST_CASE("modes: of a mass between two springs, as it is known") {
  Solid corner;
  corner.points = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  corner.free = 1;
  corner.mass = Masses(2);
  Springs springs;
  springs.first = {0, 2};
  springs.list.push_back({0, 1, false, 1.0, 3.0});
  Springs one = springs;
  one.first = {0, 1};
  springs.list.push_back({0, 2, false, 1.0, 7.0});
  corner.interior = springs;
  const std::vector<Mode> modes = slowest_modes(corner, 5, 2);
  CHECK(modes[0].omega == Catch::Detail::Approx(std::sqrt(5 * 3.0 / 2)).epsilon(1e-14));
  CHECK(modes[1].omega == Catch::Detail::Approx(std::sqrt(5 * 7.0 / 2)).epsilon(1e-14));
  CHECK((participation(corner, modes[0]) - Vec2(1, 0)).norm() < 1e-14);
  corner.interior = one;
  CHECK_THROWS_WITH(slowest_modes(corner, 5, 2), Contains("a node hangs loose"));
}

TEST_CASE("modes: shapes are orthonormal by the masses, and each is an eigenvector") {
  Body block{box(2, 1), element_numbers(300, 1e4, 0.2), {}, {}};
  for (const Vec2& p : plan_nodes(block.outline, block.numbers, {}).points) block.anchored.push_back(p.y() < -1 + 1e-9);
  const Body disk{circle(), numbers(260, 1e4, 0.02, 1), {}, {}};
  for (const Body* body : std::initializer_list<const Body*>{&block, &disk}) {
    const auto solid = build_solid(*body);
    const std::vector<Mode> modes = slowest_modes(*solid, 1e4, 12);
    const Eigen::SparseMatrix<double> K = 1e4 * tangent_stiffness(*solid);
    Eigen::VectorXd mass(solid->free_coordinates());
    for (int c = 0; c < mass.size(); ++c) mass[c] = solid->mass[c / 2];
    for (std::size_t a = 0; a < modes.size(); ++a) {
      const double square = modes[a].omega * modes[a].omega;
      const Eigen::VectorXd off = K * modes[a].shape - square * mass.cwiseProduct(modes[a].shape);
      CHECK(off.norm() < 1e-7 * (square * mass.cwiseProduct(modes[a].shape)).norm());
      for (std::size_t b = 0; b <= a; ++b)
        CHECK(std::abs(modes[a].shape.dot(mass.cwiseProduct(modes[b].shape)) - (a == b ? 1 : 0)) < 1e-8);
      if (!solid->anchored()) CHECK(participation(*solid, modes[a]).norm() < 1e-12);
    }
  }
}

TEST_CASE("modes: a part of the spectrum is that of the whole, and all modes together move all of the mass") {
  Body block{box(2, 1), element_numbers(220, 1e4, 0.2), {}, {}};
  for (const Vec2& p : plan_nodes(block.outline, block.numbers, {}).points) block.anchored.push_back(p.y() < -1 + 1e-9);
  const auto solid = build_solid(block);
  REQUIRE(solid->free_coordinates() > 300);
  const std::vector<Mode> whole = slowest_modes(*solid, 1e4, solid->free_coordinates());
  const std::vector<Mode> part = slowest_modes(*solid, 1e4, 20);
  for (std::size_t k = 0; k < part.size(); ++k)
    CHECK(part[k].omega == Catch::Detail::Approx(whole[k].omega).epsilon(1e-9));
  Vec2 all = Vec2::Zero();
  for (const Mode& mode : whole) all += participation(*solid, mode);
  CHECK((all - Vec2(1, 1)).norm() < 1e-9);
  CHECK_THROWS_WITH(slowest_modes(*solid, 1e4, solid->free_coordinates() + 1), Contains("ask for no more"));
  Solid rigid;
  rigid.interior = Rigid{};
  CHECK_THROWS_WITH(slowest_modes(rigid, 1, 1), Contains("no modes"));
}

TEST_CASE("modes: an ellipse and a plate with a hole against a mesh twice as fine") {
  for (const auto& [coarse, fine] :
       {std::pair{ellipse(0.06), ellipse(0.03)}, std::pair{plate_with_hole(0.04), plate_with_hole(0.02)}}) {
    const std::vector<double> one = frequencies_of(*build_solid(coarse), 1e4, 8),
                              other = frequencies_of(*build_solid(fine), 1e4, 8);
    for (std::size_t k = 0; k < one.size(); ++k) {
      CAPTURE(k, one[k], other[k]);
      CHECK(std::abs(one[k] / other[k] - 1) < 0.01);
    }
  }
}

TEST_CASE("modes: what each holds is found in a body that flies, turns and vibrates in several of them") {
  const auto solid = build_solid(Body{circle(), element_numbers(90, 1e4, 0.3), {}, {}});
  const std::vector<Mode> modes = slowest_modes(*solid, 1e4, 10);
  Points place = solid->points, velocity(place.size(), Vec2(0, 0));
  const double a = 1e-5, b = 3e-4;
  const Turn turn(0.8);
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(2 * i);
    const Vec2 at = turn(Vec2(solid->points[i] - solid->centre() + a * modes[3].shape.segment<2>(c)));
    place[i] = at + Vec2(4, -2);
    velocity[i] = turn(Vec2(b * modes[6].shape.segment<2>(c))) + Vec2(0.3, 0.1) + 0.05 * perpendicular(at);
  }
  const std::vector<double> energy = mode_energies(*solid, modes, place, velocity);
  const double first = std::pow(modes[3].omega * a, 2) / 2, second = b * b / 2;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    CAPTURE(k);
    const double known = k == 3 ? first : k == 6 ? second : 0;
    CHECK(std::abs(energy[k] - known) < 1e-4 * std::min(first, second));
  }
}

TEST_CASE("solids kept for later are counted with the shapes of their modes: few modal bodies fill the room of many") {
  const auto lattice = [](int seed) { return Body{circle(1, 400), numbers(400, 1e4, 0, seed), {}, {}}; };
  const std::weak_ptr<const Solid> first_lattice = kept_solid(lattice(1));
  for (int seed = 2; seed <= 14; ++seed) kept_solid(lattice(seed));
  CHECK_FALSE(first_lattice.expired());
  const auto modal = [&](int seed) {
    Body body = lattice(seed);
    body.numbers.modes_of = body.numbers.interior;
    body.numbers.interior = "modes";
    body.numbers.modes = 2 * 400 - 3;
    return body;
  };
  const std::weak_ptr<const Solid> first = kept_solid(modal(1));
  CHECK_FALSE(first.expired());
  for (int seed = 2; seed <= 14; ++seed) kept_solid(modal(seed));  // 0.64 million numbers each, of 7.5
  CHECK(first.expired());
}
