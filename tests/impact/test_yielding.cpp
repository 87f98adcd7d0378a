// Impacts of bodies whose elements yield, against quasi-static laws, another program of finite elements, and
// themselves.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "impact/launch/launch.hpp"
#include "record/film.hpp"
#include "record/whole_section.hpp"
#include "refusal.hpp"
#include "render/fields.hpp"
#include "same_bits.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};
constexpr double E = 1e4;

/// c0 = sqrt(E/rho).
const double c0 = std::sqrt(E / usual_density);

/// nu = 0.3, on a rigid plane; speed in c0, yield stress in E.
Scene onto_plane(Body body, double speed, double h_min, double yield, double hardening = 0) {
  body.numbers.h_min = h_min;
  body.numbers.h_max = 12 * h_min;
  Body plane;
  plane.plane = Plane{};
  Scene scene;
  scene.projectile = std::make_shared<Body>(body);
  scene.target = std::make_shared<Body>(plane);
  scene.launch.speed = speed * c0;
  scene.effects = {Yielding{yield * E, hardening * E, "projectile"}};
  return scene;
}

Scene sphere(double speed, double h_min, double yield) {
  Body ball{half_circle(1, 4000), element_numbers(0, E, 0.3), {}, {}};
  ball.numbers.state = "axisymmetric";
  return onto_plane(ball, speed, h_min, yield);
}

Scene disk(double speed, double h_min, double yield) {
  Body body{circle(1, 4000), element_numbers(0, E, 0.3), {}, {}};
  body.numbers.state = "plane_strain";
  return onto_plane(body, speed, h_min, yield);
}

Outcome run(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

std::size_t kind() { return Effect(Yielding{}).index(); }

double taken(const Outcome& o) { return o.effect_energy[kind()] / o.before.total(); }

}  // namespace

TEST_CASE("a sphere that yields keeps its ledger, and is dented", "[P2]") {
  const Outcome o = run(sphere(3e-3, 0.04, 0.005));
  fmt::print("sphere: e {:.4f}, taken {:.4f}, strain {:.3f}, dent {:.4f}, overlap {:.4f}, closure {:.1e}, steps {}\n",
             o.e, taken(o), o.plastic_strain_most, o.dent, o.overlap, o.energy_closure, o.steps);
  REQUIRE(o.status == Status::finished);
  CHECK(o.energy_closure < 1e-5);
  CHECK(o.e > 0.35);
  CHECK(o.e < 0.5);
  CHECK(taken(o) > 0.7);
  CHECK(taken(o) < 1 - o.e * o.e);
  CHECK(o.plastic_strain_most > 0.1);
  CHECK(o.dent > 0.5 * o.overlap);
  CHECK(o.dent < o.overlap);
  CHECK(o.effect_count[kind()] > 20);
}

TEST_CASE(
    "the dent of a target that yields: as deep as that of an equal sphere, and of a block that a hard sphere meets") {
  Scene scene = sphere(3e-3, 0.1, 0.005);
  CHECK(std::isnan(run(scene).dent_target));  // a rigid plane has none
  Body below = *scene.projectile;
  below.fine_at = Vec2(0, 1);
  scene.target = std::make_shared<Body>(below);
  scene.launch.speed *= 2;
  scene.effects = {Yielding{0.005 * E, 0, "both"}};
  const Outcome equal = run(scene);
  REQUIRE(equal.status == Status::finished);
  CHECK(equal.dent > 0.01);
  CHECK(equal.dent_target == Catch::Detail::Approx(equal.dent).epsilon(0.2));  // its deepest node, not the face
  scene.effects = {Yielding{0.005 * E, 0, "projectile"}};
  const Outcome one = run(scene);
  CHECK(one.dent > 0.01);
  CHECK(one.dent_target < 0.1 * one.dent);

  Body block{{{0, -4}, {4, -4}, {4, 0}, {0, 0}}, element_numbers(0, E, 0.3), {}, {}}, hard = *scene.projectile;
  block.numbers.state = "axisymmetric";
  block.numbers.h_min = 0.1;
  block.numbers.h_max = 0.8;
  block.fine_at = Vec2(0, 0);
  for (const Vec2& p : plan_nodes(block, {}).points) block.anchored.push_back(p.y() == -4);
  hard.numbers.stiffness *= 10;
  scene.projectile = std::make_shared<Body>(hard);
  scene.target = std::make_shared<Body>(block);
  scene.effects = {Yielding{0.005 * E, 0, "target"}};
  const Outcome pressed = run(scene);
  REQUIRE(pressed.status == Status::finished);
  fmt::print("dents: equal spheres {:.4f} and {:.4f}; one that yields {:.4f} and {:.4f}; block {:.4f} of {:.4f}\n",
             equal.dent, equal.dent_target, one.dent, one.dent_target, pressed.dent_target, pressed.overlap);
  CHECK(pressed.dent_target > 0.5 * pressed.overlap);
  CHECK(pressed.dent_target < pressed.overlap);
  CHECK(pressed.dent < 0.1 * pressed.dent_target);
  // One that may have turned has no such depth.
  Scene plane_strain = disk(1e-2, 0.1, 0.005);
  plane_strain.target = plane_strain.projectile;
  CHECK(std::isnan(run(plane_strain).dent_target));
}

