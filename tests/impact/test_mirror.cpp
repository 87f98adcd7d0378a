// A launch from the right is the mirror image of one from the left.

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "impact/batch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

/// The planned nodes of a body as nodes that were given, at x or at -x.
std::shared_ptr<const Body> with_given_nodes(const Body& body, double side) {
  const NodePlan plan = plan_nodes(body, body.anchored);
  Body given = body;
  given.points.clear();
  for (const Vec2& p : plan.points) given.points.emplace_back(side * p.x(), p.y());
  for (Vec2& p : given.outline) p.x() *= side;
  if (side < 0) std::reverse(given.outline.begin(), given.outline.end());
  given.numbers.nodes = static_cast<int>(given.points.size());
  return std::make_shared<Body>(given);
}

Scene seen_from(Scene scene, double side) {
  scene.projectile = with_given_nodes(*scene.projectile, side);
  scene.target = with_given_nodes(*scene.target, side);
  for (double* given :
       {&scene.launch.psi1, &scene.launch.angle, &scene.launch.tangential_speed, &scene.launch.at, &scene.launch.spin})
    *given *= side;
  return scene;
}

Outcome impact(const Scene& scene) {
  const auto projectile = build_solid(*scene.projectile), target = build_solid(*scene.target);
  return run_scene({projectile.get(), target.get()}, scene, go_on);
}

}  // namespace

TEST_CASE("a launch along -x, spin and place of landing turned too, is the mirror image of one along +x") {
  Scene scene;
  scene.projectile = disk(60, 1e4, 0, 1);
  scene.target = disk(90, 2e3, 0, 2);
  scene.contact = paper_contact();
  scene.contact.sides = "two";
  scene.launch.at = 0.1;
  scene.launch.spin = 0.02;
  scene.integration.step = 1e-3;
  for (const auto& [field, value] :
       {std::pair{&Launch::psi1, 1.5}, {&Launch::angle, 40.0}, {&Launch::tangential_speed, 0.08}}) {
    Scene some = scene;
    some.launch.*field = value;
    if (field == &Launch::tangential_speed) some.launch.normal_speed = 0.06;
    const Outcome left = impact(seen_from(some, 1)), right = impact(seen_from(some, -1));
    REQUIRE((left.status == Status::finished && right.status == Status::finished));
    int signed_columns = 0;
    for (const auto& [column, of] : Outcome::fields()) {
      if (column.name == "energy_closure" || column.name == "energy_drift" || column.name == "momentum_residual")
        continue;  // rounding, or nearly
      const bool odd = turns_in_mirror(column.name);
      signed_columns += odd;
      const double one = of(left), other = odd ? -of(right) : of(right);
      INFO(column.name << ": " << one << " and " << other);
      CHECK(((std::isnan(one) && std::isnan(other)) || std::abs(one - other) < 1e-6 * std::max(1.0, std::abs(one))));
      if (odd) CHECK(one != 0);
    }
    CHECK(signed_columns == 10);
  }
}

TEST_CASE("an angle of -90 degrees has no normal speed") {
  Launch launch;
  launch.angle = -90;
  CHECK((launch.velocity() == Vec2(-0.1, 0)));
}
