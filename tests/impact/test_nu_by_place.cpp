// Bodies of elements whose Poisson's ratio depends on the place.

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "body/elements/sweep.hpp"
#include "body/elements/viscosity.hpp"
#include "body/interior.hpp"
#include "body/wave_speeds.hpp"
#include "effect/element/absorbing_edges.hpp"
#include "material/solid_law.hpp"
#include "record/film.hpp"
#include "record/stress.hpp"
#include "same_bits.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

Lane<1> one(double value) { return Lane<1>::Constant(value); }

Body body_of(const std::string& law, const std::string& state, double nu = 0.3, int nodes = 100) {
  Body body{state == "axisymmetric" ? half_circle() : circle(), element_numbers(nodes, 1e4, nu, law), {}, {}};
  body.numbers.state = state;
  return body;
}

std::size_t planned(const Body& body) { return plan_nodes(body, {}).points.size(); }

/// Another nu at every node, -0.4 to 0.48.
Body uneven(Body body, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> nu(-0.4, 0.48);
  for (std::size_t n = planned(body); n > 0; --n) body.node_nu.push_back(nu(random));
  return body;
}

/// By its nodes it has one nu everywhere; its number says another, which nothing may take for it.
Body by_nodes(Body body, double nu) {
  body.node_nu.assign(planned(body), nu);
  body.numbers.nu = 0.1;
  return body;
}

template <int W>
Motion<W> shaken(const Solid& solid, double by, unsigned seed = 1) {
  Motion<W> body = at_rest<W>(solid);
  body.stiffness = 1e4;
  for (int lane = 0; lane < W; ++lane) {
    std::mt19937 random(seed + static_cast<unsigned>(lane));
    std::uniform_real_distribution<double> shift(-by, by);
    for (int c = 0; c < solid.free_coordinates(); ++c)
      for (Coordinates<W>* of : {&body.q, &body.v}) (*of)[c][lane] += shift(random);
  }
  if (solid.axisymmetric)
    for (int i = 0; i < solid.free; ++i)
      if (solid.points[static_cast<std::size_t>(i)].x() == 0) body.q[2 * i] = body.v[2 * i] = Lane<W>::Zero();
  return body;
}

std::vector<double> numbers_of(const Coordinates<1>& of) {
  std::vector<double> all;
  for (int c = 0; c < of.size(); ++c) all.push_back(of[c][0]);
  return all;
}

/// All that a moving body comes to, in all digits.
std::vector<double> course_of(const Solid& solid, bool flows) {
  Motion<1> body = shaken<1>(solid, 0.01);
  Flow<1> flow{20, 5, std::vector<PlasticMemory<1>>(solid.elements()->nodes.size())};
  if (flows) body.flow = &flow;
  std::vector<double> all;
  for (int k = 0; k < 20; ++k) {
    kick_and_drift(body, one(1e-4), one(1e-4));
    if (!flows && !solid.axisymmetric)
      all.push_back(damp_elements<1>(body, *solid.elements(), 1e-3, one(1e-4), k % 2 == 0)[0]);
  }
  for (const Coordinates<1>& of : {body.q, body.v, interior_forces(body), stiffness_times(body, body.v)})
    for (const double number : numbers_of(of)) all.push_back(number);
  all.push_back(interior_energy(body)[0]);
  all.push_back(squared_frequency_bound(body).omega2[0]);
  all.push_back(flow.lost[0]);
  return all;
}

struct Kind {
  std::string law, state;
};

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (const std::string& law : solid_law_names())
    for (const char* state : {"plane_stress", "plane_strain", "axisymmetric"}) all.push_back({law, state});
  return all;
}

Scene two_disks(const std::string& law) {
  Scene scene = paper_scene();
  Body above = body_of(law, "plane_strain", 0.3, 80), below = body_of(law, "plane_strain", 0.2, 100);
  above.numbers.roughness = 0.02;
  below.numbers.stiffness = 3e3;
  scene.projectile = std::make_shared<Body>(uneven(above, 1));
  scene.target = std::make_shared<Body>(uneven(below, 2));
  scene.launch.speed = 0.1;
  scene.launch.at = 0.5;
  scene.launch.psi1 = 0.4;
  return scene;
}

}  // namespace

