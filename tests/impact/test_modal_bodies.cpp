// Impacts of bodies that move as their modes: against the same bodies node by node, and among themselves.

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "body/modes.hpp"
#include "core/error.hpp"
#include "impact/estimate.hpp"
#include "refusal.hpp"
#include "same_bits.hpp"

using namespace ricochet;
using namespace ricochet::test;
using Catch::Matchers::Contains;

namespace {

const std::atomic<bool> go_on{false};

constexpr double nu = 1.0 / 3;
const double c_P = std::sqrt(1e4 / ((1 - nu * nu) * usual_density));

std::shared_ptr<const Body> plane() {
  Body body;
  body.plane = Plane{};
  return std::make_shared<Body>(body);
}

/// An ellipse of 1 to 0.7, turned by half a radian.
Body tilted_ellipse(int nodes) {
  Body body{circle(1, 2000), element_numbers(nodes, 1e4, nu), {}, {}};
  for (Vec2& p : body.outline) p.y() *= 0.7;
  body.numbers.angle = 0.5 * 180 / std::numbers::pi;
  return body;
}

/// The same body, moving as so many of its modes; as all of them unless given.
Body moving_as_modes(Body body, int count = 0) {
  body.numbers.modes_of = body.numbers.interior;
  if (count == 0) {
    const auto solid = build_solid(body);
    count = solid->free_coordinates() - (solid->anchored() ? 0 : 3);
  }
  body.numbers.interior = "modes";
  body.numbers.modes = count;
  return body;
}

Scene onto_plane(const Body& body, double speed, double xi) {
  Scene scene;
  scene.projectile = std::make_shared<Body>(body);
  scene.target = plane();
  scene.launch.speed = speed * c_P;
  scene.contact.xi = xi;
  return scene;
}

Outcome run(const Scene& scene) {
  Outcome o = run_scene(BuiltSolids(scene), scene, go_on);
  INFO(o.reason);
  REQUIRE(o.status == Status::finished);
  return o;
}

/// A free disk of springs, heavy and of few modes, that spins below a small one of elements.
Scene two_free_disks() {
  Scene scene;
  scene.projectile = std::make_shared<Body>(moving_as_modes(Body{circle(), element_numbers(120, 1e4, nu), {}, {}}, 60));
  Body below{circle(1.5), numbers(150, 3e3, 0.02, 2), {}, {}};
  below.spin = -0.01;
  scene.target = std::make_shared<Body>(moving_as_modes(below, 80));
  scene.launch = {0.05, 0.7};
  scene.launch.at = 0.3;
  scene.launch.spin = 0.02;
  scene.contact.xi = 300;
  return scene;
}

}  // namespace

TEST_CASE("modal bodies: a tilted ellipse of all its modes leaves a plane as its elements do, and keeps its energy") {
  const Body body = tilted_ellipse(sanitized ? 120 : 400), modal = moving_as_modes(body);
  for (const double psi1 : {0.0, 1.0}) {
    Scene scene = onto_plane(body, 0.02, 500);
    scene.launch.psi1 = psi1;
    const Outcome direct = run(scene);
    scene.projectile = std::make_shared<Body>(modal);
    scene.integration.theta = 0.25;
    const Outcome o = run(scene);
    fmt::print(
        "ellipse at 0.02 c_P, psi1 {:g}: e {:.5f} ({:.5f} by elements), omega R/v {:.5f} ({:.5f}), closure {:.1e}\n",
        psi1, o.e, direct.e, o.omega / scene.launch.speed, direct.omega / scene.launch.speed, o.energy_closure);
    CHECK(std::abs(o.e - direct.e) < 1e-3);
    CHECK(std::abs(o.omega - direct.omega) / scene.launch.speed < 2e-3);
    CHECK(o.energy_closure < 1e-8);
    CHECK(o.vt == Catch::Detail::Approx(direct.vt).epsilon(1e-9).margin(1e-12));  // the plane is smooth
  }
}

TEST_CASE("modal bodies: linear elements and all their modes leave a plane alike, whatever the speed") {
  const Body disk{circle(1, 6000), element_numbers(sanitized ? 100 : 300, 1e4, nu, "linear"), {}, {}};
  const Body modal = moving_as_modes(disk);
  for (const double speed : {0.01, 0.03, 0.1}) {
    const Outcome direct = run(onto_plane(disk, speed, 1000)), o = run(onto_plane(modal, speed, 1000));
    CAPTURE(speed, direct.e, o.e, direct.contact_time, o.contact_time);
    CHECK(std::abs(o.e - direct.e) < 1e-3);
    CHECK(std::abs(o.contact_time / direct.contact_time - 1) < 5e-3);
  }
}

