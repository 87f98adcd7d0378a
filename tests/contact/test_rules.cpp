// Which segments push a node, by contact.rule.
#include <catch2/catch.hpp>
#include <cmath>

#include "contact/contacts.hpp"
#include "core/rng.hpp"
#include "scenes.hpp"
#include "shape/closest.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// A disk over a wall, both rough, and the forces of a contact between them.
struct Pose {
  std::shared_ptr<const Solid> disk = build_solid(*test::disk(60, 1e4, 0.03, 1)),
                               wall = build_solid(*test::wall(150, 100, 0.03, 1));
  Motions<1> bodies{at_rest<1>(*disk), at_rest<1>(*wall)};
  Contacts<1> contact{{disk.get(), wall.get()}, {}};

  void push(const ExponentialRepulsion& law, const Vec2& shift) {
    bodies = {at_rest<1>(*disk), at_rest<1>(*wall)};
    for (int i = 0; i < disk->nodes(); ++i) bodies[0].q.add(i, 0, shift);
    contact.set(0, &law);
    std::vector<Lane<1>> energy(1);
    contact.push(bodies, energy);
  }

  Vec2 force_on_disk() const {
    Vec2 sum = Vec2::Zero();
    for (int i = 0; i < disk->nodes(); ++i) sum += bodies[0].f.at(i, 0);
    return sum;
  }
};

/// The segment of the wall that is nearest to p, the first of equals.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  Vec2 away = Vec2::Zero(), normal = Vec2::Zero();
};
Nearest nearest_to(const Vec2& p, const Solid& wall) {
  const auto& mesh = std::get<Mesh<2>>(wall.surface);
  Nearest nearest;
  for (const auto& [from, to] : mesh.cell) {
    const Vec2 &a = wall.points[mesh.node[from]], &b = wall.points[mesh.node[to]];
    const Closest c = closest(p, a, b);
    if (!(c.distance < nearest.distance - 1e-11)) continue;
    nearest = {c.distance, c.away, Vec2((b - a).y(), -(b - a).x()).normalized()};
  }
  return nearest;
}

const std::atomic<bool> go_on{false};

Scene at_rule(const std::string& rule, int seed, double step) {
  Scene scene = small_scene(seed, 1, 0.1);
  scene.contact.sides = "two";
  scene.contact.rule = rule;
  scene.integration.method = "pefrl";
  scene.integration.energy_tolerance = 10;
  scene.integration.step = step;
  return scene;
}

Outcome outcome_of(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

double energy_lost(const std::string& rule, int seed, double step) {
  const Outcome o = outcome_of(at_rule(rule, seed, step));
  INFO(rule << " " << seed << " " << o.reason);
  REQUIRE(o.status == Status::finished);
  return o.energy_closure;
}

}  // namespace

TEST_CASE("by the nearest segment a node is pushed as its distance says, away from it or along its normal") {
  Pose pose;
  Random random(3, 3);
  for (const char* rule : {"nearest", "spring_normal"}) {
    ExponentialRepulsion law = paper_contact();
    law.rule = rule;
    int pushed = 0;
    for (int place = 0; place < 40; ++place) {
      const Vec2 shift(random.uniform(-1, 1), 1.05 + random.uniform(-0.03, 0.03));
      pose.push(law, shift);
      Vec2 on_wall = Vec2::Zero();
      for (int i = 0; i < pose.wall->nodes(); ++i) on_wall += pose.bodies[1].f.at(i, 0);
      CHECK((pose.force_on_disk() + on_wall).norm() < 1e-12 * std::max(1.0, on_wall.norm()));
      double energy = 0;
      for (const int node : surface_nodes(pose.disk->surface)) {
        const Nearest nearest = nearest_to(pose.bodies[0].q.at(node, 0), *pose.wall);
        const bool within = nearest.distance < law.reach;
        energy += within ? law.energy(nearest.distance) : 0;
        const Vec2 along = std::string(rule) == "nearest" ? Vec2(nearest.away / nearest.distance) : nearest.normal;
        const Vec2 expected = (within ? law.force(nearest.distance) : 0.0) * along;
        CHECK((pose.bodies[0].f.at(node, 0) - expected).norm() <= 1e-9 * expected.norm());
        pushed += within;
      }
      CHECK(pose.contact.energy(pose.bodies)[0] == Catch::Detail::Approx(energy).epsilon(1e-12));
    }
    CHECK(pushed > 100);
  }
}

TEST_CASE("the work of a contact around a closed path is none by the sum, and some along the springs' normals") {
  Pose pose;
  const auto work_around = [&](const std::string& rule) {
    ExponentialRepulsion law = paper_contact();
    law.rule = rule;
    constexpr int steps = 2000;
    double work = 0;
    Vec2 before, force_before;
    for (int k = 0; k <= steps; ++k) {  // a circle close to the wall, in which nothing crosses
      const double angle = 2 * std::numbers::pi * k / steps;
      const Vec2 shift(0.1 * std::cos(angle), 1.16 + 0.02 * std::sin(angle));
      pose.push(law, shift);
      const Vec2 force = pose.force_on_disk();
      if (k > 0) work += (force + force_before).dot(shift - before) / 2;
      before = shift;
      force_before = force;
    }
    return std::abs(work);
  };
  const double sum = work_around("sum"), normal = work_around("spring_normal");
  INFO(sum << " " << normal);
  CHECK(sum < 1e-4 * normal);
  CHECK(normal > 1e-2);  // m0 c^2: a disk at 0.1 c has 0.3
}

TEST_CASE("impacts gain or lose energy along the springs' normals, whatever the step") {
  double sum = 0, nearest = 0, normal = 0, finer = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    sum = std::max(sum, std::abs(energy_lost("sum", seed, 1e-3)));
    nearest = std::max(nearest, std::abs(energy_lost("nearest", seed, 1e-3)));
    normal = std::max(normal, std::abs(energy_lost("spring_normal", seed, 1e-3)));
    finer = std::max(finer, std::abs(energy_lost("spring_normal", seed, 5e-4)));
  }
  INFO(sum << " " << nearest << " " << normal << " " << finer);
  CHECK(nearest > 10 * sum);  // of the step alone, whose order the kinks take
  CHECK(normal > 1e-3);       // of the law
  CHECK(finer > normal / 2);
}

TEST_CASE("a scene tells its rule where it is not the sum, and no other than the sum certifies") {
  Scene scene = small_scene();
  const std::string usual = scene.text();
  CHECK(usual.find("rule") == std::string::npos);
  scene.contact.rule = "nearest";
  CHECK_THAT(scene.text(), Catch::Matchers::Contains("contact.rule = nearest\n"));
  CHECK(scene.hash() != small_scene().hash());
  scene.contact = {150, 300, 0.1, "two"};
  CHECK(outcome_of(scene).certified == 1);
  scene.contact.rule = "spring_normal";
  scene.integration.energy_tolerance = 10;
  CHECK(outcome_of(scene).certified == 0);
}