TEST_CASE("nu by place: equal everywhere it has the bits of that number, in all that moves, holds and yields") {
  for (const auto& [law, state] : kinds()) {
    CAPTURE(law, state);
    const Body body = body_of(law, state), same = by_nodes(body, 0.3);
    const auto plain = build_solid(body), by_place = build_solid(same);
    CHECK(course_of(*plain, false) == course_of(*by_place, false));
    if (law == "polynomial" && state != "plane_stress") CHECK(course_of(*plain, true) == course_of(*by_place, true));
    CHECK(course_of(*plain, false) != course_of(*build_solid(uneven(body)), false));
    CHECK(body.geometry_text() != same.geometry_text());
    CHECK(same.geometry_text() != by_nodes(body, 0.2).geometry_text());
    BodyShot shot;
    for (const Vec2& p : plain->points) shot.place.emplace_back(p.x(), p.y() * 0.999);
    const GreatestStress one = greatest_stress(*plain, 1e4, shot), other = greatest_stress(*by_place, 1e4, shot);
    CHECK(one.von_mises == other.von_mises);
    CHECK(one.pressure == other.pressure);
    CHECK(wave_speeds(body, *plain).pressure > 0);
    CHECK(std::isnan(wave_speeds(same, *by_place).pressure));
  }
}

TEST_CASE("nu by place: forces are the slope of the energy and K w that of the forces, of every law") {
  for (const auto& [law, state] : kinds()) {
    CAPTURE(law, state);
    const auto solid = build_solid(uneven(body_of(law, state, 0.3, 60)));
    const Motion<1> motion = shaken<1>(*solid, 0.03);
    const Coordinates<1> force = interior_forces(motion), bent = stiffness_times(motion, motion.v);
    const double h = 1e-4;
    Motion<1> ahead = motion, behind = motion;
    double work = 0, most = 0;
    for (int c = 0; c < solid->free_coordinates(); ++c) {
      ahead.q[c] += h * motion.v[c];
      behind.q[c] -= h * motion.v[c];
      work += force[c][0] * motion.v[c][0];
      most = std::max(most, std::abs(bent[c][0]));
    }
    const double slope = (interior_energy(ahead)[0] - interior_energy(behind)[0]) / (2 * h);
    CHECK(-work == Catch::Detail::Approx(slope).epsilon(1e-7));
    const Coordinates<1> before = interior_forces(behind), after = interior_forces(ahead);
    for (int c = 0; c < solid->free_coordinates(); ++c)
      CHECK(std::abs(-(after[c][0] - before[c][0]) / (2 * h) - bent[c][0]) < 1e-6 * most);
    // The sweep feels the same forces.
    Motion<1> kicked = motion;
    for (int c = 0; c < kicked.v.size(); ++c) kicked.v[c] = one(0);
    kick_and_drift(kicked, one(1), one(0));
    double greatest = 0;
    for (int c = 0; c < solid->free_coordinates(); ++c) greatest = std::max(greatest, std::abs(force[c][0]));
    for (int c = 0; c < solid->free_coordinates(); ++c)
      CHECK(std::abs(kicked.v[c][0] * solid->mass[c / 2] - force[c][0]) < 1e-12 * greatest);
  }
}

TEST_CASE("nu by place: an element has that of its centre, where nodes tell a linear one") {
  Body body = body_of("linear", "plane_strain");
  for (const Vec2& p : plan_nodes(body, {}).points) body.node_nu.push_back(0.1 + 0.2 * p.x() - 0.1 * p.y());
  const auto solid = build_solid(body);
  const Elements& elements = *solid->elements();
  REQUIRE(elements.lame.size() == elements.nodes.size());
  for (std::size_t e = 0; e < elements.nodes.size(); ++e) {
    Vec2 centre = Vec2::Zero();
    for (const int node : elements.nodes[e]) centre += solid->points[static_cast<std::size_t>(node)] / 3;
    const Lame lame = lame_of(0.1 + 0.2 * centre.x() - 0.1 * centre.y(), "plane_strain");
    CHECK(elements.lame[e].lambda == Catch::Detail::Approx(lame.lambda).epsilon(1e-12));
    CHECK(elements.lame[e].mu == Catch::Detail::Approx(lame.mu).epsilon(1e-12));
  }
}

