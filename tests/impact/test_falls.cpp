// Gravity from the start, and bounces.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "impact/bounces.hpp"
#include "impact/launch/launch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};
constexpr double g = 1e-2;

// A smooth disk over the plane.
Scene falling(double height, double speed) {
  Scene scene;
  // Symmetric, so that it does not begin to spin.
  scene.projectile = std::make_shared<Body>(Body{circle(), numbers(60, 1e4, 0, 1, "triangular"), {}, {}});
  Body plane;
  plane.plane = Plane{};
  scene.target = std::make_shared<Body>(plane);
  scene.contact = {.V0 = 100, .xi = 2000, .reach = 0.02};
  scene.launch.height = height;
  scene.launch.speed = speed;
  scene.effects = {Gravity{g, "projectile"}};
  return scene;
}

Start started(const Scene& scene) { return launch(scene, BuiltSolids(scene)); }

double lowest(const Scene& scene, const Start& start) {
  const BuiltSolids solids(scene);
  double low = 1e9;
  for (const Vec2& p : placed(solids[0].points, solids[0].centre(), start.bodies[0])) low = std::min(low, p.y());
  return low;
}

}  // namespace

TEST_CASE("from a given height a body falls freely until its surface is within reach") {
  for (const double speed : {0.0, 0.05}) {
    const Scene scene = falling(0.5, speed);
    const Start start = started(scene);
    const Vec3& v = start.bodies[0].velocity;
    const double fallen = 0.5 - lowest(scene, start);
    CHECK(lowest(scene, start) <= scene.contact.reach);
    CHECK(lowest(scene, start) > 0.9 * scene.contact.reach);
    CHECK(-v.y() == Approx(std::sqrt(speed * speed + 2 * g * fallen)).epsilon(1e-12));
    CHECK(start.fell == Approx((-v.y() - speed) / g).epsilon(1e-9));
  }
}

TEST_CASE("e under gravity is of the speeds at the touch, from a height or not") {
  const auto e = [](double gravity, double height) {
    Scene scene = falling(height, std::isnan(height) ? 0.05 : 0);
    scene.effects = {Gravity{gravity, "projectile"}};
    if (gravity == 0) scene.effects.clear();
    const Outcome o = run_scene(BuiltSolids(scene), scene, go_on);
    REQUIRE(o.status == Status::finished);
    return o.e;
  };
  const double strong = 0.05, height = 0.05 * 0.05 / (2 * strong);
  CHECK(e(1e-4, not_given) == Catch::Detail::Approx(e(0, not_given)).margin(1e-3));
  CHECK(e(strong, not_given) == Catch::Detail::Approx(e(strong, height)).margin(0.02));
}

TEST_CASE("a body thrown along the surface from a height lands where it was aimed") {
  Scene scene = falling(0.5, not_given);
  scene.launch.normal_speed = 0;
  scene.launch.tangential_speed = 0.1;
  scene.launch.at = 3;
  const Start start = started(scene);
  const Placement& now = start.bodies[0];
  const double gap = lowest(scene, start), fall_speed = -now.velocity.y();
  const double left = (std::sqrt(fall_speed * fall_speed + 2 * g * gap) - fall_speed) / g;
  CHECK(now.velocity.x() == Approx(0.1));
  CHECK(now.centre.x() + 0.1 * left == Approx(3).epsilon(1e-9));
}

TEST_CASE("without a given height gravity acts from the first approach on, as before") {
  const Start start = started(falling(not_given, 0.05));
  CHECK(start.bodies[0].velocity == Vec3(0, -0.05, 0));
  CHECK(start.bodies[0].acceleration == Vec3::Zero());
}

TEST_CASE("a speed of 0 needs gravity on the projectile alone, and a height") {
  const auto refused = Catch::Matchers::Contains("0 leaves the projectile where it is: it needs a launch.height");
  Scene bare = falling(0.5, 0);
  bare.effects.clear();
  CHECK_THROWS_WITH(started(bare), refused);
  CHECK_THROWS_WITH(started(falling(not_given, 0)), refused);
  Scene both = falling(0.5, 0);
  both.target = disk(60, 1e4, 0, 2);
  both.effects = {Gravity{g, "both"}};
  CHECK_THROWS_WITH(started(both), refused);
  both.effects = {Gravity{g, "projectile"}};
  CHECK(started(both).touches);
}

TEST_CASE("a body that has fallen bounces like one thrown at that speed") {
  const double height = 0.5, speed = std::sqrt(2 * g * height);
  const Scene scene = falling(height, 0);
  const BuiltSolids solids(scene);
  const Outcome fallen = run_scene(solids, scene, go_on);
  Scene thrown = falling(not_given, speed);
  thrown.effects.clear();
  const Outcome flown = run_scene(solids, thrown, go_on);
  REQUIRE(fallen.status == Status::finished);
  REQUIRE(flown.status == Status::finished);
  CHECK(fallen.e == Approx(flown.e).margin(5e-3));
}

TEST_CASE("each bounce rises as high as its speed takes it, and falls back as fast") {
  Scene scene = falling(0.5, 0);
  scene.effects.push_back(Damping{0.02, "projectile"});
  const BuiltSolids solids(scene);
  const Bounces bounces = follow_bounces(solids, scene, 4, not_given, go_on);
  CHECK(bounces.reason == "");
  REQUIRE(bounces.list.size() == 4);
  CHECK(bounces.list[0].e == Approx(run_scene(solids, scene, go_on).e).margin(1e-5));
  for (std::size_t k = 0; k < 4; ++k) {
    const Bounce& bounce = bounces.list[k];
    INFO("bounce " << k + 1 << ": e = " << bounce.e << ", height " << bounce.height);
    CHECK(bounce.e > 0.3);
    CHECK(bounce.e < 1);
    // The places where they touch and part differ by less than the range in which the repulsion shows.
    const double parting = std::pow(bounce.e * bounce.speed, 2);
    CHECK(std::abs(bounce.height - parting / (2 * g)) < 0.01);
    if (k == 3) break;
    const Bounce& next = bounces.list[k + 1];
    CHECK(std::abs(next.speed * next.speed - parting) < 2 * g * 0.01);
    CHECK(next.time - bounce.time == Approx(2 * bounce.e * bounce.speed / g).epsilon(0.1));
  }
}

TEST_CASE("bounces end early with a reason") {
  Scene scene = falling(0.3, 0);
  scene.effects.push_back(Damping{0.05, "projectile"});
  const BuiltSolids solids(scene);
  const Bounces low = follow_bounces(solids, scene, 8, 0.1, go_on);
  REQUIRE(!low.list.empty());
  CHECK(low.list.size() < 8);
  CHECK(low.list.back().height < 0.1);
  CHECK_THAT(low.reason, Catch::Matchers::Contains("R, less than 0.1 R"));
  scene.integration.time_limit = 5;
  CHECK_THAT(follow_bounces(solids, scene, 8, 0.1, go_on).reason, Catch::Matchers::Contains("time_limit of 5 R/c"));
  scene.effects.erase(scene.effects.begin());
  CHECK_THROWS_WITH(follow_bounces(solids, scene, 8, 0.1, go_on), Catch::Matchers::Contains("bounces need gravity"));
}
