// Nodes are resolution alone: the body that they stand for is the same.

#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Detail::Approx;

namespace {

const std::atomic<bool> go_on{false};

std::shared_ptr<const Body> smooth_disk(int nodes, const std::string& placement, int seed) {
  BodyNumbers of;
  of.nodes = nodes;
  of.placement = placement;
  of.seed = seed;
  return std::make_shared<Body>(Body{circle(1, 2000), of, {}, {}});
}

std::shared_ptr<const Body> plane_body() {
  auto body = std::make_shared<Body>();
  body->plane = Plane{};
  return body;
}

Outcome on_plane(int nodes, const std::string& placement, int seed, double speed, double xi = not_given) {
  Scene scene;
  scene.projectile = smooth_disk(nodes, placement, seed);
  scene.target = plane_body();
  scene.launch.speed = speed;
  scene.contact.xi = xi;
  return run_scene(BuiltSolids(scene), scene, go_on);
}

}  // namespace

TEST_CASE("a body's mass and moment of inertia are its area's, however many nodes it has") {
  for (const char* placement : {"triangular", "poisson_disk"})
    for (const int nodes : {400, 1600}) {
      const auto solid = build_solid(*smooth_disk(nodes, placement, 1));
      INFO(placement << " " << nodes);
      CHECK(solid->total_mass() == Approx(800).epsilon(0.01));
      CHECK(solid->inertia() / solid->total_mass() == Approx(0.5).epsilon(0.01));
    }
}

TEST_CASE("a density may depend on the place, and a mass of every node is no density") {
  Body body = *smooth_disk(400, "poisson_disk", 1);
  const double plain = build_solid(body)->total_mass();
  body.node_density.assign(400, 2 * usual_density);
  CHECK(build_solid(body)->total_mass() == Approx(2 * plain));
  body.node_density.clear();
  body.numbers.mass = 3;
  CHECK(build_solid(body)->total_mass() == Approx(1200));
  CHECK(build_solid(body)->mass.uniform());
}

TEST_CASE("contact time and e of a smooth disk do not follow the number of its nodes") {
  for (const char* placement : {"triangular", "poisson_disk"}) {
    double e = 0, time = 0;  // of 3200 nodes
    for (const int seed : {1, 2}) {
      const Outcome fine = on_plane(3200, placement, seed, 0.2);
      e += fine.e / 2;
      time += fine.contact_time / 2;
    }
    for (const int nodes : {400, 800, 1600})
      for (const int seed : {1, 2}) {
        const Outcome o = on_plane(nodes, placement, seed, 0.2);
        INFO(placement << " " << nodes << " " << seed);
        CHECK(o.e == Approx(e).epsilon(0.03));
        CHECK(o.contact_time == Approx(time).epsilon(0.03));
      }
  }
}

// The contact time by the rule is 6 to 8 % longer than that of a hard contact: the force that counts begins ln(1000)/xi
// before the outlines meet.
TEST_CASE("e by the rule is that of a hard contact to 1 %, in twenty scenes", "[.slow]") {
  for (const int nodes : {800, 6400})
    for (const double speed : {0.01, 0.02, 0.05, 0.1, 0.3})
      for (const char* placement : {"triangular", "poisson_disk"}) {
        const Outcome o = on_plane(nodes, placement, 1, speed);
        const Outcome hard = on_plane(nodes, placement, 1, speed, 16 * o.xi);
        INFO(placement << " " << nodes << " " << speed << " c");
        CHECK(o.e == Approx(hard.e).epsilon(0.01));
        CHECK(o.contact_time == Approx(hard.contact_time).epsilon(0.1));
      }
}