TEST_CASE("a disk of plane strain yields too, and what never yields rebounds as elastic elements do") {
  const Outcome yields = run(disk(1e-2, 0.06, 0.005));
  fmt::print("disk: e {:.4f}, taken {:.4f}, closure {:.1e}, steps {}\n", yields.e, taken(yields), yields.energy_closure,
             yields.steps);
  REQUIRE(yields.status == Status::finished);
  CHECK(yields.energy_closure < 1e-5);
  CHECK(yields.e < 0.5);
  Scene strong = disk(1e-2, 0.06, 1e3);
  strong.contact.xi = 2000;
  const Outcome never = run(strong);
  strong.effects.clear();
  strong.integration.method = "verlet";
  const Outcome elastic = run(strong);
  CHECK(never.effect_energy[kind()] == 0);
  CHECK(never.plastic_strain_most == 0);
  CHECK(std::isnan(elastic.plastic_strain_most));
  CHECK(std::isnan(elastic.dent));
  CHECK(never.e == Catch::Detail::Approx(elastic.e).epsilon(2e-3));  // Hencky's law against the polynomial one
}

TEST_CASE("a contact twice as hard changes e of a sphere that yields by less than 1 %", "[P8]") {
  Scene scene = sphere(3e-3, 0.04, 0.005);
  const Outcome once = run(scene);
  scene.contact.xi = 2 * once.xi;
  const Outcome twice = run(scene);
  fmt::print("xi {:g}: e {:.5f}; {:g}: {:.5f}\n", once.xi, once.e, twice.xi, twice.e);
  CHECK(twice.e == Catch::Detail::Approx(once.e).epsilon(0.01));
}

namespace {

/// e_n of a disk that comes in at an angle to the normal, on a plane with friction; `speed`: along the normal. [c0,
/// degrees]
double e_n_of(double speed, double h_min, double mu, double angle) {
  Scene scene = disk(speed, h_min, 0.005);
  scene.launch.speed = not_given;
  scene.launch.normal_speed = speed * c0;
  scene.launch.tangential_speed = speed * c0 * std::tan(angle * std::numbers::pi / 180);
  if (mu > 0) scene.effects.emplace_back(Friction{mu});
  const Outcome o = run(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.energy_closure < 1e-5);
  fmt::print("disk at {:g} c0, h = {:g}, mu {:g}, {:2g} degrees: e_n {:.4f}, yielding takes {:.4f}\n", speed, h_min, mu,
             angle, o.e_n, o.effect_energy[kind()] / o.before.total());
  return o.e_n;
}

}  // namespace

// Lim & Stronge, Int. J. Impact Eng. 22 (1998): what friction does along the surface leaves the normal force and the
// energy that yielding takes alone, as long as what flows is contained by what does not. From a mu of about 0.3 on,
// what slides is sheared most at its surface [Johnson, Contact Mechanics, 1985, section 7.1], and flows out of it.
TEST_CASE("friction and the angle leave e_n of a disk that yields inside alone", "[P7]") {
  const double smooth = e_n_of(5e-4, 0.02, 0, 0);
  CHECK(smooth < 0.95);
  CHECK(e_n_of(5e-4, 0.02, 0.1, 45) == Catch::Detail::Approx(smooth).epsilon(0.01));
}

