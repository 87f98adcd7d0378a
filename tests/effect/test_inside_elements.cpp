// Viscosity and warmth of bodies of elements.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "body/rigid_motion.hpp"
#include "body/vibration.hpp"
#include "core/rng.hpp"
#include "effect/catalogue.hpp"
#include "impact/batch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

Lane<1> one(double value) { return Lane<1>::Constant(value); }

std::shared_ptr<const Solid> free_disk() { return build_solid(Body{circle(), element_numbers(60, 30, 0.3), {}, {}}); }

Body held_block() {
  Body block{box(2, 1), element_numbers(80, 30, 0.2), {}, {}};
  for (const Vec2& p : plan_nodes(block.outline, block.numbers, {}).points) block.anchored.push_back(p.y() < -1 + 1e-9);
  return block;
}

/// Of any solid, its free nodes displaced and moving at random.
Motion<1> shaken(const Solid& solid, double stiffness, std::uint64_t seed) {
  Motion<1> body = at_rest<1>(solid);
  body.stiffness = one(stiffness);
  Random random(seed, 5);
  for (int i = 0; i < solid.free; ++i) {
    const double ux = random.normal(), uy = random.normal(), vx = random.normal(), vy = random.normal();
    body.q.set(i, 0, solid.points[static_cast<std::size_t>(i)] + 0.01 * Vec2(ux, uy));
    body.v.set(i, 0, 0.1 * Vec2(vx, vy));
  }
  return body;
}

double kinetic(const Motion<1>& body) {
  double sum = 0;
  for (int i = 0; i < body.solid->free; ++i) sum += body.solid->mass[i] * body.v.at(i, 0).squaredNorm() / 2;
  return sum;
}

Vec2 momentum(const Motion<1>& body) {
  Vec2 sum = Vec2::Zero();
  for (int i = 0; i < body.solid->free; ++i) sum += body.solid->mass[i] * body.v.at(i, 0);
  return sum;
}

double angular_momentum(const Motion<1>& body) {
  double sum = 0;
  for (int i = 0; i < body.solid->free; ++i) sum += body.solid->mass[i] * cross(body.q.at(i, 0), body.v.at(i, 0));
  return sum;
}

/// A disk onto a rigid plane. [c_P of the disk]
Scene onto_plane(Body disk, double wave_speed, double speed) {
  Scene scene;
  Body plane;
  plane.plane = Plane{};
  scene.projectile = std::make_shared<Body>(std::move(disk));
  scene.target = std::make_shared<Body>(plane);
  scene.launch.speed = speed * wave_speed;
  scene.launch.psi1 = 0;
  scene.contact.xi = 1000;
  return scene;
}

}  // namespace

TEST_CASE("elements: viscosity takes energy, as much as it books, and no momentum, for steps of any length") {
  const auto disk = free_disk(), block = build_solid(held_block());
  for (const double h : {1e-3, 0.1, 10.0, 1e6})
    for (const Solid* solid : {disk.get(), block.get()})
      for (const bool forward : {true, false}) {
        CAPTURE(h, solid->anchored(), forward);
        Motion<1> moving = shaken(*solid, 30, 4);
        const double before = kinetic(moving), turning = angular_momentum(moving);
        const Vec2 going = momentum(moving);
        const double lost = Damping{0.3, "both"}.damp(moving, *solid->elements(), one(h), forward)[0];
        CHECK(kinetic(moving) < before);
        CHECK(lost == Catch::Detail::Approx(before - kinetic(moving)).epsilon(1e-10));
        Vec2 pulled = Vec2::Zero();
        for (int i = solid->free; i < solid->nodes(); ++i) pulled += moving.f.at(i, 0);
        CHECK((momentum(moving) + pulled - going).norm() < 1e-11 * (1 + pulled.norm()));
        if (!solid->anchored()) CHECK(std::abs(angular_momentum(moving) - turning) < 1e-11);
      }
}

TEST_CASE("elements: viscosity leaves a body that moves rigidly alone, strained as it may be") {
  const auto disk = free_disk();
  Motion<1> moving = shaken(*disk, 30, 4);
  for (int i = 0; i < disk->nodes(); ++i) moving.v.set(i, 0, Vec2(0.3, -0.2) + 0.7 * perpendicular(moving.q.at(i, 0)));
  CHECK(std::abs(Damping{0.3, "both"}.damp(moving, *disk->elements(), one(0.2), true)[0]) < 1e-25);
}

