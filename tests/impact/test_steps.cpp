// Steps that hold for every body: chosen by themselves, by trials, and again where they fail.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <set>

#include "core/error.hpp"
#include "impact/accuracy.hpp"
#include "impact/chosen_steps.hpp"
#include "impact/launch/launch.hpp"
#include "impact/spread.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> never{false};

/// What a choice told, and the scenes by their numbers.
struct Told {
  std::vector<std::string> lines;

  Telling telling() {
    return {[this](const std::string& line) { lines.push_back(line); },
            [](std::size_t i) { return fmt::format("scene {}", i); }};
  }
  std::string text() const {
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    return all;
  }
};

std::shared_ptr<const Body> with_mass(const std::shared_ptr<const Body>& body, double mass) {
  Body heavy = *body;
  heavy.numbers.mass = mass;
  return std::make_shared<Body>(heavy);
}

Scene heavy_scene(double mass) {
  Scene scene;
  scene.projectile = with_mass(disk(40, 1e4, 0, 1), mass);
  scene.target = wall(100, 1e3, 0, 1, 4, 1);
  scene.launch.speed = 0.02;
  scene.contact = {150, 300, 0.1, "two"};
  scene.integration.time_limit = 1000;
  return scene;
}

std::shared_ptr<const Body> placed(const std::shared_ptr<const Body>& body, const char* placement) {
  Body other = *body;
  other.numbers.placement = placement;
  return std::make_shared<Body>(other);
}

/// The paper's scene, small: lattices by angles.
std::vector<Scene> paper_sweep(int nodes, int samples, const std::vector<double>& psi1) {
  std::vector<Scene> scenes;
  for (int seed = 1; seed <= samples; ++seed)
    for (const double angle : psi1) {
      Scene scene;
      scene.projectile = disk(nodes, 1e4, 0.03, seed);
      scene.target = wall(5 * nodes, 100, 0.03, seed);
      scene.launch.psi1 = angle;
      scene.contact = paper_contact();
      scene.integration.accuracy = 1e-3;
      scenes.push_back(scene);
    }
  return scenes;
}

struct SweepRun {
  std::vector<Outcome> outcomes;
  double evaluations = 0;  ///< of springs
};

SweepRun run_all(const std::vector<Scene>& scenes, const Telling& telling) {
  SweepRun run;
  run.outcomes.resize(scenes.size());
  run_chosen(
      scenes, std::vector<bool>(scenes.size(), true), {}, never,
      [&](const std::vector<Result>& results) {
        for (const Result& result : results) run.outcomes[result.index] = result.outcome;
      },
      telling);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const BuiltSolids solids(scenes[i]);
    run.evaluations += run.outcomes[i].steps * work_of_step(scenes[i].method(), solids) * springs_of(solids);
  }
  return run;
}

std::vector<Scene> by_pefrl(std::vector<Scene> scenes, double theta) {
  for (Scene& scene : scenes) {
    scene.integration.accuracy = not_given;
    scene.integration.method = "pefrl";
    scene.integration.theta = theta;
  }
  return scenes;
}

}  // namespace

TEST_CASE("the automatic step is stable for a disk of mass 1 to 1e4 on a wall of mass 1") {
  for (const double mass : {1.0, 10.0, 100.0, 1000.0, 1e4}) {
    Scene scene = heavy_scene(mass);
    const BuiltSolids solids(scene);
    const Outcome o = run_scene(solids, scene, never);
    INFO(
        fmt::format("mass {}: {} e {} theta {} most {} steps {}", mass, o.reason, o.e, o.theta, o.theta_most, o.steps));
    CHECK(o.status == Status::finished);
    CHECK(o.theta_most < 0.8 * scene.method().stability_limit);
    CHECK(o.energy_drift < 1e-3);
    if (mass > 200) continue;  // crushed walls fold, and what folds settles at no step
    scene.integration.theta = o.theta / 2;
    CHECK(std::abs(run_scene(solids, scene, never).e - o.e) < 1e-4);
  }
}

TEST_CASE("bodies of equal mass keep the step of their springs, to the bit, and heavy walls do not shorten it") {
  Scene scene = heavy_scene(1);
  const BuiltSolids equal(scene);
  const Start start = launch(scene, equal);
  CHECK(start.theta == 1.6);
  scene.target = with_mass(scene.target, 1e4);
  scene.projectile = with_mass(scene.projectile, 1);
  const BuiltSolids heavy(scene);
  CHECK(launch(scene, heavy).theta == 1.6);
}

