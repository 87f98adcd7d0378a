// Bodies of revolution by themselves: rings of elements about the axis x = 0.

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "body/elements/stiffness.hpp"
#include "body/interior.hpp"
#include "body/rigid_motion.hpp"
#include "core/error.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

std::size_t slot(int i) { return static_cast<std::size_t>(i); }

BodyNumbers ring_numbers(int nodes, double E, double nu, const std::string& law = "polynomial") {
  BodyNumbers numbers = element_numbers(nodes, E, nu, law);
  numbers.state = "axisymmetric";
  return numbers;
}

/// The half section of a cylinder that stands on y = -height.
Points half_box(double radius, double height) { return {{0, -height}, {radius, -height}, {radius, 0}, {0, 0}}; }

std::shared_ptr<const Solid> solid_of(const Points& outline, const BodyNumbers& numbers) {
  return build_solid(Body{outline, numbers, {}, {}});
}

bool on_axis(const Solid& solid, int i) { return solid.points[slot(i)].x() == 0; }

/// At rest, every free coordinate but those of the axis moved by at most `by`, and as fast.
template <int W>
Motion<W> shaken(const Solid& solid, double E, double by, int seed) {
  Motion<W> body = at_rest<W>(solid);
  body.stiffness = E;
  for (int lane = 0; lane < W; ++lane) {
    std::mt19937 random(static_cast<unsigned>(seed + lane));
    std::uniform_real_distribution<double> shift(-by, by);
    for (int c = 0; c < solid.free_coordinates(); ++c) {
      const double moved = shift(random), fast = shift(random);
      if (c % 2 == 0 && on_axis(solid, c / 2)) continue;
      body.q[c][lane] += moved;
      body.v[c][lane] = fast;
    }
  }
  return body;
}

template <int W>
void leap(Motion<W>& body, double step, int count) {
  const Lane<W> h = Lane<W>::Constant(step);
  for (int k = 0; k < count; ++k) kick_and_drift(body, h, h);
}