TEST_CASE("e_n of a disk that yields does not depend on friction and angle while its flow is contained",
          "[.slow][P7]") {
  for (const double speed : {3e-4, 5e-4}) {
    const double smooth = e_n_of(speed, 0.008, 0, 0);
    for (const double mu : {0.1, 0.2})
      for (const double angle : {0.0, 15.0, 30.0, 45.0, 60.0})
        CHECK(e_n_of(speed, 0.008, mu, angle) == Catch::Detail::Approx(smooth).epsilon(0.01));
    for (const double mu : {0.3, 0.4})
      for (const double angle : {0.0, 15.0})
        CHECK(e_n_of(speed, 0.008, mu, angle) == Catch::Detail::Approx(smooth).epsilon(0.01));
    // It slides all along, and its surface flows.
    CHECK(e_n_of(speed, 0.008, 0.4, 60) < 0.975 * smooth);
  }
}

TEST_CASE("no element of a sphere that yields without hardening is shown beyond its yield stress") {
  const Scene scene = sphere(3e-3, 0.06, 0.005);
  const BuiltSolids built(scene);
  const Course course = follow_course(built, scene, go_on);
  const FrameMesh half = frame_mesh(scene, built), mesh = whole_section(half);
  const render::Fields fields(mesh);
  CHECK(mesh.nodes() == 2 * (half.nodes() - 2) + 2);  // the plane is two nodes
  int frames = 0;
  film_scene(built, scene, {course.tightest, course.last_touch}, go_on, [&](const Frame& seen) {
    const Frame frame = whole_section(half, seen);
    const std::vector<double> stress = fields.of_material("von_mises", frame);
    const double most = *std::max_element(stress.begin(), stress.end());
    CHECK(most < 1.005 * 0.005 * E);
    if (frames == 0) CHECK(most > 0.99 * 0.005 * E);
    const std::vector<double> strain = fields.of_material("plastic_strain", frame);
    CHECK(*std::max_element(strain.begin(), strain.end()) > 0.03);
    ++frames;
  });
  CHECK(frames == 2);
}

TEST_CASE("bodies that yield have the same bits alone, in lanes and on threads") {
  std::vector<Scene> list;
  for (const double speed : {1e-3, 2e-3, 3e-3, 5e-3, 8e-3}) list.push_back(sphere(speed, 0.1, 0.005));
  const std::vector<std::string> alone = exact_texts(list, 1, 1);
  for (const int batch : {2, 3, 4}) CHECK(exact_texts(list, 2, batch) == alone);
}

TEST_CASE("yielding is refused by name where it is none") {
  using Catch::Matchers::Contains;
  Scene scene = disk(1e-2, 0.2, 0.005);
  Body body = *scene.projectile;
  body.numbers.state = "plane_stress";
  scene.projectile = std::make_shared<Body>(body);
  CHECK_THAT(refusal(scene), Contains("yielding: the projectile is free to bulge"));
  body.numbers.state = "plane_strain";
  body.numbers.law = "linear";
  scene.projectile = std::make_shared<Body>(body);
  CHECK_THAT(refusal(scene), Contains("yielding: the projectile has the law linear"));
  scene = disk(1e-2, 0.2, 0.005);
  scene.integration.method = "takahashi_imada";
  CHECK_THAT(refusal(scene), Contains("takahashi_imada"));
  scene.integration.method = "auto";
  scene.effects = {Yielding{}};
  CHECK_THAT(refusal(scene), Contains("yielding: the projectile is of no material with a yield stress"));
  scene.effects = {Yielding{1, 0, "target"}};
  CHECK_THAT(refusal(scene), Contains("yielding acts on elements, and the target is rigid"));
  scene.effects = {Yielding{1, 0, "projectile"}};
  scene.projectile = test::disk(60, 1e4, 0, 1);
  CHECK_THAT(refusal(scene), Contains("yielding acts on elements, and the projectile is of springs"));
}

