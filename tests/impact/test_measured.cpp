// What a row says of an impact: along the contact's own normal, at its first parting, and where it did not finish.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "impact/batch.hpp"
#include "impact/roles.hpp"
#include "impact/watch/parting.hpp"
#include "impact/watch/smooth_outline.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

Outcome outcome_of(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

std::shared_ptr<const Body> plane() {
  Body body;
  body.plane = Plane{};
  return std::make_shared<Body>(body);
}

std::shared_ptr<const Body> of_outline(const Points& outline, int nodes, int seed) {
  return std::make_shared<Body>(Body{outline, numbers(nodes, 1e4, 0, seed), {}, {}});
}

Points turned_square(double degrees) {
  const Turn turn(degrees * std::numbers::pi / 180);
  Points square{{-0.7, -0.7}, {0.7, -0.7}, {0.7, 0.7}, {-0.7, 0.7}};
  for (Vec2& p : square) p = turn(p);
  return square;
}

/// A smooth disk whose rim's nodes lie turned at random.
std::shared_ptr<const Body> turned_disk(int nodes, int seed) {
  const Turn turn(0.7548776662 * seed);
  Points outline = circle();
  for (Vec2& p : outline) p = turn(p);
  return of_outline(outline, nodes, seed);
}

/// Two free, smooth, equal disks off centre.
Scene two_disks(int nodes, int seed, double at) {
  Scene scene;
  scene.projectile = turned_disk(nodes, 2 * seed);
  scene.target = turned_disk(nodes, 2 * seed + 1);
  scene.launch.at = at;
  return scene;
}

struct Statistics {
  double mean = 0, square = 0, least = 1e300, most = -1e300;
  int count = 0;

  void add(double value) {
    ++count;
    const double off = value - mean;
    mean += off / count;
    square += off * (value - mean);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double deviation() const { return std::sqrt(square / (count - 1)); }
};

struct Rebounds {
  Statistics e_n, mu_n;
};

Rebounds rebounds_of(int nodes, int pairs, double at) {
  Rebounds rebounds;
  for (int seed = 1; seed <= pairs; ++seed) {
    const Outcome o = outcome_of(two_disks(nodes, seed, at));
    INFO(nodes << " nodes, pair " << seed << ": " << o.reason);
    REQUIRE(o.status == Status::finished);
    rebounds.e_n.add(o.e_n);
    rebounds.mu_n.add(o.mu_n);
  }
  return rebounds;
}

/// Prints a row of a table for each offset.
void check_off_centre(int nodes, int pairs, double e_margin, double mu_margin) {
  const int rim = static_cast<int>(surface_nodes(build_solid(*turned_disk(nodes, 1))->surface).size());
  const double head_on = rebounds_of(nodes, pairs, 0).e_n.mean;
  for (const double at : {0.0, 0.3, 0.6, 0.85}) {
    const auto [e_n, mu_n] = rebounds_of(nodes, pairs, at);
    fmt::print("| {} | {} | {:.2f} | {:.4f} | {:.4f} | {:.4f} to {:.4f} | {:.4f} | {:.4f} |\n", nodes, rim, at,
               e_n.mean, e_n.deviation(), e_n.least, e_n.most, mu_n.mean, mu_n.deviation());
    CHECK(std::abs(e_n.mean - head_on) < e_margin);
    CHECK(mu_n.mean < mu_margin);
  }
}

}  // namespace

TEST_CASE("on a flat wall or plane the contact's normal is y, and e_n is e to the bit") {
  for (const double roughness : {0.0, 0.03})
    for (const double psi1 : {0.0, 2.0}) {
      Scene scene = small_scene(3, psi1, roughness);
      scene.launch.spin = roughness > 0 ? 0.1 : 0.01;  // on the sides of a smooth rim a disk would roll
      for (const bool on_plane : {false, true}) {
        if (on_plane) scene.target = plane();
        const Outcome o = outcome_of(scene);
        REQUIRE(o.status == Status::finished);
        CHECK(o.normal_x == 0);
        CHECK(o.normal_y == 1);
        CHECK(o.e_n == o.e);
        CHECK(o.mu_n == o.mu);
        CHECK(o.beta_n == Catch::Detail::Approx(o.beta).epsilon(1e-12));
      }
    }
}

TEST_CASE("where a smooth rim's sides decide how fast bodies meet, e_n is undefined, and the row says why") {
  Scene scene = small_scene(3, 0, 0);
  const Outcome head_on = outcome_of(scene);
  CHECK(std::isfinite(head_on.e_n));
  CHECK(head_on.reason == "");
  // A disk of 25 sides that rolls, twice as fast as it falls; one that slides over the nodes of a wall.
  Scene rolls = scene, slides = scene;
  rolls.launch.spin = 0.2;
  slides.launch.psi1 = 10;
  for (const Scene& uneven : {rolls, slides}) {
    const Outcome o = outcome_of(uneven);
    REQUIRE(o.status == Status::finished);
    CHECK(std::isnan(o.e_n));
    CHECK_THAT(o.reason, Catch::Matchers::Contains("the sides of the rims"));
    for (const double kept : {o.e, o.mu_n, o.beta_n}) CHECK(std::isfinite(kept));
  }
  // The slopes of a rough rim are the surface; and a plane has none.
  for (Scene rough : {small_scene(3, 10, 0.03), small_scene(3, 2, 0.03)}) {
    rough.launch.spin = 0.2;
    const Outcome o = outcome_of(rough);
    CHECK(o.e_n == o.e);
    CHECK(o.reason == "");
  }
  slides.target = plane();
  CHECK(std::isfinite(outcome_of(slides).e_n));
}

TEST_CASE("disks off centre rebound along the line of centres as head on, and without friction") {
  check_off_centre(100, 6, 0.03, 0.05);
}

TEST_CASE("disks off centre rebound along the line of centres as head on: 20 pairs, against the rim's nodes",
          "[.slow][.table]") {
  fmt::print("| nodes | of a rim | offset | e_n | its deviation | range | mu_n | its deviation |\n");
  for (const int nodes : {100, 200, 400, 800, 1600}) {
    const bool fine = nodes >= 800;
    check_off_centre(nodes, 20, fine ? 0.02 : 0.03, fine ? 0.03 : 0.05);
  }
}

TEST_CASE("what the paper defines along y is undefined where the normal is another") {
  const Outcome o = outcome_of(two_disks(60, 1, 0.6));
  REQUIRE(o.status == Status::finished);
  CHECK(o.normal_x == Catch::Detail::Approx(0.3).margin(0.06));
  CHECK(std::hypot(o.normal_x, o.normal_y) == Catch::Detail::Approx(1));
  for (const double of_y : {o.e, o.beta, o.mu, o.psi1, o.psi2}) CHECK(std::isnan(of_y));
  for (const double along : {o.e_n, o.mu_n, o.vn, o.vt, o.omega}) CHECK(std::isfinite(along));
}

TEST_CASE("vn and vt are relative to the target, whose own velocities stand beside them") {
  Scene scene = two_disks(60, 1, 0.3);
  Body heavy = *scene.target;
  heavy.numbers.mass = 2;
  scene.target = std::make_shared<Body>(heavy);
  const Outcome o = outcome_of(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.target_vn < -0.01);
  CHECK(o.target_omega != 0);
  CHECK(60 * (o.vn + o.target_vn) + 120 * o.target_vn == Catch::Detail::Approx(-60 * 0.1).epsilon(1e-9));
  CHECK(60 * (o.vt + o.target_vt) + 120 * o.target_vt == Catch::Detail::Approx(0).margin(1e-9));
}

TEST_CASE("a corner has the normal of the side that it meets, on either body") {
  const auto square = build_solid(*of_outline(turned_square(45), 80, 1));
  const auto below = build_solid(*of_outline(box(4, 1), 80, 1));
  REQUIRE(square->corners.size() == 4);
  const SmoothOutline outline(*square), flat(*below);
  CHECK_FALSE(outline.round());
  const Facing corner{Vec2(0, -1), Facing::corner}, side{Vec2(0.6, 0.8), 0}, curved{Vec2(-0.6, -0.8), 1};
  CHECK(normal_between(corner, side) == side.normal);
  CHECK(normal_between({-side.normal, 0}, {Vec2(0, 1), Facing::corner}) == side.normal);
  CHECK(normal_between(curved, side) == side.normal);
  Scene scene;
  scene.projectile = of_outline(turned_square(35), 80, 1);
  scene.target = disk(100, 1e4, 0, 2);
  scene.launch.at = 0.5;
  scene.contact = paper_contact();
  scene.contact.sides = "two";
  const Outcome o = outcome_of(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.normal_x == Catch::Detail::Approx(0.33).margin(0.05));  // the disk's, where the corner lands
}

TEST_CASE("the normal of two circles is the line of centres, wherever beside it they touch") {
  for (const double s : {-0.1, 0.0, 0.07}) {
    const Vec2 down(std::sin(s / 1.0), -std::cos(s / 1.0)), up(std::sin(s / 2.5), std::cos(s / 2.5));
    const Vec2 n = normal_between({down, 1.0}, {up, 1 / 2.5});
    CHECK(n.x() == Catch::Detail::Approx(0).margin(1e-3 * std::abs(s)));
  }
  const auto solid = build_solid(*disk(100, 1e4, 0.03, 1));
  const SmoothOutline outline(*solid);
  CHECK(outline.round());
  for (int place = 0; place < 10; ++place) {
    const int node = std::get<Mesh<2>>(solid->surface).node[static_cast<std::size_t>(place)];
    const Facing facing = outline.at_node(Push{0, node, false, {}, 0, Vec2::Zero(), 0});
    CHECK((facing.normal - solid->smooth[static_cast<std::size_t>(place)].normalized()).norm() < 1e-2);
    CHECK(facing.curvature == Catch::Detail::Approx(1).epsilon(0.02));
  }
}

TEST_CASE("a square that lands on its corner has the restitution of its corner, spin and arm included") {
  Scene scene;
  scene.projectile = of_outline(turned_square(30), 200, 1);
  scene.target = plane();
  scene.contact = {150, 300, 0.1, "one"};
  scene.ending.at = "first_parting";
  const Outcome o = outcome_of(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.normal_x == 0);
  CHECK(o.e < 0.8);  // much of it went into spin
  CHECK(std::abs(o.omega) > 0.01);
  CHECK(o.e_n > 0.8);
  CHECK(o.e_n < 1.001);
}

TEST_CASE("a row that did not finish has no outcome, but the last state") {
  Scene scene = small_scene(1, 1);
  scene.integration.time_limit = 1.5;
  const Outcome o = outcome_of(scene);
  REQUIRE(o.status == Status::out_of_time);
  for (const auto& [field, value] : Outcome::fields()) {
    INFO(field.name);
    const bool course =
        std::set<std::string>{"energy_drift", "inverted", "inversion_time", "folded", "certified",  "time",
                              "step",         "theta",    "theta_most",     "steps",  "error_step", "xi",
                              "V0",           "inertia",  "penetration"}
            .count(field.name) > 0;
    if (course || field.name.rfind("last_", 0) == 0 || field.name.rfind("before_", 0) == 0) continue;
    CHECK(std::isnan(value(o)));
  }
  for (const double last : {o.last_vn, o.last_vt, o.last_omega, o.last_energy}) CHECK(std::isfinite(last));
  CHECK(o.last_energy == Catch::Detail::Approx(o.before.total()).epsilon(1e-4));
  for (const double course : {o.time, o.steps, o.energy_drift, o.inverted, o.penetration}) CHECK(std::isfinite(course));
}

TEST_CASE("a launch along the surface that touches has no e, and nothing infinite") {
  Scene scene = small_scene(5, 0, 0.05);
  scene.launch.psi1 = not_given;
  scene.launch.angle = 90;
  scene.launch.height = 0.1;
  const Outcome o = outcome_of(scene);
  INFO(name_of(o.status) << " " << o.reason);
  CHECK(std::isnan(o.e));
  CHECK(std::isnan(o.psi1));
  for (const auto& [field, value] : Outcome::fields()) CHECK_FALSE(std::isinf(value(o)));
}

TEST_CASE("an asperity that touches before the others is no parting: the bodies still approach") {
  for (const int seed : {2, 3, 9}) {  // two touches each, of which the first ends while the disk comes down
    Scene scene = small_scene(seed, 8, 0.06);
    const Outcome whole = outcome_of(scene);
    REQUIRE(whole.status == Status::finished);
    CHECK(whole.touches == 2);
    CHECK(whole.e_first == Catch::Detail::Approx(whole.e).margin(2e-3));
    CHECK(whole.time_first < whole.time);
    scene.ending.at = "first_parting";
    CHECK(outcome_of(scene).e == whole.e_first);
  }
}

TEST_CASE("an impact may be over at its first parting, at a gap, or at a time") {
  Scene scene = small_scene(2, 1);
  const Outcome whole = outcome_of(scene);
  REQUIRE(whole.status == Status::finished);
  CHECK(std::isfinite(whole.e_first));
  scene.ending.at = "first_parting";
  const Outcome first = outcome_of(scene);
  REQUIRE(first.status == Status::finished);
  CHECK(first.e == first.e_first);
  CHECK(first.e_first == whole.e_first);
  CHECK(first.mu_first == whole.mu_first);
  CHECK(first.time_first == whole.time_first);
  CHECK(first.time <= whole.time);
  CHECK(first.time - first.time_first < 3 * first.step);
  scene.ending.gap = 0.3;
  const Outcome apart = outcome_of(scene);
  REQUIRE(apart.status == Status::finished);
  CHECK(apart.time > first.time + 0.5);
  scene.ending = {};
  scene.ending.at = "time";
  scene.ending.time = 12.345;
  const Outcome timed = outcome_of(scene);
  REQUIRE(timed.status == Status::finished);
  CHECK(std::abs(timed.time - 12.345) <= timed.step * 0.51);
  scene.ending.time = 0.1;
  CHECK(outcome_of(scene).status == Status::no_contact);
  scene.ending.time = whole.time_first - 0.2;
  const Outcome touching = outcome_of(scene);
  REQUIRE(touching.status == Status::finished);
  CHECK_THAT(touching.reason, Catch::Matchers::Contains("the bodies still touch"));
  for (const double of_parting : {touching.e, touching.beta, touching.mu, touching.e_n, touching.contact_time})
    CHECK(std::isnan(of_parting));
  CHECK(std::isfinite(touching.vn));
}

TEST_CASE("endings that contradict themselves are refused") {
  const auto refused = [](const EndRule& rule, double time_limit) {
    Integration integration;
    integration.time_limit = time_limit;
    try {
      rule.check(integration);
    } catch (const FieldError& error) {
      return error.field;
    }
    return std::string();
  };
  CHECK(refused({"time"}, not_given) == "ending");
  CHECK(refused({"parted", 1e-3, not_given, 5}, not_given) == "ending");
  CHECK(refused({"time", 1e-3, 0.1, 5}, not_given) == "ending");
  CHECK(refused({"time", 1e-3, not_given, 5}, 4) == "time_limit");
  CHECK(refused({"time", 1e-3, not_given, 5}, 6).empty());
}

TEST_CASE("overlap counts from the first touch") {
  Scene scene = small_scene(1, 0, 0);
  scene.target = plane();
  const Outcome smooth = outcome_of(scene);
  REQUIRE(smooth.status == Status::finished);
  // The repulsion touches before the outlines do: by a few 1/xi.
  CHECK(smooth.overlap > smooth.indentation);
  CHECK(smooth.overlap < smooth.indentation + 15 / scene.contact.xi);
}

TEST_CASE("how deep nodes stand inside closed surfaces, open chains and planes") {
  const Points unit{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Mesh<2> closed{{0, 1, 2, 3}, ring(4), {}};
  const Surface square = closed;
  const PlacedSurface body(square, unit);
  CHECK(body.depth({0.5, 0.2}) == Catch::Detail::Approx(0.2));
  CHECK(body.depth({0.5, -0.2}) == 0);
  const Surface half = Plane{};
  CHECK(PlacedSurface(half, {}).depth({3, -0.4}) == Catch::Detail::Approx(0.4));
  CHECK(PlacedSurface(half, {}).depth({3, 0.4}) == 0);
  // The upper half of the square's rim, from right to left: open to below.
  Mesh<2> open{{0, 1, 2, 3}, {{0, 1}, {1, 2}, {2, 3}}, {}};
  const Surface roof = open;
  const PlacedSurface above(roof, {{1, 0}, {1, 1}, {0, 1}, {0, 0}});
  CHECK(above.depth({0.5, 0.9}) == Catch::Detail::Approx(0.1));
  CHECK(above.depth({0.5, 1.1}) == 0);
  CHECK(above.depth({1.1, 1.2}) == 0);   // beyond the corner
  CHECK(above.depth({0.9, -0.2}) == 0);  // beyond the end
  CHECK(deepest_inside(body, PlacedSurface(half, {})) == 0);
}

TEST_CASE("penetration is followed: a tip between the nodes of a one-sided contact stands inside the disk") {
  Scene scene;
  scene.projectile = disk(60, 1e4, 0, 3);
  scene.target = of_outline({{-1, -1}, {1, -1}, {0, 1}}, 150, 3);
  scene.launch.speed = 0.1;
  scene.contact = paper_contact();
  const Outcome one = outcome_of(scene);
  scene.contact.sides = "two";
  const Outcome two = outcome_of(scene);
  REQUIRE(two.status == Status::finished);
  CHECK(one.penetration > 0.01);
  CHECK(two.penetration == 0);
}

TEST_CASE("a row tells whether a body folded") {
  Scene scene = small_scene(1, 0, 0);
  CHECK(outcome_of(scene).folded == 0);
  scene.launch.speed = 1.5;
  scene.contact.V0 = 1e4;
  scene.integration.energy_tolerance = 0.5;
  const Outcome fast = outcome_of(scene);
  CHECK(fast.inverted > 0.002);
  CHECK(fast.folded == 1);
}

TEST_CASE("the energies before an impact are those of both bodies, a target's that flies and spins among them") {
  Scene scene = paper_scene();
  scene.projectile = disk(80, 1e4, 0, 3);
  Body moving = *disk(80, 1e4, 0, 2);
  moving.velocity = {0.02, 0.03};
  moving.spin = 0.05;
  scene.target = std::make_shared<Body>(moving);
  const Outcome o = outcome_of(scene);
  INFO(name_of(o.status) << " " << o.reason);
  REQUIRE(o.status == Status::finished);
  const auto told = [&](const std::string& name) {
    for (const auto& [field, value] : Outcome::fields())
      if (field.name == name) return value(o);
    FAIL("no column " << name);
    return 0.0;
  };
  const BuiltSolids solids(scene);
  const double mass = solids[role::target].total_mass();
  CHECK(told("before_target_translation") == Catch::Detail::Approx(mass / 2 * (0.02 * 0.02 + 0.03 * 0.03)));
  CHECK(told("before_target_rotation") == Catch::Detail::Approx(o.inertia_target * mass / 2 * 0.05 * 0.05));
  double sum = 0;
  for (const char* body : {"projectile", "target"})
    for (const char* part : {"translation", "rotation", "vibration"})
      sum += told(std::string("before_") + body + "_" + part);
  CHECK(sum == Catch::Detail::Approx(told("before_total")));
  scene.target = wall(150, 400, 0, 1);
  const Outcome held = outcome_of(scene);
  CHECK(held.before.of(role::target).translation == 0);
  CHECK(held.before.of(role::target).rotation == 0);
}
