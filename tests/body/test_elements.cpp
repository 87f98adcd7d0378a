// Bodies of elements by themselves: what they hold, how fast they vibrate, and that they move as lanes and alone.

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "body/elasticity.hpp"
#include "body/elements/build.hpp"
#include "body/interior.hpp"
#include "body/rigid_motion.hpp"
#include "core/error.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

std::size_t slot(int i) { return static_cast<std::size_t>(i); }

std::shared_ptr<const Solid> solid_of(const Points& outline, const BodyNumbers& numbers) {
  return build_solid(Body{outline, numbers, {}, {}});
}

/// The motion of one lane, its nodes shaken by at most `by`.
template <int W>
Motion<W> shaken(const Solid& solid, double E, double by, int seed) {
  Motion<W> body = at_rest<W>(solid);
  body.stiffness = E;
  for (int lane = 0; lane < W; ++lane) {
    std::mt19937 random(static_cast<unsigned>(seed + lane));
    std::uniform_real_distribution<double> shift(-by, by);
    for (int c = 0; c < solid.free_coordinates(); ++c) body.q[c][lane] += shift(random);
    for (int c = 0; c < solid.free_coordinates(); ++c) body.v[c][lane] = shift(random);
  }
  return body;
}

/// Leapfrog steps of a body alone.
template <int W>
void leap(Motion<W>& body, double step, int count) {
  const Lane<W> h = Lane<W>::Constant(step);
  for (int k = 0; k < count; ++k) kick_and_drift(body, h, h);
}

double inner(const Coordinates<1>& a, const Coordinates<1>& b) {
  double sum = 0;
  for (int c = 0; c < a.size(); ++c) sum += a[c][0] * b[c][0];
  return sum;
}

/// u.Ku / u.Mu of displacements u(X) from rest: the square of the frequency if u is a mode.
template <class Field>
double rayleigh_quotient(const Solid& solid, double E, Field&& u) {
  Motion<1> body = at_rest<1>(solid);
  body.stiffness = E;
  Coordinates<1> w, momentum;
  w.resize(solid.coordinates());
  momentum.resize(solid.coordinates());
  for (int i = 0; i < solid.nodes(); ++i) {
    const Vec2 at = u(solid.points[slot(i)]);
    w.set(i, 0, at);
    momentum.set(i, 0, solid.mass[i] * at);
  }
  return inner(w, stiffness_times(body, w)) / inner(w, momentum);
}

Eigen::MatrixXd stiffness_matrix(const Motion<1>& body) {
  const int n = body.solid->free_coordinates();
  Eigen::MatrixXd K(n, n);
  for (int c = 0; c < n; ++c) {
    Coordinates<1> unit;
    unit.resize(body.solid->coordinates());
    unit[c] = 1.0;
    const Coordinates<1> column = stiffness_times(body, unit);
    for (int row = 0; row < n; ++row) K(row, c) = column[row][0];
  }
  return K;
}

/// By rising frequency squared; the rigid motions of a free body come first.
Eigen::VectorXd squared_frequencies(const Motion<1>& body) {
  Eigen::MatrixXd K = stiffness_matrix(body);
  for (int row = 0; row < K.rows(); ++row)
    for (int column = 0; column < K.cols(); ++column)
      K(row, column) /= std::sqrt(body.solid->mass[row / 2] * body.solid->mass[column / 2]);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace

TEST_CASE("an element is held by its lowest node, and all elements fill the body") {
  for (const char* placement : {"poisson_disk", "triangular"}) {
    const auto solid = solid_of(circle(), element_numbers(300, 1e4, 0.3, "polynomial", placement));
    const Elements& elements = *solid->elements();
    CHECK(elements.size() == static_cast<int>(solid->cells.size()));
    double area = 0;
    for (int i = 0; i < solid->nodes(); ++i)
      for (int e = elements.first[slot(i)]; e < elements.first[slot(i) + 1]; ++e) {
        const auto& [a, b, c] = elements.nodes[slot(e)];
        CHECK((a == i && a < b && b < c));
        area += elements.weight[slot(e)];
      }
    CHECK(solid->total_mass() == Catch::Detail::Approx(area * usual_density).epsilon(1e-12));
    // Euler: nodes - edges + triangles = 1.
    CHECK(solid->nodes() - static_cast<int>(elements.edge.size()) + elements.size() == 1);
  }
}

TEST_CASE("forces of elements are the slope of their energy, and K w the slope of their forces") {
  Body body{box(2, 1), element_numbers(60, 1e4, 0.3), {}, {}};
  for (const Vec2& p : plan_nodes(body.outline, body.numbers, {}).points) body.anchored.push_back(p.y() < -1 + 1e-9);
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
    double work = 0;
    for (int c = 0; c < solid->free_coordinates(); ++c) work += force[c][0] * motion.v[c][0];
    const double slope = (interior_energy(ahead)[0] - interior_energy(behind)[0]) / (2 * h);
    CHECK(-work == Catch::Detail::Approx(slope).epsilon(1e-8));
    const Coordinates<1> before = interior_forces(behind), after = interior_forces(ahead);
    double most = 0;
    for (int c = 0; c < solid->free_coordinates(); ++c) most = std::max(most, std::abs(bent[c][0]));
    for (int c = 0; c < solid->free_coordinates(); ++c)
      CHECK(std::abs(-(after[c][0] - before[c][0]) / (2 * h) - bent[c][0]) < 1e-8 * most);
  }
}

