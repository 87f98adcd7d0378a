// What is estimated of an impact, against the impact.

#include <catch2/catch.hpp>

#include "core/turn.hpp"
#include "impact/estimate.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::WithinRel;

namespace {

const std::atomic<bool> go_on{false};

std::shared_ptr<const Body> round_body(double radius, double stiffness, int nodes = 800) {
  Body body{circle(radius, 808), numbers(nodes, stiffness, 0, 1, "triangular"), {}, {}};
  body.numbers.mass = not_given;
  return std::make_shared<Body>(body);
}

std::shared_ptr<const Body> plane() {
  Body body;
  body.plane = Plane{};
  return std::make_shared<Body>(body);
}

std::shared_ptr<const Body> block(double stiffness) {
  Body made = *wall(3200, stiffness, 0, 1, 6, 2);
  made.numbers.mass = not_given;
  return std::make_shared<Body>(made);
}

Scene scene_of(std::shared_ptr<const Body> projectile, std::shared_ptr<const Body> target, double speed) {
  Scene scene;
  scene.projectile = std::move(projectile);
  scene.target = std::move(target);
  scene.launch.speed = speed;
  scene.contact = {20 * speed * speed, 3000, 0.02, "two"};  // hard
  return scene;
}

void check_against_run(const Scene& scene) {
  const Estimate e = estimate(scene);
  CAPTURE(e.no_law, e.normal_speed, e.wave_speed, 2 * e.impact.half_width / e.spacing);
  REQUIRE(e.no_law.empty());
  CHECK(e.in_range);
  const BuiltSolids solids(scene);
  const Outcome run = run_scene(solids, scene, go_on);
  REQUIRE(run.status == Status::finished);
  CHECK_THAT(run.contact_time, WithinRel(e.impact.time, 0.2));
  CHECK_THAT(run.indentation, WithinRel(e.impact.approach, 0.2));
}

}  // namespace

TEST_CASE("estimate: a disk on a plane is in touch as long, and comes as near, as the law says within 20 %",
          "[estimate]") {
  const double speed = GENERATE(0.1, 0.3, 0.6);  // of c_P about 7 c
  check_against_run(scene_of(round_body(1, 1e4), plane(), speed));
}

TEST_CASE("estimate: two unlike disks", "[estimate]") {
  check_against_run(scene_of(round_body(1, 1e4), round_body(1.5, 3e4, 1800), 0.4));
}

TEST_CASE("estimate: a disk on an elastic block", "[estimate]") {
  check_against_run(scene_of(round_body(1, 1e4), block(4e4), 0.3));
}

TEST_CASE("estimate: where no law holds it says why, and its numbers are undefined", "[estimate]") {
  const auto square = std::make_shared<Body>(Body{box(2, 2), numbers(400, 1e4, 0, 1), {}, {}});
  const Estimate e = estimate(scene_of(square, plane(), 0.1));
  CHECK(e.no_law == "a flat side touches a flat one, and the law is of round outlines");
  CHECK(e.doubts.empty());  // its corners are of no account
  CHECK(std::isnan(e.impact.force));
  CHECK(std::isnan(e.over_yield));
}

TEST_CASE("estimate: it doubts what a corner does, whoever it meets, but none of a flat side", "[estimate]") {
  Body tilted{box(2, 2), numbers(400, 1e4, 0, 1), {}, {}};
  for (Vec2& p : tilted.outline) p = Turn(0.3)(p);
  Body turned{box(2, 2), numbers(400, 1e4, 0, 1), {}, {}};
  turned.numbers.angle = 30;
  for (const Body& square : {tilted, turned})
    for (const auto& target : {plane(), block(4e4)}) {
      const Estimate e = estimate(scene_of(std::make_shared<Body>(square), target, 0.1));
      CHECK(e.no_law == "a corner touches, and the law is of smooth outlines");
      REQUIRE(e.doubts.size() == 1);
      CHECK(e.doubts[0].kind == "corner");
    }
  const auto bar = std::make_shared<Body>(Body{box(0.5, 2), numbers(200, 1e4, 0, 1), {}, {}});
  CHECK(estimate(scene_of(bar, bar, 0.1)).doubts.empty());  // end on end
  CHECK(estimate(scene_of(bar, block(4e4), 0.1)).doubts.empty());
}

