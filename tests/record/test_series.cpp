// What a run tells between its steps, as numbers.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "record/film.hpp"
#include "record/slices.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

Scene oblique() {
  Scene scene;
  scene.projectile = disk(60, 1e4, 0.03, 1);
  scene.target = wall(150, 400, 0.03, 1);
  scene.launch.speed = 0.2;
  scene.launch.psi1 = 1;
  return scene;
}

std::vector<double> times(double from, double until, int count) {
  std::vector<double> list;
  for (int k = 0; k < count; ++k) list.push_back(from + (until - from) * k / (count - 1));
  return list;
}

std::vector<Sample> sampled(const Scene& scene, const std::vector<double>& at) {
  std::vector<Sample> samples;
  film_scene(BuiltSolids(scene), scene, {}, go_on, {}, {at, [&](const Sample& sample) { samples.push_back(sample); }});
  return samples;
}

}  // namespace

TEST_CASE("the sampled force is what changes the projectile's momentum, and its overlap what the row tells") {
  const Scene scene = oblique();
  const BuiltSolids solids(scene);
  const Outcome outcome = run_scene(solids, scene, go_on);
  REQUIRE(outcome.status == Status::finished);
  const std::vector<Sample> samples = sampled(scene, times(0, outcome.time, 400));
  REQUIRE(samples.size() == 400);
  Vec2 impulse = Vec2::Zero();
  double deepest = samples[0].indentation;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    impulse += (samples[k].time - samples[k - 1].time) / 2 * (samples[k].force + samples[k - 1].force);
    deepest = std::max(deepest, samples[k].indentation);
    CHECK(samples[k].total_energy == Approx(samples[0].total_energy).epsilon(1e-2));
  }
  CHECK(impulse.y() == Approx(outcome.impulse_n).epsilon(0.01));
  CHECK(impulse.x() == Approx(outcome.impulse_t).epsilon(0.02));
  CHECK(deepest == Approx(outcome.indentation).epsilon(0.01));
  CHECK(samples.back().projectile.velocity.y() == Approx(outcome.vn).epsilon(1e-6));
  CHECK(std::isnan(samples.front().overlap));
}

TEST_CASE("a spinning body's angle counts whole turns") {
  Scene scene = oblique();
  scene.launch.spin = 3;
  const std::vector<Sample> samples = sampled(scene, times(-10, 0, 21));
  REQUIRE(samples.size() == 21);
  for (const Sample& sample : samples) CHECK(sample.projectile.angle == Approx(3 * sample.time).margin(1e-6));
}

TEST_CASE("frames have the same bits whether a run is sampled between them or not") {
  const Scene scene = oblique();
  const BuiltSolids solids(scene);
  const std::vector<double> at = times(-1, 4, 6);
  std::vector<Frame> alone, beside;
  int samples = 0;
  film_scene(solids, scene, at, go_on, [&](Frame frame) { alone.push_back(std::move(frame)); });
  film_scene(solids, scene, at, go_on, [&](Frame frame) { beside.push_back(std::move(frame)); },
             {times(-1, 4, 101), [&](const Sample&) { ++samples; }});
  CHECK(samples == 101);
  REQUIRE(alone.size() == 6);
  REQUIRE(beside.size() == 6);
  for (std::size_t k = 0; k < 6; ++k) {
    CHECK(alone[k].position == beside[k].position);
    CHECK(alone[k].contact_force == beside[k].contact_force);
    CHECK(alone[k].energy == beside[k].energy);
  }
}

TEST_CASE("before the run a falling body is held where it began to fall") {
  Scene scene = oblique();
  scene.launch = {};
  scene.launch.speed = 0;
  scene.launch.height = 0.5;
  scene.effects = {Gravity{1e-2, "projectile"}};
  const std::vector<Sample> samples = sampled(scene, times(-20, 0, 81));
  REQUIRE(samples.size() == 81);
  CHECK(samples[0].projectile.velocity.norm() < 1e-9);
  CHECK(samples[0].projectile.centre.y() == Approx(samples[10].projectile.centre.y()));
  for (const Sample& sample : samples) {
    const double fallen = samples[0].projectile.centre.y() - sample.projectile.centre.y();
    CHECK(std::pow(sample.projectile.velocity.y(), 2) == Approx(2e-2 * fallen).margin(1e-9));
    CHECK(sample.total_energy == Approx(samples.back().total_energy).epsilon(1e-9));
  }
}

namespace {

// Two rods of elements, nu = 0, that meet end on; lengths of 1 and 2, the speed of waves in them 6.27 c.
Scene rods() {
  const auto rod = [](double low, double length) {
    const int nodes = static_cast<int>(800 * length);
    BodyNumbers numbers = element_numbers(nodes, 1e4, 0, "polynomial", "triangular");
    return std::make_shared<Body>(
        Body{{{-0.05, low}, {0.05, low}, {0.05, low + length}, {-0.05, low + length}}, numbers, {}, {}});
  };
  Scene scene;
  scene.projectile = rod(0, 1);
  scene.target = rod(-2, 2);
  scene.launch.speed = 0.03;
  scene.contact.xi = 1.6e5;
  return scene;
}

}  // namespace