namespace {

/// Of a sphere of E*/Y: at V/V_y, in units of E R^2 and R; by finite elements, and by Jackson & Green's quasi-static
/// fit.
struct Known {
  double yield, speed, h_min;
  double e, force, depth, law_force, law_depth;
  double law_e, law_tolerance;  ///< of Wu, Li & Thornton where it holds
};

const Known known_spheres[] = {
    {0.005, 1e-4, 0.003, 0.809, 4.56e-5, 1.087e-3, 4.51e-5, 1.100e-3, 0, 0},
    {0.005, 3e-4, 0.006, 0.682, 1.569e-4, 2.794e-3, 1.549e-4, 2.812e-3, 0, 0},
    {0.005, 1e-3, 0.006, 0.550, 5.87e-4, 8.05e-3, 5.74e-4, 8.12e-3, 0, 0},
    {0.005, 1e-2, 0.03, 0.254, 6.11e-3, 0.0704, 5.80e-3, 0.0719, 0.250, 0.04},
    {0.0011, 3e-5, 0.003, 0.544, 8.09e-6, 5.04e-4, 8.33e-6, 5.03e-4, 0, 0},
    {0.0011, 1e-4, 0.0035, 0.433, 3.02e-5, 1.519e-3, 2.99e-5, 1.512e-3, 0.421, 0.04},
    {0.0011, 3e-4, 0.01, 0.323, 9.12e-5, 4.249e-3, 9.38e-5, 4.239e-3, 0.320, 0.04},
};

}  // namespace

TEST_CASE("spheres that yield follow finite elements, Jackson & Green, and Wu, Li & Thornton", "[.slow][P3][P4]") {
  for (const Known& k : known_spheres) {
    const Scene scene = sphere(k.speed, k.h_min, k.yield);
    const BuiltSolids built(scene);
    double most = 0;
    const Course course = follow_course(built, scene, go_on);
    const Outcome& o = course.outcome;
    REQUIRE(o.status == Status::finished);
    std::vector<double> times;
    for (int i = 0; i <= 4000; ++i)
      times.push_back(course.first_touch + (course.last_touch + 0.1 - course.first_touch) * i / 4000);
    film_scene(built, scene, {}, go_on, {},
               {times, [&](const Sample& sample) { most = std::max(most, sample.force.y()); }});
    most /= E;
    fmt::print(
        "Y {:g} E, {:g} c0: e {:.4f} ({:.3f}), force {:.4g} ({:.4g}; {:.4g}), depth {:.4g} ({:.4g}; {:.4g}), "
        "closure {:.1e}, xi {:.3g}, {} steps\n",
        k.yield, k.speed, o.e, k.e, most, k.force, k.law_force, o.overlap, k.depth, k.law_depth, o.energy_closure, o.xi,
        o.steps);
    CHECK(o.energy_closure < 1e-5);
    CHECK(o.e == Catch::Detail::Approx(k.e).epsilon(0.02));
    if (k.law_e > 0) CHECK(o.e == Catch::Detail::Approx(k.law_e).epsilon(k.law_tolerance));
    if (k.yield == 0.0011 || k.speed < 1e-2) {
      CHECK(most == Catch::Detail::Approx(k.law_force).epsilon(0.04));
      CHECK(o.overlap == Catch::Detail::Approx(k.law_depth).epsilon(0.02));
    }
  }
}

