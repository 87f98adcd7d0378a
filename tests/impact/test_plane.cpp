// The rigid plane, and rigid bodies: what walls of springs tend to as they grow stiff and heavy.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "contact/contacts.hpp"
#include "core/error.hpp"
#include "impact/launch/launch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

std::shared_ptr<const Body> plane() {
  Body body;
  body.plane = Plane{};
  return std::make_shared<Body>(body);
}

Scene on_plane(int nodes, double speed, double xi) {
  Scene scene = paper_scene();
  scene.projectile = disk(nodes, 1e4, 0, 1);
  scene.target = plane();
  scene.launch.speed = speed;
  scene.contact.xi = xi;
  scene.contact.reach = 30 / xi;
  scene.contact.V0 = nodes * speed * speed;
  return scene;
}

/// A wall whose top has seven segments: the disk lands on the middle of one. Above the end of a segment the next one
/// pushes as well, which holds a node ln 2 / xi higher and is felt by e, however stiff the wall (up to 0.006 at xi =
/// 1000).
Scene on_wall(const Scene& of_plane, double heavier) {
  Scene scene = of_plane;
  Body wall{box(3, 3), numbers(49, 1e4 * heavier, 0, 1), {}, {}};
  wall.numbers.mass = heavier;
  for (const Vec2& p : plan_nodes(wall.outline, wall.numbers, {}).points)
    wall.anchored.push_back(p.y() < -3 + 1e-9 || std::abs(p.x()) > 1.5 - 1e-9);
  scene.target = std::make_shared<Body>(wall);
  return scene;
}

Outcome run(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

}  // namespace

TEST_CASE("walls ever stiffer and heavier tend to the rigid plane", "[.slow]") {
  const double speed = 0.1;
  for (const double xi : {1000.0, 3000.0}) {
    const Scene scene = on_plane(800, speed, xi);
    const Outcome exact = run(scene);
    REQUIRE(exact.status == Status::finished);
    for (const double heavier : {1e3, 1e4, 1e5}) {
      const Outcome o = run(on_wall(scene, heavier));
      fmt::print(
          "xi {:g}, wall {:g} times stiffer and heavier: e {:.6f} (plane {:.6f}), contact time {:.4f} ({:.4f})\n", xi,
          heavier, o.e, exact.e, o.contact_time, exact.contact_time);
      REQUIRE(o.status == Status::finished);
      if (heavier == 1e5) CHECK(std::abs(o.e - exact.e) < 1e-3);
      // The sum over segments holds a node up to ln 2 / xi higher, on the way in and on the way out.
      CHECK(std::abs(o.contact_time - exact.contact_time) <
            2 * std::log(2) / (xi * speed) + 0.005 * exact.contact_time);
    }
  }
}

TEST_CASE("a small disk on a stiff and heavy wall rebounds as from the plane") {
  const Scene scene = on_plane(60, 0.1, 1000);
  const Outcome exact = run(scene), o = run(on_wall(scene, 1e4));
  REQUIRE((exact.status == Status::finished && o.status == Status::finished));
  CHECK(std::abs(o.e - exact.e) < 1e-3);
  CHECK(exact.energy_closure < 1e-6);
  CHECK(exact.after.of(1).vibration == 0);
}

TEST_CASE("the plane's force on a node is minus the slope of its energy, on either side of it") {
  const Scene scene = on_plane(60, 0.1, 300);
  const BuiltSolids solids(scene);
  ExponentialRepulsion law = scene.contact;
  Motions<1> bodies{at_rest<1>(solids[0]), at_rest<1>(solids[1])};
  for (int i = 0; i < solids[0].nodes(); ++i) bodies[0].q.add(i, 0, {0, 0.98});  // its lowest nodes stand inside
  Contacts<1> contacts(Solids(solids), {});
  contacts.set(0, &law);
  std::vector<Lane<1>> energy(1);
  contacts.push(bodies, energy);
  int inside = 0;
  for (const int node : surface_nodes(solids[0].surface)) {
    const double y = bodies[0].q.at(node, 0).y(), force = bodies[0].f.at(node, 0).y();
    const double expected = y < law.reach ? law.xi * law.V0 * std::exp(-law.xi * y) : 0;
    CHECK(force == Catch::Detail::Approx(expected).epsilon(1e-13));
    inside += y < 0;
  }
  CHECK(inside > 1);
  CHECK(contacts.energy(bodies)[0] == energy[0][0]);
}