TEST_CASE("slices share a body's momentum, and a wave runs through them at the speed of waves in a rod") {
  const Scene scene = rods();
  const BuiltSolids solids(scene);
  const FrameMesh mesh = frame_mesh(scene, solids);
  const double c0 = std::sqrt(1e4 / usual_density);
  // The front arrives where half of the wave's velocity is reached: half of the projectile's.
  std::vector<double> arrival(40, 0.0);
  std::vector<Slices> target;
  film_scene(solids, scene, times(0.001, 1.9 / c0, 800), go_on, [&](const Frame& frame) {
    if (target.empty()) target.emplace_back(mesh, frame, 1, 1, 0.05);
    const Slices& slices = target[0];
    REQUIRE(slices.count() == 40);
    const std::vector<double> velocity = slices.velocity(frame);
    double momentum = 0, of_nodes = 0;
    for (std::size_t s = 0; s < velocity.size(); ++s) {
      momentum += velocity[s] / 40;
      if (arrival[s] == 0 && velocity[s] < -0.25 * scene.launch.speed) arrival[s] = frame.time;
    }
    double mass = 0;
    for (int i = mesh.bodies[1].first; i < mesh.nodes(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      of_nodes += mesh.mass[k] * frame.velocity[2 * k + 1];
      mass += mesh.mass[k];
    }
    CHECK(momentum == Approx(of_nodes / mass).margin(0.02 * scene.launch.speed));
  });
  // From the top, slice 39, downwards.
  for (const std::size_t s : {30u, 20u, 10u}) {
    CAPTURE(s, arrival[s]);
    CHECK(arrival[s] > 0);
    CHECK((target[0].place()[35] - target[0].place()[s]) / (arrival[s] - arrival[35]) == Approx(c0).epsilon(0.02));
  }
}

TEST_CASE("rods that meet end on rebound by their ratio of lengths, whatever the speed") {
  Scene scene = rods();
  const Outcome slow = run_scene(BuiltSolids(scene), scene, go_on);
  scene.launch.speed *= 4;
  scene.contact.xi /= 4;
  const Outcome fast = run_scene(BuiltSolids(scene), scene, go_on);
  CHECK(slow.e_n == Approx(0.5).epsilon(0.03));
  CHECK(std::abs(fast.e_n / slow.e_n - 1) < 0.003);
}

TEST_CASE("a body that is held has no slices of its own, and a slice without nodes has no velocity") {
  Scene scene = rods();
  Body plane;
  plane.plane = Plane{};
  scene.target = std::make_shared<Body>(plane);
  const BuiltSolids solids(scene);
  const FrameMesh mesh = frame_mesh(scene, solids);
  CHECK(moves(mesh, 0));
  CHECK_FALSE(moves(mesh, 1));
  film_scene(solids, scene, {0.001}, go_on, [&](const Frame& frame) {
    CHECK(extent(mesh, frame, 0, 0) == Approx(0.1));
    const Slices fine(mesh, frame, 0, 1, 1e-3);
    CHECK(fine.count() == 1000);
    const std::vector<double> velocity = fine.velocity(frame);
    CHECK(std::any_of(velocity.begin(), velocity.end(), [](double v) { return std::isnan(v); }));
    CHECK(std::all_of(velocity.begin(), velocity.end(),
                      [](double v) { return std::isnan(v) || std::abs(v + 0.03) < 1e-6; }));
  });
}

TEST_CASE("the greatest stress of a body that is strained alike everywhere is that of its law, whose E may vary") {
  const double E = 50, nu = 0.3, strain = 1e-6;
  for (const std::string state : {"plane_strain", "axisymmetric"}) {
    Body body{state == "axisymmetric" ? half_circle(1, 200) : circle(), element_numbers(150, E, nu), {}, {}};
    body.numbers.state = state;
    const auto solid = build_solid(body);
    BodyShot shot;
    for (const Vec2& p : solid->points) shot.place.emplace_back(p.x(), p.y() * (1 - strain));
    const Lame lame = lame_of(nu, state);
    const GreatestStress stress = greatest_stress(*solid, E, shot);
    // Of the plane the deviator is that of both stresses in it; in space both others are lambda of it.
    const double along = (lame.lambda + 2 * lame.mu) * E * strain, across = lame.lambda * E * strain;
    const bool space = state == "axisymmetric";
    CHECK(stress.pressure == Approx((along + (space ? 2 : 1) * across) / (space ? 3 : 2)).epsilon(1e-5));
    CHECK(stress.von_mises ==
          Approx(space ? along - across : std::sqrt(along * along - along * across + across * across)).epsilon(1e-5));
    CHECK(stress.von_mises_depth >= 0);
    CHECK(stress.von_mises_depth <= 1);
    // Where E is four times as great at every node, by a function, so is the stress.
    Body stiffer = body;
    stiffer.node_stiffness.assign(static_cast<std::size_t>(solid->nodes()), 4 * E);
    CHECK(greatest_stress(*build_solid(stiffer), E, shot).von_mises == Approx(4 * stress.von_mises).epsilon(1e-9));
  }
  const auto springs = build_solid(*disk(60, 1e4, 0, 1));
  CHECK(std::isnan(greatest_stress(*springs, 1e4, {}).pressure));
}
