// A wanted accuracy is reached, its estimate is honest, and what cannot be reached is said.

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "impact/accuracy.hpp"
#include "impact/batch.hpp"
#include "impact/chosen_steps.hpp"
#include "impact/launch/launch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

std::string by_number(std::size_t i) { return fmt::format("scene {}", i); }
void print_line(const std::string& line) { fmt::print("{}\n", line); }

/// Scenes of all kinds the paper has: ratio, roughness, angle, speed.
Scene random_scene(int seed) {
  Random random(static_cast<std::uint64_t>(seed), 77);
  Scene scene = paper_scene();
  scene.projectile = disk(60, 1e4, random.uniform(0, 0.03), seed);
  scene.target = wall(150, 1e4 * std::pow(10, random.uniform(-2, 1)), random.uniform(0, 0.03), seed, 5, 1.5);
  scene.launch.psi1 = random.uniform(0, 5);
  scene.launch.speed = std::pow(10, random.uniform(-1.3, -0.5));
  return scene;
}

double e_of(const Solid& p, const Solid& t, Scene scene, const std::string& method, double step) {
  scene.integration.method = method;
  scene.integration.step = step;
  scene.integration.accuracy = not_given;
  const Outcome o = run_scene({&p, &t}, scene, go_on);
  REQUIRE(o.status == Status::finished);
  return o.e;
}

}  // namespace

TEST_CASE("accuracy is honoured on 20 random scenes: e is within twice the request of a far finer run") {
  double worst = 0;
  for (int seed = 1; seed <= (sanitized ? 4 : 20); ++seed) {
    Scene scene = random_scene(seed);
    scene.integration.accuracy = seed % 3 == 0 ? 1e-3 : seed % 3 == 1 ? 1e-5 : 1e-7;
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    const Choice choice = choose_step_for_accuracy({p.get(), t.get()}, scene, go_on);
    const double usual = launch(random_scene(seed), {p.get(), t.get()}).step;
    // The reference is checked by itself: another method at another step agrees to a tenth of what is asked, at 1e-7
    // already near the floor that the clamped ends of the contact's segments set.
    const double exact = e_of(*p, *t, scene, "blanes_moan_srkn11b", 0.6 * usual),
                 again = e_of(*p, *t, scene, "blanes_moan_srkn14a", 0.9 * usual);
    const double error = std::abs(e_of(*p, *t, scene, choice.method, choice.step) - exact);
    INFO(fmt::format("scene {} asked {:g} estimated {:.3g} true {:.3g} reference {:.1g} {} {:.4g}", seed,
                     scene.integration.accuracy, choice.error, error, std::abs(exact - again), choice.method,
                     choice.step));
    CHECK(std::abs(exact - again) < 0.1 * scene.integration.accuracy);
    CHECK(error <= 2 * scene.integration.accuracy);
    CHECK(choice.error <= scene.integration.accuracy);
    worst = std::max(worst, error / scene.integration.accuracy);
  }
  fmt::print("worst true error over request: {:.2f}\n", worst);
}

TEST_CASE(
    "a loose accuracy is honoured as well, by multirate methods where the target is soft, and their estimates are "
    "honest") {
  int multirate = 0, others = 0;
  double worst = 0;
  for (int seed = 101; seed <= 120; ++seed) {
    Scene scene = random_scene(seed);
    if (seed % 4 < 2) {  // as soft as the paper's wall, or softer
      Body soft = *scene.target;
      soft.numbers.stiffness = seed % 4 == 0 ? 100 : 30;
      scene.target = std::make_shared<Body>(soft);
    }
    scene.integration.accuracy = seed % 2 == 0 ? 1e-3 : 5e-3;
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    const Choice choice = choose_step_for_accuracy({p.get(), t.get()}, scene, go_on);
    (method_named(choice.method).multirate() ? multirate : others) += 1;
    Scene plain = scene;
    plain.integration.accuracy = not_given;
    const double exact = e_of(*p, *t, scene, "blanes_moan_srkn6b", launch(plain, {p.get(), t.get()}).step);
    const double error = std::abs(e_of(*p, *t, scene, choice.method, choice.step) - exact);
    INFO(fmt::format("scene {} asked {:g} estimated {:.3g} true {:.3g} by {} at {:.4g}", seed,
                     scene.integration.accuracy, choice.error, error, choice.method, choice.step));
    CHECK(error <= 2 * scene.integration.accuracy);
    worst = std::max(worst, error / scene.integration.accuracy);
  }
  fmt::print("worst true error over request: {:.2f}; {} by multirate methods, {} by others\n", worst, multirate,
             others);
  CHECK(multirate >= 5);
  CHECK(others >= 3);
}

TEST_CASE(
    "e of a smooth impact converges at the order that outcomes are said to have, takahashi_imada's and multirate's at "
    "4") {
  for (const char* method : {"verlet", "takahashi_imada", "multirate_2"}) {
    Scene scene = paper_scene();
    scene.projectile = disk(60, 1e4, 0, 1);
    scene.target = wall(200, 1e3, 0, 1, 5, 1.5);
    scene.launch.psi1 = 0;
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    const Method& m = method_named(method);
    scene.integration.method = method;
    const double unit = launch(scene, {p.get(), t.get()}).step / m.usual * m.stability_limit;
    scene.integration.method = "pefrl";
    const double exact = e_of(*p, *t, scene, "blanes_moan_srkn14a", 0.3 * launch(scene, {p.get(), t.get()}).step);
    const double coarse = std::abs(e_of(*p, *t, scene, method, 0.8 * unit) - exact),
                 fine = std::abs(e_of(*p, *t, scene, method, 0.2 * unit) - exact);
    INFO(method << " " << coarse << " " << fine);
    CHECK(std::log2(coarse / fine) / 2 == Catch::Detail::Approx(m.outcome_order).margin(0.5));
  }
}