namespace {

struct Swing {
  double mean, error, least, most;
};

/// e of six meshes of which `across` sides, up to half a side more or less, make the contact's radius a. The contact
/// closes ring by ring of the rim's nodes, and e swings by how far the last one is; over one ring the swing averages
/// out.
Swing over_a_ring(double speed, double a, double across) {
  constexpr int meshes = 6;
  std::vector<Scene> list;
  for (int i = 0; i < meshes; ++i) {
    const double h = a / (across + (i + 0.5) / meshes - 0.5);
    Scene scene = sphere(speed, h, 0.0011);
    Body body = *scene.projectile;
    body.numbers.h_max = 0.12;
    body.numbers.fine_within = 1.14 * a;
    scene.projectile = std::make_shared<Body>(body);
    list.push_back(scene);
  }
  std::vector<double> e(list.size());
  run_sweep(list, std::vector<bool>(list.size(), true), {2, 3}, go_on, [&](const std::vector<Result>& results) {
    for (const Result& r : results) {
      REQUIRE(r.outcome.status == Status::finished);
      e[r.index] = r.outcome.e;
    }
  });
  Swing swing{0, 0, *std::min_element(e.begin(), e.end()), *std::max_element(e.begin(), e.end())};
  for (const double one : e) swing.mean += one / meshes;
  for (const double one : e) swing.error += (one - swing.mean) * (one - swing.mean) / (meshes * (meshes - 1));
  swing.error = std::sqrt(swing.error);
  fmt::print("{:g} c0, a/h {:.1f}: e {:.4f} +- {:.4f}, {:.4f} to {:.4f}\n", speed, across, swing.mean, swing.error,
             swing.least, swing.most);
  return swing;
}

}  // namespace

// At 1786 and 595 yield speeds, E*/Y = 999. One mesh, of this program or another, draws from the swing: 1 to 2 % of e
// at a/h = 9, 0.6 at 17.5. Two such draws, 0.323 and 0.433, make an exponent of -0.27, of which they leave 0.02 open.
// The means are 0.327 and 0.425, to 0.001 (the table below), near the law's 0.320, 0.421 and -1/4. Over one ring at
// a/h = 9 another program of finite elements has 0.328 +- 0.002, and as much by elements that do not lock.
TEST_CASE("e of spheres that yield swings as rings of nodes come into the contact, about a mean of all meshes",
          "[.slow][P4][P5]") {
  const Swing fast = over_a_ring(3e-4, 0.088, 6.2), finer = over_a_ring(3e-4, 0.088, 12.4);
  CHECK(std::abs(finer.mean - fast.mean) < 2 * std::hypot(finer.error, fast.error));
  CHECK(finer.mean == Catch::Detail::Approx(0.327).epsilon(0.01));
  CHECK(finer.mean == Catch::Detail::Approx(0.323).epsilon(0.02));
  CHECK(finer.mean == Catch::Detail::Approx(0.320).epsilon(0.04));
  const Swing slow = over_a_ring(1e-4, 0.0525, 12.4);
  CHECK(slow.mean == Catch::Detail::Approx(0.425).epsilon(0.01));
  CHECK(slow.mean == Catch::Detail::Approx(0.433).epsilon(0.02));
  CHECK(slow.mean == Catch::Detail::Approx(0.421).epsilon(0.04));
  const double exponent = std::log(finer.mean / slow.mean) / std::log(3.0);
  fmt::print("e ~ v^{:.3f} between the means at 595 and 1786 yield speeds\n", exponent);
  CHECK(std::abs(exponent + 0.25) < 0.015);
}

TEST_CASE("table of e of spheres that yield by the number of sides along the contact's radius", "[.table]") {
  const double at[][2] = {{3e-4, 0.088}, {1e-4, 0.0525}};
  for (const auto& [speed, a] : at)
    for (const double across : {4.4, 6.2, 8.8, 12.4, 17.5}) DYNAMIC_SECTION(speed << ", " << across) {
        over_a_ring(speed, a, across);
      }
}

TEST_CASE("metal that is struck faster than its waves run ends unstable, by an element turned over or flattened") {
  // Perfectly plastic: nothing resists being flattened.
  Scene scene =
      onto_plane(Body{{{0, -0.5}, {1, -0.5}, {1, 0.5}, {0, 0.5}}, element_numbers(0, E, 0.3), {}, {}}, 2, 0.1, 0.003);
  Body body = *scene.projectile;
  body.numbers.state = "axisymmetric";
  scene.projectile = std::make_shared<Body>(body);
  const auto ended = [&](double theta) {
    scene.integration.theta = theta;
    const Outcome o = run(scene);
    CHECK(name_of(o.status) == "unstable");
    CHECK(std::isnan(o.e));
    return o.reason;
  };
  CHECK(ended(0.01).find("had turned over, and their law ends before that") != std::string::npos);
  CHECK(ended(0.005).find("the frequency bound had risen") != std::string::npos);
}