TEST_CASE("nu by place: no frequency is above the bound, at rest and shaken") {
  for (const auto& [law, state] : kinds()) {
    CAPTURE(law, state);
    const auto solid = build_solid(uneven(body_of(law, state, 0.3, 60)));
    for (const double by : {0.0, 0.03}) {
      const Motion<1> motion = shaken<1>(*solid, by);
      const int n = solid->free_coordinates();
      Eigen::MatrixXd K(n, n);
      for (int c = 0; c < n; ++c) {
        Coordinates<1> unit;
        unit.resize(solid->coordinates());
        unit[c] = 1.0;
        const Coordinates<1> column = stiffness_times(motion, unit);
        for (int row = 0; row < n; ++row)
          K(row, c) = column[row][0] / std::sqrt(solid->mass[row / 2] * solid->mass[c / 2]);
      }
      const double highest =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
      const double bound = squared_frequency_bound(motion).omega2[0];
      CHECK(bound >= highest);
      CHECK(bound < 2.5 * highest);
    }
  }
}

TEST_CASE("nu by place: two free disks keep momentum to rounding and their ledger, and lanes and threads their bits") {
  std::vector<Scene> list;
  for (const std::string& law : solid_law_names()) {
    list.push_back(two_disks(law));
    if (law == "linear") continue;
    list.push_back(two_disks(law));
    list.back().effects = {Damping{1e-3, "both"}};
    if (law != "polynomial") continue;
    list.push_back(two_disks(law));
    list.back().effects = {Yielding{100, 10, "projectile"}};
  }
  for (const Scene& scene : list) {
    CAPTURE(scene.projectile->numbers.law, scene.effects.size());
    const Outcome o = run_scene(BuiltSolids(scene), scene, go_on);
    INFO(o.reason << " e " << o.e << " closure " << o.energy_closure << " momentum " << o.momentum_residual);
    REQUIRE(o.status == Status::finished);
    CHECK(o.energy_closure < 1e-5);
    CHECK(o.momentum_residual < 1e-11);
  }
  const std::vector<std::string> alone = exact_texts(list, 1, 1);
  for (const int batch : {2, 4}) CHECK(exact_texts(list, 2, batch) == alone);
  Scene other = list[0];
  Body constant = *other.projectile;
  constant.node_nu.clear();
  other.projectile = std::make_shared<Body>(constant);
  CHECK(exact_texts({other}, 1, 1)[0] != alone[0]);
}

TEST_CASE("nu by place: absorbing edges have the impedance of what is around them, and frames the constants") {
  Body block{box(4, 2), element_numbers(200, 1e4, 0.3), {}, {}};
  block.numbers.state = "plane_strain";
  const Body same = by_nodes(block, 0.3);
  Body halves = block;
  for (const Vec2& p : plan_nodes(block, {}).points) halves.node_nu.push_back(p.x() < 0 ? 0 : 0.45);
  const auto plain = build_solid(block), by_place = build_solid(same), parted = build_solid(halves);
  const std::vector<EdgeDashpot> a = AbsorbingEdges{}.dashpots(*plain), b = AbsorbingEdges{}.dashpots(*by_place);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].xx == b[i].xx);
    CHECK(a[i].xy == b[i].xy);
    CHECK(a[i].yy == b[i].yy);
  }
  // Below, away from the middle and the corners: that of a pressure wave in each half.
  const Lame left = lame_of(0, "plane_strain"), right = lame_of(0.45, "plane_strain");
  double of_left = 0, of_right = 0;
  for (const EdgeDashpot& d : AbsorbingEdges{}.dashpots(*parted)) {
    const Vec2& p = parted->points[static_cast<std::size_t>(d.node)];
    if (p.y() > -2 + 1e-9 || std::abs(std::abs(p.x()) - 1) > 0.5) continue;
    (p.x() < 0 ? of_left : of_right) += d.yy;
  }
  CHECK(of_right / of_left ==
        Catch::Detail::Approx(std::sqrt((right.lambda + 2 * right.mu) / (left.lambda + 2 * left.mu))).epsilon(1e-6));
  const FrameMesh uniform = body_mesh(*plain, 1e4), mesh = body_mesh(*parted, 1e4);
  CHECK(uniform.lame.empty());
  REQUIRE(mesh.lame.size() == 2 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double x = 0;
    for (const int node : mesh.triangles[t]) x += mesh.rest[2 * static_cast<std::size_t>(node)] / 3;
    if (std::abs(x) < 0.5) continue;
    CHECK(mesh.lame[2 * t] == (x < 0 ? left : right).lambda);
    CHECK(mesh.lame[2 * t + 1] == (x < 0 ? left : right).mu);
  }
}
