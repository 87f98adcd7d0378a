// Impacts of spheres of elements, against Hertz, against another program of finite elements, and among themselves.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "contact/point_contact.hpp"
#include "core/error.hpp"
#include "impact/estimate.hpp"
#include "record/film.hpp"
#include "same_bits.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

/// c0 = sqrt(E/rho) of E = 1e4 and the usual density.
const double c0 = std::sqrt(1e4 / usual_density);

Body sphere(double nu, double h_min, const std::string& law = "polynomial", double h_max = 0.12) {
  Body ball{half_circle(1, 4000), element_numbers(0, 1e4, nu, law), {}, {}};
  ball.numbers.state = "axisymmetric";
  ball.numbers.h_min = h_min;
  ball.numbers.h_max = h_max;
  return ball;
}

Body plane() {
  Body body;
  body.plane = Plane{};
  return body;
}

/// Speed in c0.
Scene scene_of(const Body& projectile, const Body& target, double speed) {
  Scene scene;
  scene.projectile = std::make_shared<Body>(projectile);
  scene.target = std::make_shared<Body>(target);
  scene.launch.speed = speed * c0;
  return scene;
}

Outcome run(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

/// What an impact shows at its greatest compression, over what Hertz says of it.
struct BesideHertz {
  double force, approach, time, closure;
};

BesideHertz beside_hertz(const Scene& scene) {
  const BuiltSolids built(scene);
  const Estimate hertz = estimate(scene);
  REQUIRE(hertz.no_law.empty());
  const Course course = follow_course(built, scene, go_on);
  const Outcome& o = course.outcome;
  REQUIRE(o.status == Status::finished);
  double most = 0;
  std::vector<double> times;
  for (int k = -200; k <= 200; ++k) times.push_back(course.tightest + hertz.impact.time * k / 2000);
  film_scene(built, scene, {}, go_on, {},
             {times, [&](const Sample& sample) { most = std::max(most, sample.force.y()); }});
  const BesideHertz beside{most / hertz.impact.force, o.overlap / hertz.impact.approach,
                           o.contact_time / hertz.impact.time, o.energy_closure};
  fmt::print("v {:g} c0: force {:.4f}, depth {:.4f}, time {:.4f} of Hertz's; 1 - e {:.3e}; closure {:.1e}; {} steps\n",
             scene.launch.speed / c0, beside.force, beside.approach, beside.time, 1 - o.e, o.energy_closure, o.steps);
  return beside;
}

}  // namespace

TEST_CASE("a slow sphere meets a rigid plane as Hertz says") {
  // 1e-4 c0: the contact's radius is 0.03 R, so that the sphere's finite size shows little.
  const BesideHertz beside = beside_hertz(scene_of(sphere(0.3, 0.005), plane(), 1e-4));
  CHECK(std::abs(beside.force - 1) < 0.015);
  CHECK(std::abs(beside.approach - 1) < 0.04);
  CHECK(std::abs(beside.time - 1) < 0.04);
  CHECK(beside.closure < 1e-5);
}

TEST_CASE("a sphere is stressed most where Hertz says: 0.48 a below its surface, by 0.62 of the contact's pressure") {
  // nu = 0.3: von Mises 0.62 p0 at 0.48 a, pressure (2/3)(1 + nu) p0 in the middle of the surface. [Johnson 1985, 3.4]
  const double h = 0.012;
  const Scene scene = scene_of(sphere(0.3, h), plane(), 1e-3);
  const BuiltSolids built(scene);
  const Estimate hertz = estimate(scene);
  const Course course = follow_course(built, scene, go_on);
  std::vector<Sample> samples;
  film_scene(built, scene, {}, go_on, {},
             {{0, course.tightest}, [&](const Sample& sample) { samples.push_back(sample); }});
  REQUIRE(samples.size() == 2);
  const double a = hertz.impact.half_width;
  const GreatestStress before = samples[0].projectile.stress, most = samples[1].projectile.stress;
  CAPTURE(a, most.von_mises_depth / a, most.von_mises / hertz.impact.pressure, most.pressure / hertz.impact.pressure);
  CHECK(std::abs(most.von_mises_depth - 0.48 * a) < h);
  CHECK(most.von_mises == Catch::Detail::Approx(0.62 * hertz.impact.pressure).epsilon(0.05));
  CHECK(most.pressure == Catch::Detail::Approx(2.0 / 3 * 1.3 * hertz.impact.pressure).epsilon(0.1));
  CHECK(before.von_mises < 1e-3 * most.von_mises);
  CHECK(std::isnan(samples[1].target.stress.von_mises));
}

TEST_CASE("the magnesium sphere of Chung and Ooi's test 2 meets a rigid plane as Hertz says", "[.slow]") {
  // 0.2 m/s of sqrt(40 GPa/1800 kg/m^3).
  const BesideHertz beside = beside_hertz(scene_of(sphere(0.35, 0.004), plane(), 4.2426e-5));
  CHECK(std::abs(beside.force - 1) < 0.015);
  CHECK(std::abs(beside.approach - 1) < 0.04);
  CHECK(std::abs(beside.time - 1) < 0.04);
}