TEST_CASE("a spin that would take 1e11 steps is refused with a spin and a time limit that do not") {
  Scene scene = small_scene(1, 0, 0);
  scene.launch.spin = 1e6;
  const BuiltSolids solids(scene);
  CHECK_THROWS_WITH(
      launch(scene, solids),
      Catch::Matchers::Contains("the projectile's nodes move at 1e+06 c: to follow their contact takes steps of") &&
          Catch::Matchers::Contains("give a spin below 9.6e+03 c/R, or a time_limit below 0.96 R/c"));
  scene.launch.spin = 100;
  CHECK_NOTHROW(launch(scene, solids));
}

TEST_CASE("the scenes that are tried meet every value of every list, whichever of them runs fastest") {
  for (const bool angle_last : {true, false}) {
    std::vector<Scene> scenes;
    for (int slow = 0; slow < (angle_last ? 16 : 4); ++slow)
      for (int fast = 0; fast < (angle_last ? 4 : 16); ++fast) {
        const int sample = angle_last ? slow : fast, angle = angle_last ? fast : slow;
        scenes.push_back(small_scene(sample + 1, angle));
      }
    std::vector<const Scene*> list;
    for (const Scene& scene : scenes) list.push_back(&scene);
    std::map<double, int> angles;
    std::set<std::int64_t> samples;
    for (const std::size_t i : spread_over(list, 9)) {
      ++angles[scenes[i].launch.psi1];
      samples.insert(scenes[i].projectile->numbers.seed);
    }
    CHECK(angles.size() == 4);
    for (const auto& [psi1, count] : angles) CHECK(count >= 2);
    CHECK(samples.size() == 9);
    CHECK(*samples.begin() == 1);
    CHECK(*samples.rbegin() == 16);
  }
}

TEST_CASE("a sweep over spin starts at every spin: the fastest take shorter steps, and the slow ones do not") {
  std::vector<Scene> scenes;
  for (int k = 0; k < 16; ++k) {
    Scene scene = small_scene(1, 0, 0);
    scene.target = std::make_shared<Body>(Body{{}, scene.target->numbers, {}, {}, {}, Plane{}});
    scene.launch.spin = 0.3 * k;
    scene.integration.accuracy = 1e-3;
    scenes.push_back(scene);
  }
  Told told;
  const std::vector<Scene> chosen = with_chosen_steps(scenes, 1, never, told.telling());
  INFO(told.text());
  for (const Scene& scene : chosen) CHECK_NOTHROW(check_start(BuiltSolids(scene), scene));
  CHECK(chosen.front().integration.theta >= chosen.back().integration.theta);
}

TEST_CASE("what trials found is remembered once the error of the contact is known, too: no half of it after a stop") {
  std::vector<Scene> scenes;
  for (const int seed : {1, 2}) {
    scenes.push_back(small_scene(seed, 0, 0));
    scenes.back().integration.accuracy = 1e-2;
    scenes.back().contact = {};
  }
  std::atomic<bool> stop{false};
  const Telling stopping{[&](const std::string& line) { stop = stop || line.find(" with theta ") < line.size(); },
                         [](std::size_t) { return std::string("a scene"); }};
  TriedChoices tried;
  CHECK_THROWS_WITH(with_chosen_steps(scenes, 1, stop, stopping, nullptr, &tried), "interrupted");
  CHECK(stop);
  CHECK(tried.empty());
  Told told;
  with_chosen_steps(scenes, 1, never, told.telling(), nullptr, &tried);
  REQUIRE(tried.size() == 1);
  CHECK(tried.begin()->second.error_contact > 0);
}

TEST_CASE("scenes of another temperature have their own choice, those of another seed of the vibration share it") {
  std::vector<Scene> scenes;
  for (const double temperature : {1e-6, 1e-5})
    for (const int seed : {1, 2}) {
      Scene scene = small_scene(1, 0, 0);
      scene.effects = {Thermal{temperature, seed, "both"}};
      scene.integration.accuracy = 1e-2;
      scenes.push_back(scene);
    }
  Told told;
  with_chosen_steps(scenes, 1, never, told.telling());
  INFO(told.text());
  CHECK(std::count_if(told.lines.begin(), told.lines.end(), [](const std::string& line) {
          return line.find("tries steps in 2 of 2 scenes") < line.size();
        }) == 2);
}

TEST_CASE(
    "an impact that fails by a chosen step runs again with half of it, and is told; a step that a user gave is kept") {
  Scene scene = small_scene(1, 0, 0);
  scene.integration.method = "verlet";
  scene.integration.theta = 1.9;
  const BuiltSolids solids(scene);
  scene.integration.energy_tolerance = run_scene(solids, scene, never).energy_drift / 2;
  REQUIRE(run_scene(solids, scene, never).status == Status::energy_drift);
  Told told;
  CHECK(run_all({scene}, told.telling()).outcomes[0].status == Status::energy_drift);
  CHECK(told.lines.empty());
  Scene chosen = scene;
  chosen.error_step = 1e-3;
  CHECK(chosen.hash() != scene.hash());
  const Outcome o = run_all({scene, chosen}, told.telling()).outcomes[1];
  INFO(told.text());
  REQUIRE(o.status == Status::finished);
  CHECK_THAT(told.lines.front(), Catch::Matchers::Contains("scene 1 ended energy_drift by the step that trials chose; "
                                                           "again with half of it, theta 0.95"));
  scene.integration.theta = o.theta;
  CHECK(run_scene(solids, scene, never).e == o.e);
}