TEST_CASE("a band of elements returns the modulus and the contraction that it was given", "[patch]") {
  for (const char* placement : {"poisson_disk", "uniform", "triangular"})
    for (const double nu : {-0.3, 0.0, 0.3, 0.45}) {
      BodyNumbers numbers = element_numbers(300, 50, nu, "polynomial", placement);
      const auto sheet = stretch_band(*solid_of(box(1, 4), numbers), 50);
      CHECK(sheet.young_modulus == Catch::Detail::Approx(50).epsilon(1e-10));
      CHECK(sheet.poisson_ratio == Catch::Detail::Approx(nu).epsilon(1e-10).margin(1e-10));
      numbers.state = "plane_strain";
      const auto cylinder = stretch_band(*solid_of(box(1, 4), numbers), 50);
      CHECK(cylinder.young_modulus == Catch::Detail::Approx(50 / (1 - nu * nu)).epsilon(1e-10));
      CHECK(cylinder.poisson_ratio == Catch::Detail::Approx(nu / (1 - nu)).epsilon(1e-10).margin(1e-10));
    }
}

TEST_CASE("a modulus by place is that of the mean of a triangle's corners") {
  Body body{box(1, 4), element_numbers(300, 1, 0.3), {}, {}};
  for (const Vec2& p : plan_nodes(body.outline, body.numbers, {}).points)
    body.node_stiffness.push_back(50 + 10 * p.x());
  const auto solid = build_solid(body);
  Motion<1> stretched = at_rest<1>(*solid);
  stretched.stiffness = 1;
  for (int i = 0; i < solid->nodes(); ++i) stretched.q[2 * i + 1] *= 1.001;
  // The mean over a triangle of a linear function is that over its corners; E/(1 - nu^2) (0.001)^2/2 a unit of area.
  CHECK(interior_energy(stretched)[0] == Catch::Detail::Approx(50 * 4 / (1 - 0.09) * 0.5e-6).epsilon(1e-6));
}

TEST_CASE("pressure and shear waves of elements have the speeds of their moduli") {
  // Energy over mass of a plane wave that fills half a wave's length: k^2 c^2, whatever the sides do.
  const double E = 40, nu = 0.3, length = 2, k = std::numbers::pi / length;
  for (const char* state : {"plane_stress", "plane_strain"}) {
    BodyNumbers numbers = element_numbers(1200, E, nu);
    numbers.state = state;
    const auto solid = solid_of(box(length, 1), numbers);
    const Lame lame = lame_of(nu, state);
    const double pressure = E * (lame.lambda + 2 * lame.mu) / usual_density, shear = E * lame.mu / usual_density;
    const auto wave = [&](const Vec2& p) { return std::cos(k * (p.x() + length / 2)); };
    const double along = rayleigh_quotient(*solid, E, [&](const Vec2& p) { return Vec2(wave(p), 0); });
    const double across = rayleigh_quotient(*solid, E, [&](const Vec2& p) { return Vec2(0, wave(p)); });
    CHECK(std::sqrt(along / (k * k)) == Catch::Detail::Approx(std::sqrt(pressure)).epsilon(0.005));
    CHECK(std::sqrt(across / (k * k)) == Catch::Detail::Approx(std::sqrt(shear)).epsilon(0.005));
  }
}

