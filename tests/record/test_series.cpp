// What a run tells between its steps, as numbers.

#include <catch2/catch.hpp>
#include <cmath>

#include "record/film.hpp"
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