TEST_CASE("elements: a triangle that swells slows down at its exact rate, to order 2 in the step") {
  Solid triangle;
  const double height = std::sqrt(0.75), area = height / 2, E = 5, nu = 0.3, mass = 2, time = 0.25;
  triangle.points = {Vec2(0, 0), Vec2(1, 0), Vec2(0.5, height)};
  triangle.free = 3;
  triangle.mass = Masses(mass);
  Elements elements;
  elements.first = {0, 1, 1, 1};
  elements.nodes = {{0, 1, 2}};
  elements.weight = {area};
  elements.law = solid_law("polynomial", lame_of(nu, "plane_stress"));
  triangle.interior = elements;
  const Vec2 middle(0.5, height / 3);
  // v = u (x - middle): D = u, stress time 2 (lambda + mu) u, pull on a corner stress * area / height, arm 2/3 height.
  const Lame lame = lame_of(nu, "plane_stress");
  const double rate = time * 2 * (lame.lambda + lame.mu) * E * area / height / (mass * 2 * height / 3);
  const auto error = [&](int steps) {
    Motion<1> moving = at_rest<1>(triangle);
    moving.stiffness = one(E);
    for (int i = 0; i < 3; ++i) moving.v.set(i, 0, triangle.points[static_cast<std::size_t>(i)] - middle);
    for (int i = 0; i < steps; ++i) Damping{time, "both"}.damp(moving, elements, one(1.0 / steps), i % 2 == 0);
    return (moving.v.at(0, 0) + std::exp(-rate) * middle).norm();
  };
  CHECK(error(20) < 1e-3 * std::exp(-rate));
  CHECK(error(20) / error(40) == Catch::Detail::Approx(4).epsilon(0.02));
}

TEST_CASE("elements: a viscous disk rebounds as a lattice of the same viscosity does") {
  const double nu = 1.0 / 3, wave_speed = std::sqrt(1e4 / ((1 - nu * nu) * usual_density));
  BodyNumbers springs;
  springs.placement = "triangular";
  springs.quartic = 0;
  springs.stiffness = 1e4 * std::sqrt(3.0) / 2;
  for (const double time : {1e-3, 4e-3}) {
    std::vector<double> e;
    for (const BodyNumbers& numbers : {springs, element_numbers(800, 1e4, nu)}) {
      Scene scene = onto_plane(Body{circle(1, 6000), numbers, {}, {}}, wave_speed, 0.02);
      scene.effects = {Damping{time, "both"}};
      const Outcome o = run_scene(BuiltSolids(scene), scene, go_on);
      REQUIRE(o.status == Status::finished);
      CHECK(o.energy_closure < 1e-4);
      e.push_back(o.e);
    }
    CAPTURE(time, e[0], e[1]);
    CHECK(e[0] < 0.983);  // 0.9865 without
    CHECK(e[1] < 0.985);  // 0.9889 without
    CHECK(std::abs(e[0] - e[1]) < 0.01);
  }
}

TEST_CASE("elements: warm bodies have the energy of their modes, no rigid motion, and their ledger closes") {
  const auto disk = free_disk(), block = build_solid(held_block());
  for (const Solid* solid : {disk.get(), block.get()}) {
    const Vibrations vibrations(*solid);
    const double temperature = 1e-8;
    const int coordinates = 2 * solid->free - (solid->anchored() ? 0 : 3), samples = 400;
    double potential = 0, motion = 0;
    for (int seed = 1; seed <= samples; ++seed) {
      Motion<1> moving = at_rest<1>(*solid);
      moving.stiffness = one(30);
      const auto sample = vibrations.draw(temperature, 30, seed, 0);
      CHECK(largest_strain(*solid, sample.displacement) < 0.01);
      for (int i = 0; i < solid->free; ++i) {
        const auto k = static_cast<std::size_t>(i);
        moving.q.set(i, 0, solid->points[k] + sample.displacement[k]);
        moving.v.set(i, 0, sample.velocity[k]);
      }
      potential += interior_energy(moving)[0] / samples;
      motion += kinetic(moving) / samples;
      if (solid->anchored()) continue;
      CHECK(momentum(moving).norm() < 1e-15);
      CHECK(std::abs(angular_momentum(moving)) < 1e-15);
    }
    const double expected = coordinates * temperature / 2, error = std::sqrt(2.0 / coordinates / samples);
    CHECK(potential / expected == Catch::Detail::Approx(1).margin(4 * error));
    CHECK(motion / expected == Catch::Detail::Approx(1).margin(4 * error));
  }
  Scene scene = onto_plane(Body{circle(), element_numbers(150, 1e4, 0.3), {}, {}}, 7, 0.02);
  scene.effects = {Thermal{1e-6, 1, "both"}};
  const Outcome o = run_scene(BuiltSolids(scene), scene, go_on);
  REQUIRE(o.status == Status::finished);
  CHECK(o.energy_closure < 1e-5);
  CHECK(o.before.of(0).vibration > 1e-5);
}