TEST_CASE("friction on a plane turns a sliding disk forwards, and books what it takes") {
  Scene scene = on_plane(60, 0.1, 300);
  scene.launch.psi1 = 1;
  scene.effects = {Friction{0.3, 1}};
  const Outcome o = run(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.omega < -0.01);
  CHECK(o.effect_energy[Effect(Friction{}).index()] > 0);
  CHECK(o.energy_closure < 1e-3);
}

TEST_CASE("a rigid body holds still under an impact, and only as a target") {
  Scene scene = small_scene(1, 1, 0);
  Body rigid = *scene.target;
  rigid.numbers.interior = "rigid";
  rigid.anchored.clear();
  scene.target = std::make_shared<Body>(rigid);
  const Outcome o = run(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.after.of(1).vibration == 0);
  CHECK(o.energy_closure < 1e-4);
  Scene held = small_scene(1, 1, 0);
  Body wall = *held.target;
  std::fill(wall.anchored.begin(), wall.anchored.end(), true);
  held.target = std::make_shared<Body>(wall);
  const Outcome of_springs = run(held);
  CHECK(o.e == Catch::Detail::Approx(of_springs.e).epsilon(1e-3));  // all its nodes held
  std::swap(scene.projectile, scene.target);
  CHECK_THROWS_WITH(run(scene), Catch::Matchers::Contains("nothing of this body moves"));
}

TEST_CASE(
    "what moves along a smooth plane changes nothing of a rebound from it: not e, not the step, not whether it is "
    "seen") {
  Scene scene = on_plane(60, 0.05, 300);
  scene.contact = ExponentialRepulsion{};
  const Outcome head_on = run(scene);
  for (const double psi1 : {1.0, 1000.0}) {
    scene.launch.speed = not_given;
    scene.launch.normal_speed = 0.05;
    scene.launch.psi1 = psi1;
    const Outcome o = run(scene);
    INFO(o.reason);
    REQUIRE(o.status == Status::finished);
    CHECK(o.step == head_on.step);
    CHECK(o.e == Catch::Detail::Approx(head_on.e).epsilon(1e-7));
    CHECK(o.vt == Catch::Detail::Approx(psi1 * 0.05).epsilon(1e-9));
  }
}

TEST_CASE("adhesion to a plane is minus the slope of its energy, above it and inside") {
  const Adhesion law{0.5, 200};
  const ExponentialRepulsion repulsion = paper_contact();
  const Plane plane;
  for (const double y : {0.01, -0.003}) {
    Gaps gaps, bare;
    for (Gaps* g : {&gaps, &bare}) {
      g->resize(1);
      g->px[0] = 0.3;
      g->py[0] = y;
    }
    measure(gaps, repulsion, {law}, &plane);
    measure(bare, repulsion, {}, &plane);
    CHECK(gaps.fy[0] - bare.fy[0] == Catch::Detail::Approx(law.force(y)).epsilon(1e-12));
  }
}

TEST_CASE("a start at which many nodes together show is refused by its height") {
  Scene scene = on_plane(60, 0.1, 300);
  scene.contact = paper_contact();
  scene.projectile =
      std::make_shared<Body>(Body{{{-2, 0}, {2, 0}, {2, 0.5}, {-2, 0.5}}, numbers(300, 1e4, 0, 1), {}, {}});
  scene.launch.height = 0.0625;
  CHECK_THROWS_WITH(run(scene), Catch::Matchers::Contains("all nodes that stand near"));
}

TEST_CASE("an effect on what a rigid target has not is refused by its name") {
  const auto refused = [](Effect effect, const char* words) {
    Scene scene = on_plane(60, 0.1, 300);
    scene.effects = {std::move(effect)};
    CHECK_THROWS_WITH(run(scene), Catch::Matchers::Contains(words));
  };
  refused(Absorbing{0.5, 2}, "absorbing acts on what moves inside a body");
  refused(Plastic{0.1, 0, "target"}, "plastic acts on springs, and the target is rigid");
  refused(MovingAnchor{0.01, 1, 0, "normal"}, "a plane has none");
}