TEST_CASE(
    "the ledger of methods that are conjugate to order 4 closes at that order, though the energy of what they move is "
    "kept to order 2 only") {
  for (const char* method : {"takahashi_imada", "multirate_2", "multirate_5"}) {
    const Method& m = method_named(method);
    Scene scene = paper_scene();
    scene.projectile = disk(60, 1e4, 0, 1);
    scene.target = wall(200, 1e3, 0, 1, 5, 1.5);
    scene.launch.psi1 = 0;
    scene.integration.method = method;
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    const auto at = [&](double theta) {
      scene.integration.theta = theta;
      const Outcome o = run_scene({p.get(), t.get()}, scene, go_on);
      REQUIRE(o.status == Status::finished);
      return o;
    };
    const Outcome coarse = at(0.6 * m.stability_limit), fine = at(0.15 * m.stability_limit);
    INFO(method << ": closes to " << coarse.energy_closure << " and " << fine.energy_closure << ", strays by "
                << coarse.energy_drift << " and " << fine.energy_drift);
    CHECK(std::log2(coarse.energy_closure / fine.energy_closure) / 2 > 3.5);
    CHECK(std::log2(coarse.energy_drift / fine.energy_drift) / 2 < 3);
    CHECK(coarse.energy_closure < coarse.energy_drift / 30);
  }
}

TEST_CASE("an accuracy below the scene's floor is refused with what was reached") {
  Scene scene = small_scene(1, 1);
  scene.integration.accuracy = 1e-12;
  scene.integration.method = "verlet";
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  CHECK_THROWS_WITH(choose_step_for_accuracy({p.get(), t.get()}, scene, go_on),
                    Catch::Matchers::Contains("is below what verlet can reach for e here"));
}

TEST_CASE("scenes of one kind share their trials, and keep the estimate") {
  std::vector<Scene> scenes;
  for (int seed : {1, 2, 3, 4})
    for (double psi1 : {0.0, 2.0}) {
      Scene scene = small_scene(seed, psi1);
      scene.integration.accuracy = 1e-4;
      scenes.push_back(scene);
    }
  Scene plain = small_scene(1, 1);
  scenes.push_back(plain);
  int told = 0;
  const auto chosen = with_chosen_steps(
      scenes, 1, go_on, {[&](const std::string& line) { told += line.find("theta") < line.size(); }, by_number});
  CHECK(told == 1);
  CHECK(chosen[0].integration.theta > 0);
  CHECK(chosen[0].integration.theta == chosen[7].integration.theta);
  CHECK(chosen[0].error_step <= 1e-4);
  CHECK(chosen[8].hash() == plain.hash());
  CHECK(run_scene(BuiltSolids(chosen[0]), chosen[0], go_on).error_step == chosen[0].error_step);
}

TEST_CASE(
    "accuracy is honoured in a sweep of rough lattices: nine rows of ten are within what was asked, and near their "
    "estimate") {
  std::vector<Scene> scenes;
  for (int seed = 1; seed <= 15; ++seed)
    for (double psi1 : {0.0, 1.0, 2.0, 4.0}) {
      Scene scene = small_scene(seed, psi1, 0.05);
      scene.launch.speed = 0.4;
      scene.integration.accuracy = 1e-4;
      scenes.push_back(scene);
    }
  Scene miss = scenes[0];  // passes by: no trial
  miss.launch = Launch{};
  miss.launch.speed = 0.4;
  miss.launch.angle = 90;
  scenes.insert(scenes.begin() + 30, miss);
  const auto chosen = with_chosen_steps(scenes, 0, go_on, {print_line, by_number});
  int missed = 0, underestimated = 0, count = 0;
  double worst = 0;
  for (const Scene& scene : chosen) {
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    const Outcome o = run_scene({p.get(), t.get()}, scene, go_on);
    if (o.status == Status::no_contact) continue;
    REQUIRE(o.status == Status::finished);
    Scene fine = scene;
    fine.integration.theta = not_given;
    const double error = std::abs(o.e - e_of(*p, *t, fine, "blanes_moan_srkn6b", 0.4 * o.step));
    missed += error > 1e-4;
    underestimated += error > 2 * o.error_step;
    ++count;
    worst = std::max(worst, error);
  }
  fmt::print("{} of {} rows missed 1e-4 (worst {:.2g}), {} exceed twice their estimate\n", missed, count, worst,
             underestimated);
  CHECK(count == 60);
  CHECK(missed <= 6);
  CHECK(underestimated <= 9);
}

TEST_CASE("only one of step, theta and accuracy is given, and theta follows each scene's lattices") {
  Scene scene = small_scene(1, 1), other = small_scene(2, 1);
  scene.integration.theta = other.integration.theta = 1;
  const Outcome a = run_scene(BuiltSolids(scene), scene, go_on);
  const Outcome b = run_scene(BuiltSolids(other), other, go_on);
  CHECK(a.step != b.step);
  CHECK(a.theta == Catch::Detail::Approx(1).epsilon(1e-14));
  CHECK(b.theta == Catch::Detail::Approx(1).epsilon(1e-14));
  Integration i;
  CHECK_NOTHROW(i.check());
  for (const auto& [first, second] :
       {std::pair{&Integration::step, &Integration::theta}, std::pair{&Integration::step, &Integration::accuracy},
        std::pair{&Integration::theta, &Integration::accuracy}}) {
    Integration both;
    both.*first = 0.01;
    CHECK_NOTHROW(both.check());
    both.*second = 0.01;
    CHECK_THROWS_AS(both.check(), FieldError);
  }
}