TEST_CASE("estimate: it doubts a contact of few nodes, and a speed at which springs fold", "[estimate]") {
  const auto kinds = [](const Scene& scene) {
    std::vector<std::string> list;
    for (const Doubt& doubt : estimate(scene).doubts) list.push_back(doubt.kind);
    return list;
  };
  CHECK(kinds(scene_of(round_body(1, 1e4), plane(), 0.3)).empty());
  const auto slow = kinds(scene_of(round_body(1, 1e4), plane(), 0.003));
  CHECK(std::count(slow.begin(), slow.end(), "coarse_contact") == 1);
  CHECK(std::count(slow.begin(), slow.end(), "coarse_rim") == 1);
  Body random = *round_body(1, 1e4);
  random.numbers.placement = "poisson_disk";
  CHECK(kinds(scene_of(std::make_shared<Body>(random), plane(), 0.7)) == std::vector<std::string>{"folding"});
}

TEST_CASE("estimate: a contact that is not resolved names the body, and finds nothing to say of the remedy it names",
          "[estimate]") {
  using Catch::Matchers::Contains;
  const auto coarse = [](const Scene& scene) {
    std::vector<std::string> reasons;
    for (const Doubt& doubt : estimate(scene).doubts)
      if (doubt.kind == "coarse_contact") reasons.push_back(doubt.reason);
    return reasons;
  };
  auto few = round_body(1, 1e4, 100), many = round_body(1, 1e4, 12800);
  auto reasons = coarse(scene_of(many, few, 0.03));
  REQUIRE(reasons.size() == 1);
  CHECK_THAT(reasons[0], Contains("node spacings of the target long") && Contains("times as many nodes"));
  reasons = coarse(scene_of(few, few, 0.03));
  REQUIRE(reasons.size() == 2);
  CHECK_THAT(reasons[0], Contains("of the projectile long"));
  // Of a mesh it takes eight sides along half of the contact.
  const auto ball = [](double h_min) {
    Body body{half_circle(1, 1000), element_numbers(0, 1e4, 0.3), {}, {}};
    body.numbers.state = "axisymmetric";
    body.numbers.h_min = h_min;
    return std::make_shared<Body>(body);
  };
  const double half = estimate(scene_of(ball(0.02), plane(), 0.01)).impact.half_width;
  CHECK(coarse(scene_of(ball(half / 8.01), plane(), 0.01)).empty());
  reasons = coarse(scene_of(ball(half / 7.9), plane(), 0.01));
  REQUIRE(reasons.size() == 1);
  CHECK_THAT(reasons[0], Contains("7.9 of the projectile's triangles there") && Contains("8 are needed"));
  const auto at = reasons[0].find("take h_min = ");
  REQUIRE(at != std::string::npos);
  const double wanted = std::stod(reasons[0].substr(at + 13));
  CHECK_THAT(wanted, WithinRel(half / 8, 0.1));
  CHECK(coarse(scene_of(ball(wanted), plane(), 0.01)).empty());
  // A sphere's mesh is finest at its lowest point unless it is said where, and a target is met at its highest.
  const auto fine = ball(half / 20);
  reasons = coarse(scene_of(fine, fine, 0.01));
  REQUIRE(reasons.size() == 1);
  CHECK_THAT(reasons[0], Contains("of the target's triangles") && Contains("give fine_at = { 0 R, 1 R }"));
  auto above = std::make_shared<Body>(*fine);
  above->fine_at = Vec2(0, 1);
  CHECK(coarse(scene_of(fine, above, 0.01)).empty());
  // A body is turned after it is meshed.
  const auto disk = [](double h_min, double finest, double angle) {
    Body body{circle(1, 1000), element_numbers(0, 1e4, 0.3), {}, {}};
    body.numbers.h_min = h_min;
    body.numbers.angle = angle;
    body.fine_at = Vec2(0, finest);
    return std::make_shared<Body>(body);
  };
  const double wide = estimate(scene_of(disk(0.02, -1, 0), disk(0.02, 1, 0), 0.01)).impact.half_width, h = wide / 10;
  CHECK(coarse(scene_of(disk(h, -1, 0), disk(h, 1, 0), 0.01)).empty());
  CHECK(coarse(scene_of(disk(h, 1, 180), disk(h, -1, 180), 0.01)).empty());
  CHECK(coarse(scene_of(disk(h, -1, 180), disk(h, 1, 180), 0.01)).size() == 2);
}