TEST_CASE("modal bodies: a lattice of all its modes rebounds as its springs do in a slow impact") {
  Body body{circle(), numbers(200, 1e4, 0, 3, "triangular"), {}, {}};
  body.numbers.quartic = 0;
  const double springs = run(onto_plane(body, 0.01, 500)).e;
  CHECK(std::abs(run(onto_plane(moving_as_modes(body), 0.01, 500)).e - springs) < 1e-3);
}

TEST_CASE("modal bodies: an anchored wall of its modes throws a disk back as its elements do") {
  Body block{box(4, 1.5), element_numbers(200, 400, 0.2), {}, {}};
  for (const Vec2& p : plan_nodes(block.outline, block.numbers, {}).points)
    block.anchored.push_back(p.y() < -1.5 + 1e-9 || std::abs(p.x()) > 2 - 1e-9);
  Scene scene = onto_plane(Body{circle(), element_numbers(120, 1e4, nu), {}, {}}, 0.002, 500);
  scene.launch.psi1 = 0.5;
  scene.target = std::make_shared<Body>(block);
  const Outcome direct = run(scene);
  scene.target = std::make_shared<Body>(moving_as_modes(block));
  const Outcome o = run(scene);
  CAPTURE(o.e, direct.e, o.omega, direct.omega);
  CHECK(std::abs(o.e - direct.e) < 5e-3);
  CHECK(std::abs(o.omega - direct.omega) < 5e-3 * scene.launch.speed);
  CHECK(o.energy_closure < 1e-5);
}

TEST_CASE("modal bodies: momentum, angular momentum and energy of two free ones are kept, with friction but energy") {
  for (const bool rough : {false, true}) {
    Scene scene = two_free_disks();
    if (rough) scene.effects = {Friction{0.3, 1}};
    const BuiltSolids built(scene);
    const Solids solids = built;
    std::array<double, 3> first{}, greatest{};
    int looks = 0;
    const Observer observer{0, [](double) { return true; },
                            [&](const Snapshot& shot) {
                              Vec2 momentum = Vec2::Zero();
                              double angular = 0;
                              for (std::size_t b = 0; b < solids.size(); ++b) {
                                const RigidShot& body = shot.rigid[b];
                                momentum += solids[b]->total_mass() * body.velocity;
                                angular += solids[b]->total_mass() * cross(body.centre, body.velocity) +
                                           solids[b]->inertia() * body.spin;
                              }
                              const std::array<double, 3> now{momentum.x(), momentum.y(), angular};
                              if (looks++ == 0) first = now;
                              for (std::size_t k = 0; k < 3; ++k)
                                greatest[k] = std::max(greatest[k], std::abs(now[k] - first[k]));
                            }};
    const Outcome o = run_scene(solids, scene, go_on, &observer);
    INFO(o.reason);
    REQUIRE(o.status == Status::finished);
    REQUIRE(looks > 100);
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(rough, k, first[k]);
      CHECK(greatest[k] < 1e-11 * std::abs(first[1]));
    }
    CHECK(o.energy_closure < (rough ? 1e-3 : 1e-4));
  }
}

TEST_CASE("modal bodies: the error of the step falls by its square") {
  Scene scene = onto_plane(moving_as_modes(tilted_ellipse(150), 100), 0.02, 500);
  scene.launch.psi1 = 0.5;
  scene.launch.spin = 0.005;
  const auto at = [&](double theta) {
    scene.integration.theta = theta;
    return run(scene);
  };
  const Outcome exact = at(0.02);
  const auto error = [&](double theta) {
    const Outcome o = at(theta);
    return std::abs(o.e - exact.e) + std::abs(o.omega - exact.omega) / scene.launch.speed;
  };
  const double coarse = error(0.4), fine = error(0.1);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-3);
  CHECK(std::log(coarse / fine) / std::log(4) > 1.7);
}

TEST_CASE("modal bodies: the same bits alone, in lanes and on threads") {
  std::vector<Scene> list;
  for (const double speed : {0.02, 0.05, 0.03})
    for (const double psi1 : {0.0, 0.8}) {
      Scene scene = two_free_disks();
      scene.launch.speed = speed;
      scene.launch.psi1 = psi1;
      list.push_back(scene);
      scene.effects = {Friction{0.3, 1}};
      list.push_back(scene);
      scene.target = plane();
      list.push_back(scene);
      Body stiffer = *scene.projectile;  // shares its solid with the others
      stiffer.numbers.stiffness = 2e4;
      scene.projectile = std::make_shared<Body>(stiffer);
      list.push_back(scene);
    }
  const std::vector<std::string> alone = exact_texts(list, 1, 1);
  for (const int batch : {2, 3, 4}) CHECK(exact_texts(list, 2, batch) == alone);
}