TEST_CASE("waves take of a sphere's rebound what another program of finite elements says") {
  // 1 - e at 0.01 c0, nu = 0.3, within 10 %.
  const Outcome o = run(scene_of(sphere(0.3, 0.02), plane(), 0.01));
  REQUIRE(o.status == Status::finished);
  CHECK(1 - o.e == Catch::Detail::Approx(1.39e-3).epsilon(0.1));
  CHECK(o.energy_closure < 1e-5);
  CHECK(o.inverted == 0);
}

TEST_CASE("two equal spheres meet as one does a rigid plane at half of their speed") {
  Body target = sphere(0.3, 0.02);
  for (Vec2& p : target.outline) p.y() -= 3;
  target.fine_at = Vec2(0, -2);
  Scene pair = scene_of(sphere(0.3, 0.02), target, 0.01);
  const Outcome two = run(pair), one = run(scene_of(sphere(0.3, 0.02), plane(), 0.005));
  REQUIRE(two.status == Status::finished);
  REQUIRE(one.status == Status::finished);
  CHECK(two.e_n == Catch::Detail::Approx(two.e).epsilon(1e-9));
  CHECK(1 - two.e == Catch::Detail::Approx(1 - one.e).epsilon(0.15));
  CHECK(two.contact_time == Catch::Detail::Approx(one.contact_time).epsilon(0.01));
  CHECK(two.contact_length == Catch::Detail::Approx(one.contact_length).epsilon(0.1));
  CHECK(two.momentum_residual < 1e-9);
  CHECK(two.energy_closure < 1e-5);
  CHECK(std::abs(two.target_vn + (1 + two.e) / 2 * 0.01 * c0) < 1e-4 * c0);
}

TEST_CASE("an axisymmetric block that is held below keeps its ledger under a sphere, with gravity, drag and a sponge") {
  Body block{{{0, -2}, {2, -2}, {2, 0}, {0, 0}}, element_numbers(300, 400, 0.2), {}, {}};
  block.numbers.state = "axisymmetric";
  for (const Vec2& p : ricochet::plan_nodes(block, {}).points) block.anchored.push_back(p.y() < -2 + 1e-9);
  Scene scene = scene_of(sphere(0.3, 0.1), block, 0.02);
  const Outcome bare = run(scene);
  REQUIRE(bare.status == Status::finished);
  CHECK(bare.energy_closure < 1e-6);
  CHECK(bare.e < 0.9);
  scene.effects = {Gravity{1e-4, "both"}, Drag{1e-3, "both"}, Absorbing{0.5, 1}};
  const Outcome o = run(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.energy_closure < 1e-3);
}

TEST_CASE("every method moves a sphere to the same rebound, and multirate is refused by name") {
  Scene scene = scene_of(sphere(0.3, 0.05), plane(), 0.05);
  scene.integration.method = "blanes_moan_srkn14a";
  const double exact = run(scene).e;
  for (const Method& method : methods()) {
    CAPTURE(method.name);
    scene.integration.method = method.name;
    if (method.multirate()) {
      CHECK_THROWS_WITH(run(scene), Catch::Matchers::Contains("knows no axis that nodes cannot leave"));
      continue;
    }
    const Outcome o = run(scene);
    REQUIRE(o.status == Status::finished);
    CHECK(std::abs(o.e - exact) < 1e-3);
    CHECK(o.energy_closure < (method.symplectic() ? 1e-3 : 1e-2));
  }
}

TEST_CASE("impacts of spheres have the same bits alone, in lanes and on threads") {
  std::vector<Scene> list;
  for (const double speed : {0.01, 0.02, 0.03, 0.05, 0.08}) list.push_back(scene_of(sphere(0.3, 0.1), plane(), speed));
  const std::vector<std::string> alone = exact_texts(list, 1, 1);
  for (const int batch : {2, 3, 4}) CHECK(exact_texts(list, 2, batch) == alone);
}

TEST_CASE("1 - e of a sphere rises with its speed as another program of finite elements says", "[.slow]") {
  // Of linear elements, and of a logarithmic neo-Hookean law, which the polynomial one is like as long as it is
  // strained little.
  struct Known {
    const char* law;
    double speed, lost;
  };
  for (const auto& [law, speed, lost] :
       {Known{"linear", 0.003, 3.3e-4}, Known{"linear", 0.01, 1.26e-3}, Known{"linear", 0.03, 4.07e-3},
        Known{"polynomial", 0.003, 3.5e-4}, Known{"polynomial", 0.01, 1.30e-3}}) {
    const Outcome o = run(scene_of(sphere(0.3, 0.01, law), plane(), speed));
    fmt::print("{} at {:g} c0: 1 - e {:.3e} ({:.3e}), closure {:.1e}\n", law, speed, 1 - o.e, lost, o.energy_closure);
    CHECK(1 - o.e == Catch::Detail::Approx(lost).epsilon(0.1));
  }
}