TEST_CASE("a free disk of elements vibrates at the frequencies of the continuum") {
  // omega R/c_P of the exact modes at nu = 0.3: n = 2, n = 1, n = 0, n = 3; pairs but for n = 0. [theory/disk_modes]
  const double nu = 0.3;
  const auto solid = solid_of(circle(), element_numbers(300, 1, nu, "polynomial", "triangular"));
  Motion<1> body = at_rest<1>(*solid);
  body.stiffness = 1;
  const Eigen::VectorXd omega2 = squared_frequencies(body);
  const double c = std::sqrt(1 / ((1 - nu * nu) * usual_density));
  for (int rigid = 0; rigid < 3; ++rigid) CHECK(std::abs(omega2[rigid]) < 1e-10 * omega2[3]);
  const double exact[] = {1.387653, 1.387653, 1.617558, 1.617558, 2.048850, 2.130399, 2.130399};
  for (int mode = 0; mode < 7; ++mode)
    CHECK(std::sqrt(omega2[3 + mode]) / c == Catch::Detail::Approx(exact[mode]).epsilon(0.01));
}

TEST_CASE("a cantilever of elements bends by P L^3/3 E I + 6 P L/5 G A") {
  // Six triangles and more through the depth; rows of equal triangles, whose sides resist bending least.
  const double E = 100, nu = 0.3, length = 8, load = 1e-6;
  Body body{box(length, 1), element_numbers(3000, E, nu, "linear", "triangular"), {}, {}};
  const auto held = [&](const Vec2& p) { return p.x() < -length / 2 + 1e-9; };
  for (const Vec2& p : plan_nodes(body.outline, body.numbers, {}).points) body.anchored.push_back(held(p));
  const auto solid = build_solid(body);
  Motion<1> motion = at_rest<1>(*solid);
  motion.stiffness = E;
  AssembledStiffness<1> K;
  K.assemble(motion, *solid->elements());
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int a, int b, const NodeStiffness<1>& k, bool turned) {
    if (a >= solid->free || b >= solid->free) return;
    entries.emplace_back(2 * a, 2 * b, k.xx[0]);
    entries.emplace_back(2 * a, 2 * b + 1, turned ? k.yx[0] : k.xy[0]);
    entries.emplace_back(2 * a + 1, 2 * b, turned ? k.xy[0] : k.yx[0]);
    entries.emplace_back(2 * a + 1, 2 * b + 1, k.yy[0]);
  };
  for (int i = 0; i < solid->free; ++i) add(i, i, K.diagonal[slot(i)], false);
  for (std::size_t s = 0; s < solid->elements()->edge.size(); ++s) {
    const auto& [i, j] = solid->elements()->edge[s];
    add(i, j, K.off_diagonal[s], false);
    add(j, i, K.off_diagonal[s], true);
  }
  const int n = solid->free_coordinates();
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd push = Eigen::VectorXd::Zero(n);
  std::vector<int> end;
  for (int i = 0; i < solid->free; ++i)
    if (solid->points[slot(i)].x() > length / 2 - 1e-9) end.push_back(i);
  for (const int i : end) push[2 * i + 1] = load / static_cast<double>(end.size());
  const Eigen::VectorXd u = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(push);
  double tip = 0;
  for (const int i : end) tip += u[2 * i + 1] / static_cast<double>(end.size());
  const double inertia = 1.0 / 12, G = E / (2 * (1 + nu));
  CHECK(tip == Catch::Detail::Approx(load * std::pow(length, 3) / (3 * E * inertia) + 6 * load * length / (5 * G))
                   .epsilon(0.02));
}

TEST_CASE("the frequency bound of elements lies above the highest frequency, at rest and deformed, by 1.35 at most") {
  for (const char* placement : {"poisson_disk", "uniform", "triangular"})
    for (const double nu : {0.1, 0.3, 0.47}) {
      BodyNumbers numbers = element_numbers(150, 40, nu, "polynomial", placement);
      numbers.state = nu > 0.4 ? "plane_strain" : "plane_stress";
      const auto solid = solid_of(circle(), numbers);
      for (const double by : {0.0, 0.01}) {
        CAPTURE(placement, nu, by);
        const Motion<1> body = shaken<1>(*solid, 40, by, 3);
        const double exact = std::sqrt(squared_frequencies(body).maxCoeff());
        const double bound = std::sqrt(squared_frequency_bound(body).omega2[0]);
        CHECK(bound >= exact);
        CHECK(bound <= 1.35 * exact);
        if (by == 0) CHECK(frequency_bound(*solid, 40).omega == Catch::Detail::Approx(bound).epsilon(1e-14));
      }
    }
}