TEST_CASE("modal bodies: who is called the projectile changes nothing") {
  Scene scene = two_free_disks();
  Body below = *scene.target;
  below.spin = 0;
  scene.target = std::make_shared<Body>(below);
  scene.launch.spin = 0;
  scene.launch.psi1 = 0;
  const Outcome one = run(scene);
  // Half a turn puts the target above.
  Scene exchanged = scene;
  Body above = *scene.target, under = *scene.projectile;
  above.numbers.angle = under.numbers.angle = 180;
  exchanged.projectile = std::make_shared<Body>(above);
  exchanged.target = std::make_shared<Body>(under);
  const auto centre = [](const Body& body) { return build_solid(body)->centre().x(); };
  exchanged.launch.at -= centre(*scene.projectile) + centre(*scene.target);
  const Outcome other = run(exchanged);
  CHECK(other.e_n == Catch::Detail::Approx(one.e_n).epsilon(1e-8));
  CHECK(other.omega == Catch::Detail::Approx(one.target_omega).epsilon(1e-8));
  CHECK(other.target_omega == Catch::Detail::Approx(one.omega).epsilon(1e-8));
  CHECK(other.contact_time == Catch::Detail::Approx(one.contact_time).epsilon(1e-8));
}

TEST_CASE("modal bodies: nodes lie where the modes say: the energies of the modes are all that vibrates") {
  Scene scene = onto_plane(moving_as_modes(tilted_ellipse(150), 40), 0.02, 500);
  scene.launch.psi1 = 0.5;
  const BuiltSolids built(scene);
  const Solid& solid = *Solids(built)[0];
  Snapshot last;
  const Outcome o = run(scene);
  const Observer observer{o.time, equally_spaced(o.time, 1, 1, o.step), [&](const Snapshot& shot) { last = shot; }};
  run_scene(built, scene, go_on, &observer);
  double energy = 0;
  for (const double of_mode : mode_energies(solid, slowest_modes(solid, scene.projectile->numbers.stiffness, 40),
                                            last.bodies[0].place, last.bodies[0].velocity))
    energy += of_mode;
  REQUIRE(o.after.of(0).vibration > 0.01 * o.before.total());
  // The nodes' angular momentum over their moment of inertia, as deformed, is not quite the frame's spin.
  CHECK(energy == Catch::Detail::Approx(o.after.of(0).vibration).epsilon(1e-3));
}

TEST_CASE("modal bodies: more modes take up more, as fast as they come") {
  double last = 1;
  const Body body = tilted_ellipse(300);
  const double all = run(onto_plane(moving_as_modes(body), 0.02, 500)).e;
  for (const int count : {10, 40, 160}) {
    const double error = std::abs(run(onto_plane(moving_as_modes(body, count), 0.02, 500)).e - all);
    CAPTURE(count, error);
    CHECK(error < last);
    last = error;
  }
  CHECK(last < 0.01);
}

TEST_CASE("modal bodies: what they do not have is refused by name") {
  Scene scene = onto_plane(moving_as_modes(tilted_ellipse(60), 20), 0.02, 500);
  CHECK(scene.method().name == "verlet");
  for (const char* method : {"pefrl", "takahashi_imada", "multirate_2", "rk4"}) {
    scene.integration.method = method;
    CHECK(refusal(scene) == fmt::format("method: {} is not for the projectile, a body of modes, which is kicked once a "
                                        "step and turns exactly in between; give verlet or leave method out",
                                        method));
  }
  scene.integration.method = "auto";
  for (const Effect& effect :
       {Effect(Plastic{1e-3, 0.1, "projectile"}), Effect(Breaking{0.01, "both"}), Effect(Damping{1e-3, "both"}),
        Effect(Gravity{1e-3, "projectile"}), Effect(Drag{0.1, "projectile"}), Effect(Thermal{1e-6, 1, "projectile"}),
        Effect(Yielding{1, 0, "projectile"})}) {
    scene.effects = {effect};
    CHECK(refusal(scene) == fmt::format("effects: {} acts inside bodies, and the projectile moves as its modes; let it "
                                        "act on another body, leave it out, or give interior = \"elements\"",
                                        name_of(effect)));
  }
  scene.effects.clear();
  Body greedy = *scene.projectile;
  greedy.numbers.modes = 1000;
  scene.projectile = std::make_shared<Body>(greedy);
  CHECK_THAT(refusal(scene), Contains("modes: a body of 60 free nodes has 117 modes; ask for no more"));
}

TEST_CASE("modal bodies: an estimate warns of speeds at which strains are no longer small") {
  const auto warned = [](double speed) {
    Body disk{circle(), element_numbers(800, 1e4, nu), {}, {}};
    disk.numbers.interior = "modes";
    const Estimate e = estimate(onto_plane(disk, speed, 500));
    return std::any_of(e.doubts.begin(), e.doubts.end(), [](const Doubt& d) { return d.kind == "fast_modes"; });
  };
  CHECK(warned(0.06));
  CHECK_FALSE(warned(0.04));
}
