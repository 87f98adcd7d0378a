// A sweep that threads share has the bits of one thread's.

#include <catch2/catch.hpp>
#include <set>

#include "body/interior.hpp"
#include "impact/launch/launch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

// Vibrating, and pushed by something at every node.
Motion<1> moving(const Solid& solid) {
  Motion<1> body = at_rest<1>(solid);
  body.stiffness.setConstant(300);
  for (int i = 0; i < solid.nodes(); ++i) {
    if (i < solid.free) body.v.set(i, 0, 1e-2 * Vec2(std::sin(7.0 * i), std::cos(5.0 * i)));
    body.f.set(i, 0, 1e-1 * Vec2(std::cos(3.0 * i), std::sin(2.0 * i)));
  }
  return body;
}

std::vector<double> numbers_of(const Motion<1>& body) {
  std::vector<double> all;
  for (const Coordinates<1>* values : {&body.q, &body.v, &body.f})
    for (int c = 0; c < values->size(); ++c) all.push_back((*values)[c][0]);
  return all;
}

std::vector<Body> kinds() {
  std::vector<Body> all{*disk(300, 100, 0.03, 1), *wall(700, 100, 0.03, 2, 4, 2)};
  Body linear = *disk(200, 100, 0, 3);
  linear.numbers.quartic = 0;
  linear.numbers.prestress = 0.05;
  all.push_back(linear);
  Body uneven = *disk(250, 100, 0.02, 4);
  uneven.numbers.mass = not_given;
  uneven.numbers.density = 200;
  for (int i = 0; i < 250; ++i) uneven.node_stiffness.push_back(100 + i % 7);
  all.push_back(uneven);
  for (const char* law : {"polynomial", "linear", "st_venant_kirchhoff"})
    all.push_back(Body{circle(), element_numbers(300, 100, 0.3, law), {}, {}});
  Body of_places{circle(), element_numbers(300, 100, 0.3), {}, {}};
  for (int i = 0; i < 300; ++i) of_places.node_nu.push_back(0.05 * (i % 9));
  all.push_back(of_places);
  Body rings{half_circle(), element_numbers(250, 100, 0.3), {}, {}};
  rings.numbers.state = "axisymmetric";
  rings.numbers.density = 200;
  all.push_back(rings);
  return all;
}

}  // namespace

TEST_CASE("shares hold every node and every member once") {
  for (const Body& kind : kinds()) {
    const auto solid = build_solid(kind);
    for (const int parts : {1, 2, 3, 7}) {
      Team team(parts);
      const Sharing sharing = sharing_of(*solid, team);
      REQUIRE(sharing.shares.size() == static_cast<std::size_t>(parts));
      int next = 0;
      for (const Share& share : sharing.shares) {
        CHECK(share.begin == next);
        CHECK((share.begin <= share.crossing && share.crossing <= share.end));
        CHECK(std::is_sorted(share.from_before.begin(), share.from_before.end()));
        next = share.end;
      }
      CHECK(next == solid->free);
      CHECK(sharing.shares.back().limit == solid->nodes());
    }
  }
}

TEST_CASE("a sweep that threads share has the bits of one thread's") {
  for (const Body& kind : kinds()) {
    const auto solid = build_solid(kind);
    for (const int parts : {2, 3, 5}) {
      Team team(parts);
      const Sharing sharing = sharing_of(*solid, team);
      Motion<1> alone = moving(*solid), together = alone;
      together.sharing = &sharing;
      for (int step = 0; step < 20; ++step)
        for (Motion<1>* body : {&alone, &together}) {
          kick_and_drift(*body, Lane<1>::Constant(1e-2), Lane<1>::Constant(1.5e-2));
          body->f.add(step, 0, Vec2(0.1, -0.2));
        }
      INFO(parts << " threads, " << kind.numbers.nodes << " nodes");
      CHECK(numbers_of(alone) == numbers_of(together));
      CHECK(alone.q.at(0, 0) != moving(*solid).q.at(0, 0));
    }
  }
}

TEST_CASE("the outcome of one large impact has the same bits on any number of threads") {
  Scene scene = paper_scene();
  scene.projectile = disk(sanitized ? 17'000 : 20'000, 1e4, 0.003, 1);
  scene.target = wall(20'000, 100, 0.003, 1);
  scene.ending.at = "time";
  const std::atomic<bool> go_on{false};
  const BuiltSolids solids(scene);
  REQUIRE((worth_sharing(solids[0]) && worth_sharing(solids[1])));
  for (const char* method : {"verlet", "multirate_3", "rk4"}) {
    scene.integration.method = method;
    const Start start = launch(scene, solids);
    scene.ending.time = 200 * start.step;
    const Outcome alone = run_scene(solids, scene, go_on);
    CHECK(exact_text(alone) == exact_text(run_scene(solids, scene, go_on, nullptr, 3)));
  }
}
