#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <set>
#include <thread>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/lane.hpp"
#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "impact/launch/step.hpp"
#include "impact/sweep.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

// Three lattices, angles, speeds, ratios of stiffness, methods of every kind, one miss, one that runs out of time.
std::vector<Scene> scenes() {
  std::vector<Scene> list;
  for (int seed = 1; seed <= 3; ++seed)
    for (double psi1 : {0.0, 0.7, 1.5, 3.0, 6.0, 9.0}) {
      Scene scene = small_scene(seed, psi1);
      if (psi1 == 0.7 || psi1 == 0.0)
        scene.integration.method = std::array{"takahashi_imada", "multirate_3", "rk4"}[seed - 1];
      if (psi1 == 1.5) scene.launch.speed = 0.2;
      if (psi1 == 0.7) scene.launch.speed = 0.03;  // in contact while its neighbours ring
      if (psi1 == 3.0) {
        Body stiff = *scene.target;
        stiff.numbers.stiffness = 2000;
        scene.target = std::make_shared<Body>(stiff);
      }
      if (psi1 == 6.0) scene.contact.sides = "two";
      if (psi1 == 1.5 || psi1 == 6.0 || psi1 == 9.0) {
        scene.effects = {Gravity{0.01, "both"},
                         Drag{0.1, "projectile"},
                         Absorbing{0.5, 2},
                         Damping{1e-3, "both"},
                         Plastic{1e-3, 0.1, "projectile"},
                         Breaking{0.01, "target"},
                         Adhesion{0.5, 200},
                         Friction{0.3, 1},
                         MovingAnchor{0.02, 0.5, 40 * psi1, "normal"},
                         Thermal{1e-6, seed + static_cast<int>(psi1), "both"}};
        REQUIRE(scene.effects.size() + 2 == effect_kinds);  // all but yielding and absorbing edges, of elements
        if (seed == 1)
          std::erase_if(scene.effects, [](const Effect& e) { return std::holds_alternative<Absorbing>(e); });
        else
          std::erase_if(scene.effects, [](const Effect& e) { return std::holds_alternative<MovingAnchor>(e); });
      }
      if (psi1 == 9.0 && seed == 1) {
        scene.launch.psi1 = not_given;
        scene.launch.angle = 90;
      }
      if (psi1 == 9.0 && seed == 2) scene.integration.time_limit = 3;
      list.push_back(scene);
    }
  return list;
}

std::string hash_of(const std::vector<Scene>& list, int threads, int batch) {
  std::vector<std::string> texts(list.size());
  const std::atomic<bool> go_on{false};
  const bool whole = run_sweep(list, std::vector<bool>(list.size(), true), {threads, batch}, go_on,
                               [&](const std::vector<Result>& results) {
                                 for (const Result& r : results) texts[r.index] = exact_text(r.outcome);
                               });
  CHECK(whole);
  std::string all;
  for (const std::string& text : texts) all += text;
  return hash_text(all);
}

}  // namespace

TEST_CASE("the outcomes have the same bits for 1, 2, 4 threads, for every batch size, and for each scene alone") {
  const std::vector<Scene> list = scenes();
  std::string alone;
  const std::atomic<bool> go_on{false};
  for (const Scene& scene : list) alone += exact_text(run_scene(BuiltSolids(scene), scene, go_on));
  const std::string expected = hash_text(alone);
  for (int threads : {1, 2, 4})
    for (int batch = 1; batch <= lanes; ++batch) {
      if (sanitized && std::pair(threads, batch) != std::pair(2, lanes) && std::pair(threads, batch) != std::pair(4, 3))
        continue;
      INFO(threads << " threads, batch " << batch);
      CHECK(hash_of(list, threads, batch) == expected);
    }
}

TEST_CASE("a lane of a multirate method cannot tell whether its neighbours are in contact") {
  std::vector<Scene> list;
  for (int i = 0; i < 24; ++i) {
    Scene scene = small_scene(1, 0.3 * (i % 5));
    scene.launch.speed = 0.02 * (1 + i * 7 % 12);
    scene.integration.method = "multirate_5";
    list.push_back(scene);
  }
  CHECK(hash_of(list, 1, lanes) == hash_of(list, 1, 1));
}