TEST_CASE("a free disk of elements keeps its momentum and angular momentum") {
  for (const char* law : {"polynomial", "st_venant_kirchhoff"}) {
    const auto solid = solid_of(circle(), element_numbers(200, 1e4, 0.3, law));
    Motion<4> body = shaken<4>(*solid, 1e4, 0.005, 1);
    for (int i = 0; i < solid->nodes(); ++i) {  // beside the shaking, a flight and a spin
      body.v[2 * i] += 0.1 - 0.05 * body.q[2 * i + 1];
      body.v[2 * i + 1] += -0.2 + 0.05 * body.q[2 * i];
    }
    const RigidMotion<4> before = rigid_motion(body);
    leap(body, 0.5 / frequency_bound(*solid, 1e4).omega, sanitized ? 2000 : 100000);
    const RigidMotion<4> after = rigid_motion(body);
    for (int lane = 0; lane < 4; ++lane) {
      for (int d = 0; d < 2; ++d)
        CHECK(after.velocity.at[d][lane] == Catch::Detail::Approx(before.velocity.at[d][lane]).epsilon(1e-12));
      CHECK(after.spin.at[2][lane] == Catch::Detail::Approx(before.spin.at[2][lane]).epsilon(1e-10));
    }
  }
}

TEST_CASE("a body of elements moves by the same bits alone and beside others") {
  for (const std::string& law : solid_law_names()) {
    CAPTURE(law);
    const auto solid = solid_of(circle(), element_numbers(120, 1e4, 0.3, law));
    Motion<4> four = shaken<4>(*solid, 1e4, 0.02, 1);
    leap(four, 1e-3, 100);
    for (int lane = 0; lane < 4; ++lane) {
      Motion<1> alone = shaken<1>(*solid, 1e4, 0.02, 1 + lane);
      Motion<2> two = shaken<2>(*solid, 1e4, 0.02, 1 + lane);
      leap(alone, 1e-3, 100);
      leap(two, 1e-3, 100);
      int same = 0;
      for (int c = 0; c < solid->coordinates(); ++c)
        same += alone.q[c][0] == four.q[c][lane] && two.q[c][0] == four.q[c][lane] && alone.v[c][0] == four.v[c][lane];
      CHECK(same == solid->coordinates());
      CHECK(interior_energy(alone)[0] == interior_energy(four)[lane]);
      CHECK(squared_frequency_bound(alone).omega2[0] == squared_frequency_bound(four).omega2[lane]);
    }
  }
}

TEST_CASE("a mirrored body of elements moves as the mirror image, bit for bit") {
  for (const std::string& law : solid_law_names()) {
    CAPTURE(law);
    const Body body{circle(), element_numbers(120, 1e4, 0.3, law), {}, {}};
    const auto solid = build_solid(body);
    JoinedNodes mirrored{std::make_shared<Solid>(*solid), std::vector<int>(solid->points.size()), {}};
    for (Vec2& p : mirrored.solid->points) p.x() = -p.x();
    mirrored.solid->interior = build_elements(body, mirrored);
    Motion<2> one = shaken<2>(*solid, 1e4, 0.02, 1), image = one;
    image.solid = mirrored.solid.get();
    for (int i = 0; i < solid->nodes(); ++i) {
      image.q[2 * i] = -one.q[2 * i];
      image.v[2 * i] = -one.v[2 * i];
    }
    leap(one, 1e-3, 100);
    leap(image, 1e-3, 100);
    int same = 0;
    for (int i = 0; i < solid->nodes(); ++i)
      same += (image.q[2 * i] == -one.q[2 * i]).all() && (image.q[2 * i + 1] == one.q[2 * i + 1]).all();
    CHECK(same == solid->nodes());
  }
}

TEST_CASE("held nodes stay, and an element between three of them is left out") {
  Body body{box(4, 1), element_numbers(200, 1e4, 0.3), {}, {}};
  for (const Vec2& p : plan_nodes(body.outline, body.numbers, {}).points) body.anchored.push_back(p.x() < 0);
  const auto solid = build_solid(body);
  CHECK(solid->elements()->size() < static_cast<int>(solid->cells.size()));
  for (const auto& nodes : solid->elements()->nodes) CHECK(nodes[0] < solid->free);
  Motion<1> motion = shaken<1>(*solid, 1e4, 0.01, 1);
  leap(motion, 1e-3, 50);
  for (int i = solid->free; i < solid->nodes(); ++i) CHECK(motion.q.at(i, 0) == solid->points[slot(i)]);
}

TEST_CASE("elements refuse nodes of one mass") {
  BodyNumbers numbers = element_numbers(60, 1e4, 0.3);
  numbers.mass = 1;
  CHECK_THROWS_AS(solid_of(circle(), numbers), FieldError);
}
