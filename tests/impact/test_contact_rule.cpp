// The contact that acts where a scene leaves it to the program.

#include <catch2/catch.hpp>

#include "impact/launch/contact_rule.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

// A smooth disk of even nodes, head on against the rigid plane.
Scene on_plane(int nodes, double speed) {
  BodyNumbers even;
  even.nodes = nodes;
  even.placement = "triangular";
  Body plane;
  plane.plane = Plane{};
  Scene scene;
  scene.projectile = std::make_shared<Body>(Body{circle(), even, {}, {}});
  scene.target = std::make_shared<Body>(plane);
  scene.launch.speed = speed;
  return scene;
}

Outcome outcome(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

Placement arriving(const Scene& scene, const BuiltSolids& built) {
  Placement placement = placed_at_rest(built[0]);
  placement.velocity = in_space(scene.launch.velocity());
  return placement;
}

}  // namespace

TEST_CASE("a contact that nobody gives gives way by a 200th of the expected indentation, and its columns say so") {
  for (const double speed : {0.01, 0.1}) {
    const Scene scene = on_plane(400, speed);
    const Outcome o = outcome(scene);
    INFO(speed << ": " << o.reason);
    REQUIRE(o.status == Status::finished);
    const BuiltSolids built(scene);
    const QuasiStaticImpact expected = expected_impact(scene, built, arriving(scene, built));
    CHECK(o.xi == Catch::Detail::Approx(200 / expected.approach));
    CHECK(o.V0 == Catch::Detail::Approx(1000 * o.before.total()));
    CHECK(o.certified == 1);
    // The law is right about what it is asked for.
    CHECK(o.overlap == Catch::Detail::Approx(expected.approach).epsilon(0.2));
  }
}

TEST_CASE("the contact by the rule is as good as a hard one") {
  for (const double speed : {0.01, 0.1, 0.3}) {
    Scene scene = on_plane(800, speed);
    const Outcome by_rule = outcome(scene);
    scene.contact.xi = 4 * by_rule.xi;
    const Outcome hard = outcome(scene);
    INFO(speed);
    REQUIRE(hard.status == Status::finished);
    CHECK(std::abs(by_rule.e - hard.e) < 0.02);
  }
}

TEST_CASE("what a scene gives of its contact acts as it is given") {
  Scene scene = small_scene(1, 1);
  const BuiltSolids built(scene);
  ExponentialRepulsion acts = acting_contact(scene, built, arriving(scene, built));
  CHECK(acts.V0 == 150);
  CHECK(acts.xi == 300);
  CHECK(acts.reach == 0.1);
  CHECK(!acts.by_length);
  scene.contact.V0 = not_given;
  acts = acting_contact(scene, built, arriving(scene, built));
  CHECK(acts.xi == 300);
  CHECK(acts.by_length);
  scene.contact = {150, not_given, not_given, "one"};
  acts = acting_contact(scene, built, arriving(scene, built));
  CHECK(acts.V0 == 150);
  CHECK(acts.reach == Catch::Detail::Approx(30 / acts.xi));
}