TEST_CASE("the lanes may narrow as the contact of an impact beside effects ends") {
  Scene scene = paper_scene();
  scene.projectile = disk(40, 1e4, 0.03, 1);
  scene.target = wall(150, 400, 0.03, 1);
  scene.launch.speed = 0.2;
  scene.effects = {Drag{0.02, "both"}};
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  const std::atomic<bool> go_on{false};
  const Start start = launch(scene, {p.get(), t.get()});
  double contact_end = 0;
  Observer observer;
  observer.due = [](double) { return true; };
  observer.look = [&](const Snapshot& shot) {
    if (shot.energy.contact > touch_share * start.energy) contact_end = shot.time;
  };
  REQUIRE(run_scene({p.get(), t.get()}, scene, go_on, &observer).status == Status::finished);
  // A step with which the contact ends a few steps after, at, or before a look, where the neighbour's time limit makes
  // the lanes narrow.
  const double looks = std::ceil(contact_end / start.step / evaluations_between_looks);
  int same = 0, moments = 0;
  for (double after = -2; after <= 3; after += 0.5, ++moments) {
    scene.integration.step = contact_end / (looks * evaluations_between_looks + after);
    Scene neighbour = scene;
    neighbour.launch.speed = 0.15;
    neighbour.integration.time_limit = (looks - 0.5) * evaluations_between_looks * scene.integration.step;
    std::array<Outcome, 2> outcomes;
    run_sweep({scene, neighbour}, {true, true}, {1, 2}, go_on, [&](const std::vector<Result>& results) {
      for (const Result& r : results) outcomes[r.index] = r.outcome;
    });
    CHECK(outcomes[1].status == Status::out_of_time);
    same += exact_text(outcomes[0]) == exact_text(run_scene({p.get(), t.get()}, scene, go_on));
  }
  CHECK(same == moments);
}

TEST_CASE(
    "threads share the scenes of one lattice, every result is handed over once, and the use of the machine is told") {
  std::vector<Scene> list;
  for (int i = 0; i < 40; ++i) list.push_back(small_scene(1, 0.2 * i));
  const std::atomic<bool> go_on{false};
  std::vector<int> times(list.size());
  std::set<std::thread::id> threads;
  SweepUse use;
  run_sweep(
      list, std::vector<bool>(list.size(), true), {2, lanes}, go_on,
      [&](const std::vector<Result>& results) {
        threads.insert(std::this_thread::get_id());
        for (const Result& r : results) ++times[r.index];
      },
      &use);
  CHECK(std::count(times.begin(), times.end(), 1) == 40);
  CHECK(threads.size() == 2);
  CHECK(use.threads == 2);
  CHECK((use.idle_threads >= 0 && use.idle_threads < 1 && use.idle_lanes >= 0 && use.idle_lanes < 0.5));
  // Three scenes on three threads run alone each: no lane is idle.
  list.resize(3);
  run_sweep(
      list, {true, true, true}, {3, lanes}, go_on, [](const auto&) {}, &use);
  CHECK(use.idle_lanes == 0);
}

TEST_CASE("an observer does not change a bit") {
  const Scene scene = small_scene(2, 1);
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  const std::atomic<bool> go_on{false};
  int looks = 0;
  const Observer observer{0, [](double) { return true; }, [&](const Snapshot&) { ++looks; }};
  CHECK(exact_text(run_scene({p.get(), t.get()}, scene, go_on, &observer)) ==
        exact_text(run_scene({p.get(), t.get()}, scene, go_on)));
  CHECK(looks > 100);
}

TEST_CASE("a scene that cannot start is named by its place in the sweep") {
  auto list = scenes();
  list[7].integration.step = 1;
  const std::atomic<bool> go_on{false};
  try {
    run_sweep(list, std::vector<bool>(list.size(), true), {2, 4}, go_on, [](const auto&) {});
    FAIL("accepted");
  } catch (const SceneError& error) {
    CHECK(error.scene == 7);
    CHECK(error.field == "step");
  }
}

TEST_CASE("what has begun when a scene cannot start runs to its end and is handed over") {
  std::vector<Scene> list;
  for (int i = 0; i < 12; ++i) list.push_back(small_scene(1, 0.2 * i));
  list[9].launch.at = 50;
  for (int threads : {1, 2}) {
    std::set<std::size_t> ended;
    const auto run = [&] {
      run_sweep(list, std::vector<bool>(list.size(), true), {threads, 4}, std::atomic<bool>{false},
                [&](const std::vector<Result>& results) {
                  for (const Result& r : results) {
                    CHECK(r.outcome.status == Status::finished);
                    ended.insert(r.index);
                  }
                });
    };
    CHECK_THROWS_AS(run(), SceneError);
    for (std::size_t i = 0; i < 9; ++i) CHECK(ended.count(i) == 1);
  }
}

TEST_CASE("a scene whose launch is sound but not its start is found by the check as well") {
  std::vector<Scene> list{small_scene(), small_scene()};
  list[1].effects = {Thermal{1e3, 1, "both"}};
  CHECK_THROWS_AS(check_scenes(list, {true, true}, {1, 1}, std::atomic<bool>{false}), SceneError);
}
