// ricochet_tests "[.benchmark]": impacts a second, lanes against one by one, on one core.

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>

#include "core/lane.hpp"
#include "impact/sweep.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

TEST_CASE("ten angles in lanes against the same scenes one by one", "[.benchmark]") {
  std::vector<Scene> list;
  for (double psi1 : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0}) {
    Scene scene = paper_scene();
    scene.projectile = disk(800, 1e4, 0.03, 1);
    scene.target = wall(4000, 100, 0.03, 1, 8, 2);
    scene.launch.psi1 = psi1;
    scene.integration.time_limit = 6;  // long enough to be mostly contact
    list.push_back(scene);
  }
  const std::atomic<bool> go_on{false};
  const auto seconds = [&](int batch) {
    const auto start = std::chrono::steady_clock::now();
    run_sweep(list, std::vector<bool>(list.size(), true), {1, batch}, go_on, [](const auto&) {});
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::vector<double> ratios;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const double alone = seconds(1), together = seconds(lanes);
    ratios.push_back(alone / together);
    fmt::print("W = 1: {:.2f} impacts/s   W = {}: {:.2f} impacts/s   ratio {:.2f}\n", 10 / alone, lanes, 10 / together,
               ratios.back());
  }
  std::sort(ratios.begin(), ratios.end());
  fmt::print("median ratio {:.2f} (10 impacts of 6 R/c each, 800 + 4000 nodes, one core)\n", ratios[2]);
}