TEST_CASE("estimate: yielding begins at 1.67 times the yield stress", "[estimate]") {
  Scene scene = scene_of(round_body(1, 1e4), plane(), 0.3);
  CHECK(std::isnan(over_yield(scene)));
  const double pressure = estimate(scene).pressure;
  const auto with_yield = [&](double yield) {
    Body body = *scene.projectile;
    body.material = PlaneMaterial{.yield = yield};
    Scene other = scene;
    other.projectile = std::make_shared<Body>(body);
    return over_yield(other);
  };
  CHECK(with_yield(pressure / 1.66) == 0);
  CHECK(with_yield(pressure / 1.68) == 1);
  // Of two bodies the one that no effect lets yield is named.
  Body metal = *round_body(1, 1e4);
  metal.material = PlaneMaterial{.yield = 1e-3 * pressure};
  metal.numbers.interior = "elements";
  metal.numbers.nu = 0.3;
  metal.numbers.state = "plane_strain";
  scene.projectile = scene.target = std::make_shared<Body>(metal);
  scene.effects = {Yielding{1, 0, "projectile"}};
  const Estimate one_yields = estimate(scene);
  CHECK(one_yields.over_yield == 1);
  REQUIRE(!one_yields.doubts.empty());
  CHECK(one_yields.doubts.back().kind == "over_yield");
  CHECK_THAT(one_yields.doubts.back().reason,
             Catch::Matchers::Contains("yield stress of the target") && Catch::Matchers::Contains("on = \"both\""));
  scene.effects = {Yielding{1, 0, "both"}};
  CHECK(std::isnan(estimate(scene).over_yield));
}

TEST_CASE("an estimate counts the fall from a height under gravity, as the impact does") {
  Scene fallen = scene_of(round_body(1, 1e4), plane(), 0.001);
  fallen.launch.height = 1;
  fallen.effects = {Gravity{1e-3}};
  const Scene thrown = scene_of(round_body(1, 1e4), plane(), std::hypot(0.001, std::sqrt(2e-3)));
  CHECK_THAT(estimate(fallen).normal_speed, WithinRel(estimate(thrown).normal_speed, 1e-12));
  CHECK_THAT(estimate(fallen).impact.time, WithinRel(estimate(thrown).impact.time, 1e-12));
  fallen.launch.speed = 0;
  CHECK(estimate(fallen).no_law.empty());
}

TEST_CASE("an estimate counts the target's own motion: two bodies that meet half way, or one that runs away") {
  Scene meet = scene_of(round_body(1, 1e4), round_body(1, 1e4), 0.02);
  auto target = std::make_shared<Body>(*meet.target);
  target->velocity = {0, 0.03};
  meet.target = target;
  CHECK_THAT(estimate(meet).normal_speed, WithinRel(0.05, 1e-12));
  target->velocity = {0, -0.01};
  CHECK_THAT(estimate(meet).normal_speed, WithinRel(0.01, 1e-12));
}