/// M^-1/2 K M^-1/2 over the free coordinates, those across the axis left 0.
Eigen::VectorXd squared_frequencies(const Motion<1>& body) {
  const Solid& solid = *body.solid;
  const int n = solid.free_coordinates();
  Eigen::MatrixXd K(n, n);
  for (int c = 0; c < n; ++c) {
    Coordinates<1> unit;
    unit.resize(solid.coordinates());
    unit[c] = 1.0;
    const Coordinates<1> column = stiffness_times(body, unit);
    for (int row = 0; row < n; ++row) {
      const bool held = row % 2 == 0 && on_axis(solid, row / 2);
      K(row, c) = held ? 0 : column[row][0] / std::sqrt(solid.mass[row / 2] * solid.mass[c / 2]);
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace

TEST_CASE("a sphere is the half of its section: its rings weigh what it does, and its surface ends on the axis") {
  const auto solid = solid_of(half_circle(), ring_numbers(600, 1e4, 0.3));
  const double volume = 4 * std::numbers::pi / 3;
  CHECK(solid->axisymmetric);
  CHECK(solid->total_mass() == Catch::Detail::Approx(volume * usual_density).epsilon(0.005));
  double sum = 0;
  for (const double weight : solid->elements()->weight) sum += weight;
  CHECK(solid->total_mass() == Catch::Detail::Approx(sum * usual_density).epsilon(1e-12));
  CHECK(solid->centre().x() == 0);
  CHECK(std::abs(solid->centre().y()) < 1e-3);
  CHECK(solid->inertia() == Catch::Detail::Approx(0.4 * solid->total_mass()).epsilon(0.01));
  const auto& surface = std::get<Mesh<2>>(solid->surface);
  const std::vector<Chain> chains = chains_of(surface.cell);
  REQUIRE(chains.size() == 1);
  CHECK_FALSE(chains.front().closed);
  CHECK(solid->points[slot(surface.node.front())] == Vec2(0, -1));
  CHECK(solid->points[slot(surface.node.back())] == Vec2(0, 1));
  double area = 0;
  for (const double weight : surface.weight) area += weight;
  CHECK(area == Catch::Detail::Approx(4 * std::numbers::pi).epsilon(0.002));
}

TEST_CASE("a hollow ring that does not reach the axis keeps its closed surface") {
  const Points outline{{2, -0.5}, {3, -0.5}, {3, 0.5}, {2, 0.5}};
  const auto solid = solid_of(outline, ring_numbers(200, 1e4, 0.3));
  CHECK(chains_of(std::get<Mesh<2>>(solid->surface).cell).front().closed);
  CHECK(solid->total_mass() == Catch::Detail::Approx(2 * std::numbers::pi * 2.5 * usual_density).epsilon(1e-12));
}

TEST_CASE("forces of rings are the slope of their energy, and K w the slope of their forces") {
  Body body{half_box(1, 1.5), ring_numbers(60, 1e4, 0.3), {}, {}};
  for (const Vec2& p : plan_nodes(body.outline, body.numbers, {}).points) body.anchored.push_back(p.y() < -1.5 + 1e-9);
  for (const std::string& law : solid_law_names()) {
    CAPTURE(law);
    body.numbers.law = law;
    const auto solid = build_solid(body);
    const Motion<1> motion = shaken<1>(*solid, 50, 0.05, 1);
    const Coordinates<1> force = interior_forces(motion), bent = stiffness_times(motion, motion.v);
    const double h = 1e-5;
    Motion<1> ahead = motion, behind = motion;
    for (int c = 0; c < solid->free_coordinates(); ++c) {
      ahead.q[c] += h * motion.v[c];
      behind.q[c] -= h * motion.v[c];
    }
    double work = 0, most = 0;
    for (int c = 0; c < solid->free_coordinates(); ++c) {
      work += force[c][0] * motion.v[c][0];
      most = std::max(most, std::abs(bent[c][0]));
    }
    const double slope = (interior_energy(ahead)[0] - interior_energy(behind)[0]) / (2 * h);
    CHECK(-work == Catch::Detail::Approx(slope).epsilon(1e-8));
    const Coordinates<1> before = interior_forces(behind), after = interior_forces(ahead);
    for (int c = 0; c < solid->free_coordinates(); ++c) {
      if (c % 2 == 0 && on_axis(*solid, c / 2)) continue;
      CHECK(std::abs(-(after[c][0] - before[c][0]) / (2 * h) - bent[c][0]) < 1e-8 * most);
    }
  }
}

TEST_CASE("the assembled stiffness of rings is that of their products, and holds nodes on the axis") {
  const auto solid = solid_of(half_box(1, 1), ring_numbers(40, 1e4, 0.3));
  const Motion<1> body = shaken<1>(*solid, 50, 0.02, 2);
  AssembledStiffness<1> K;
  K.assemble(body, *solid->elements());
  Coordinates<1> sum;
  sum.resize(solid->coordinates());
  const auto times = [&](int i, int j, const NodeStiffness<1>& k) {
    sum[2 * i] += k.xx * body.v[2 * j] + k.xy * body.v[2 * j + 1];
    sum[2 * i + 1] += k.yx * body.v[2 * j] + k.yy * body.v[2 * j + 1];
  };
  for (int i = 0; i < solid->nodes(); ++i) times(i, i, K.diagonal[slot(i)]);
  for (std::size_t s = 0; s < solid->elements()->edge.size(); ++s) {
    const auto& [i, j] = solid->elements()->edge[s];
    const NodeStiffness<1>& k = K.off_diagonal[s];
    times(i, j, k);
    times(j, i, NodeStiffness<1>(k.xx, k.yx, k.xy, k.yy));
  }
  const Coordinates<1> wanted = stiffness_times(body, body.v);
  for (int c = 0; c < solid->coordinates(); ++c) {
    const bool held = c % 2 == 0 && on_axis(*solid, c / 2);
    CHECK(std::abs(sum[c][0] - (held ? 0 : wanted[c][0])) < 1e-12 * 50);
  }
}

TEST_CASE("a cylinder that is strained evenly pulls at its surface alone, by its stress times the rings' areas",
          "[patch]") {
  // Patch test: no node inside feels a force, whatever the triangles; those of the surface share what P N dA is.
  const double across = 0.02, along = -0.03, E = 50, nu = 0.3;
  for (const std::string& law : solid_law_names()) {
    CAPTURE(law);
    const auto solid = solid_of(half_box(1, 2), ring_numbers(200, E, nu, law));
    Motion<1> body = at_rest<1>(*solid);
    body.stiffness = E;
    for (int i = 0; i < solid->nodes(); ++i) {
      body.q[2 * i] *= 1 + across;
      body.q[2 * i + 1] *= 1 + along;
    }
    const Lame lame = lame_of(nu, "axisymmetric");
    const AxialTensor<double> F({1 + across, 0, 0, 1 + along}, 1 + across);
    AxialTensor<double> P;
    double energy = 0;
    with_solid_law(solid_law(law, lame), E, [&](const auto& of) {
      P = of.stress(F);
      energy = of.energy(F);
    });
    CHECK(P.zz == Catch::Detail::Approx(P.plane.xx).epsilon(1e-14));
    CHECK(interior_energy(body)[0] == Catch::Detail::Approx(energy * 2 * std::numbers::pi).epsilon(1e-12));
    std::vector<Vec2> wanted(slot(solid->nodes()), Vec2::Zero());
    const auto& surface = std::get<Mesh<2>>(solid->surface);
    for (const auto& [a, b] : surface.cell) {
      const int first = surface.node[slot(a)], second = surface.node[slot(b)];
      const Vec2 p = solid->points[slot(first)], q = solid->points[slot(second)];
      const Vec2 outwards = -perpendicular(q - p);  // times the cell's length
      const Vec2 load(P.plane.xx * outwards.x(), P.plane.yy * outwards.y());
      wanted[slot(first)] -= 2 * std::numbers::pi / 6 * (2 * p.x() + q.x()) * load;
      wanted[slot(second)] -= 2 * std::numbers::pi / 6 * (p.x() + 2 * q.x()) * load;
    }
    const Coordinates<1> force = interior_forces(body);
    for (int i = 0; i < solid->nodes(); ++i) {
      CHECK(std::abs(force[2 * i][0] - (on_axis(*solid, i) ? 0 : wanted[slot(i)].x())) < 1e-13 * E);
      CHECK(std::abs(force[2 * i + 1][0] - wanted[slot(i)].y()) < 1e-13 * E);
    }
  }
}

TEST_CASE("a sphere of rings breathes at the frequency of the continuum") {
  // tan k = k/(1 - (c_P/c_S)^2 k^2/4), k = omega R/c_P. [Love, Mathematical Theory of Elasticity, 1927, section 196]
  const double nu = 0.3, ratio = 2 * (1 - nu) / (1 - 2 * nu);
  double low = 2, high = 3;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (std::sin(middle) * (1 - ratio * middle * middle / 4) - middle * std::cos(middle) < 0 ? low : high) = middle;
  }
  const auto solid = solid_of(half_circle(), ring_numbers(300, 1, nu));
  Motion<1> body = at_rest<1>(*solid);
  body.stiffness = 1;
  const Lame lame = lame_of(nu, "axisymmetric");
  const double c = std::sqrt((lame.lambda + 2 * lame.mu) / usual_density);
  const Eigen::VectorXd omega2 = squared_frequencies(body);
  double nearest = 1e9;
  for (int k = 0; k < omega2.size(); ++k)
    if (const double omega = std::sqrt(std::max(0.0, omega2[k])) / c; std::abs(omega - low) < std::abs(nearest - low))
      nearest = omega;
  CHECK(nearest == Catch::Detail::Approx(low).epsilon(0.01));
}

TEST_CASE("the frequency bound of rings lies above the highest frequency, at rest and deformed, by 1.5 at most") {
  for (const double nu : {0.1, 0.3, 0.47}) {
    const auto solid = solid_of(half_circle(), ring_numbers(120, 40, nu));
    for (const double by : {0.0, 0.01}) {
      CAPTURE(nu, by);
      const Motion<1> body = shaken<1>(*solid, 40, by, 3);
      const double exact = std::sqrt(squared_frequencies(body).maxCoeff());
      const double bound = std::sqrt(squared_frequency_bound(body).omega2[0]);
      CHECK(bound >= exact);
      CHECK(bound <= 1.5 * exact);
      if (by == 0) CHECK(frequency_bound(*solid, 40).omega == Catch::Detail::Approx(bound).epsilon(1e-14));
    }
  }
}

TEST_CASE("a free sphere of rings keeps its momentum, and its axis stays where it is") {
  const auto solid = solid_of(half_circle(), ring_numbers(150, 1e4, 0.3));
  Motion<2> body = shaken<2>(*solid, 1e4, 0.003, 1);
  for (int i = 0; i < solid->nodes(); ++i) body.v[2 * i + 1] -= 0.2;
  const RigidMotion<2> before = rigid_motion(body);
  const Lane<2> energy = before.translation + vibration_energy(body, before);
  leap(body, 0.3 / frequency_bound(*solid, 1e4).omega, sanitized ? 1000 : 20000);
  const RigidMotion<2> after = rigid_motion(body);
  for (int lane = 0; lane < 2; ++lane) {
    CHECK(after.velocity.at[1][lane] == Catch::Detail::Approx(before.velocity.at[1][lane]).epsilon(1e-12));
    CHECK((after.translation + vibration_energy(body, after))[lane] ==
          Catch::Detail::Approx(energy[lane]).epsilon(0.02));
  }
  for (int i = 0; i < solid->nodes(); ++i)
    if (on_axis(*solid, i)) CHECK(((body.q[2 * i] == 0).all() && (body.v[2 * i] == 0).all()));
}

TEST_CASE("a body of rings moves by the same bits alone and beside others") {
  for (const std::string& law : solid_law_names()) {
    CAPTURE(law);
    const auto solid = solid_of(half_circle(), ring_numbers(100, 1e4, 0.3, law));
    Motion<4> four = shaken<4>(*solid, 1e4, 0.01, 1);
    leap(four, 5e-4, 100);
    for (int lane = 0; lane < 4; ++lane) {
      Motion<1> alone = shaken<1>(*solid, 1e4, 0.01, 1 + lane);
      leap(alone, 5e-4, 100);
      int same = 0;
      for (int c = 0; c < solid->coordinates(); ++c)
        same += alone.q[c][0] == four.q[c][lane] && alone.v[c][0] == four.v[c][lane];
      CHECK(same == solid->coordinates());
      CHECK(interior_energy(alone)[0] == interior_energy(four)[lane]);
      CHECK(squared_frequency_bound(alone).omega2[0] == squared_frequency_bound(four).omega2[lane]);
    }
  }
}

TEST_CASE("a half section that is none is refused by name") {
  const auto refusal = [](const Points& outline, const BodyNumbers& numbers) -> std::string {
    try {
      solid_of(outline, numbers);
    } catch (const FieldError& error) {
      return error.field + " " + error.what();
    }
    return "nothing was refused";
  };
  using Catch::Matchers::Contains;
  BodyNumbers numbers = ring_numbers(100, 1e4, 0.3);
  CHECK_THAT(refusal(circle(), numbers), Contains("outline of an axisymmetric body is the half of its section"));
  numbers.roughness = 0.01;
  CHECK_THAT(refusal(half_circle(), numbers), Contains("roughness of an axisymmetric body would be rings"));
  numbers = ring_numbers(100, 1e4, 0.3);
  numbers.angle = 90;
  CHECK_THAT(refusal(half_circle(), numbers), Contains("angle would turn an axisymmetric body off its axis"));
  numbers = ring_numbers(100, 1e4, 0.3);
  numbers.interior = "springs";
  CHECK_THAT(refusal(half_circle(), numbers), Contains("state axisymmetric is of elements"));
}