TEST_CASE("trials cost at most a quarter of their sweep at the usual step, counted in springs, for any placement") {
  std::map<std::string, double> whole;
  for (const char* placement : {"poisson_disk", "uniform"}) {
    std::vector<Scene> scenes = paper_sweep(40, 12, {0, 1, 3, 6});
    for (Scene& scene : scenes) {
      scene.projectile = placed(scene.projectile, placement);
      scene.target = placed(scene.target, placement);
    }
    Told told;
    std::vector<const Scene*> list;
    for (const Scene& scene : scenes) list.push_back(&scene);
    std::vector<TrialScene> tried;
    for (const std::size_t i : spread_over(list, 9)) tried.push_back({BuiltSolids(scenes[i]), scenes[i]});
    const Choice choice = choose_for_accuracy(tried, scenes.size(), 1, never);
    CHECK(choose_for_accuracy(tried, scenes.size(), 3, never).evaluations == choice.evaluations);
    const double usual = run_all(by_pefrl(scenes, 1.6), told.telling()).evaluations;
    const std::vector<Scene> chosen = with_chosen_steps(scenes, 0, never, told.telling());
    const double taken = run_all(chosen, told.telling()).evaluations;
    INFO(told.text());
    INFO(fmt::format("{}: trials {:.3g}, usual {:.3g}, chosen {:.3g}", placement, choice.evaluations, usual, taken));
    CHECK(choice.evaluations <= 0.25 * usual);
    CHECK(taken < usual);
    whole[placement] = choice.evaluations + taken;
  }
  CHECK(whole["uniform"] <= 3 * whole["poisson_disk"]);
}

TEST_CASE("a scene that cannot settle is left out of the choice and named, and the others keep theirs") {
  std::vector<Scene> scenes = paper_sweep(60, 4, {0});
  scenes[2].launch.spin = 40;  // more energy than V0 holds back
  Told told;
  const std::vector<Scene> chosen = with_chosen_steps(scenes, 1, never, told.telling());
  CHECK_THAT(told.text(), Catch::Matchers::Contains("left out: scene 2: "));
  CHECK(chosen[0].integration.theta > 0);
}

TEST_CASE("a choice keeps good impacts: none is lost, and e is that of short steps") {
  const std::vector<Scene> scenes = paper_sweep(80, 6, {0});
  Told told;
  const std::vector<Outcome> chosen =
      run_all(with_chosen_steps(scenes, 0, never, told.telling()), told.telling()).outcomes;
  const std::vector<Outcome> exact = run_all(by_pefrl(scenes, 0.4), told.telling()).outcomes;
  INFO(told.text());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    CHECK(chosen[i].status == Status::finished);
    CHECK(std::abs(chosen[i].e - exact[i].e) < 1e-3);
  }
}

TEST_CASE("the 300 impacts at psi1 = 0 by accuracy = 1e-3: none lost, e as by pefrl at theta 0.4", "[.slow]") {
  for (const int nodes : {200, 300, 400}) {
    const std::vector<Scene> scenes = paper_sweep(nodes, 100, {0});
    Told told;
    const auto chosen = run_all(with_chosen_steps(scenes, 0, never, told.telling()), told.telling()).outcomes;
    const auto exact = run_all(by_pefrl(scenes, 0.4), told.telling()).outcomes;
    int lost = 0;
    double worst = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      lost += chosen[i].status != Status::finished;
      worst = std::max(worst, std::abs(chosen[i].e - exact[i].e));
    }
    fmt::print("{}{} nodes: {} lost, e off by {:.2g} at most\n", told.text(), nodes, lost, worst);
    CHECK(lost == 0);
    CHECK(worst < 1e-3);
  }
}

TEST_CASE("friction by springs harder than the bodies' own shortens the automatic step to one that is stable") {
  const auto run = [](double stiffness) {
    Scene scene = small_scene();
    scene.integration.method = "verlet";
    if (stiffness > 0) scene.effects = {Friction{0.5, stiffness}};
    return run_scene(BuiltSolids(scene), scene, never);
  };
  const double bare = run(0).step;
  CHECK(run(1).step == bare);  // the usual friction leaves room enough
  for (const double stiffness : {1e3, 1e4}) {
    const Outcome held = run(stiffness);
    INFO(held.reason);
    CHECK(held.status == Status::finished);
    CHECK(held.step < bare);
  }
}
