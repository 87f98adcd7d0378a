// What the engine around them costs the kernels of a scene without effects: contact and sweeps called by hand are what
// it is held against. ricochet_tests "[.benchmark]" times both, "[.slow]" counts their instructions.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "bare_steps.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

constexpr int steps = 400;

/// Of steps of full lanes through the middle of the impact.
template <class Step>
double seconds(Step&& step) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < steps; ++i) step();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Undefined, with the reason said, where valgrind does not know the instructions that this machine's compiler took.
double instructions(const char* by, const char* function) {
  const std::string out = fmt::format("/tmp/ricochet_callgrind_{}.txt", ::getpid());
  const std::string command =
      fmt::format("valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='*{}*' {} {} > {} 2>&1",
                  function, RICOCHET_STEPS, by, out);
  const int status = std::system(command.c_str());
  std::ifstream file(out);
  for (std::string line; std::getline(file, line);) {
    if (line.find("unhandled instruction") != std::string::npos) return std::numeric_limits<double>::quiet_NaN();
    if (const auto at = line.find("Collected : "); at != std::string::npos && status == 0)
      return std::stod(line.substr(at + 12));
  }
  FAIL(command << " gave no count (it needs Debian's valgrind)");
  return 0;
}

}  // namespace

TEST_CASE("a scene without effects costs its kernels alone", "[.benchmark]") {
  Scene scene = paper_scene();
  scene.projectile = disk(800, 1e4, 0.03, 1);
  scene.target = wall(4000, 100, 0.03, 1, 8, 2);
  scene.launch.psi1 = 1;
  const BuiltSolids solids(scene);
  const auto by_engine = [&] {
    Engine<lanes> engine(solids, scene.method(), {});
    for (int lane = 0; lane < lanes; ++lane) engine.begin(lane, scene, 0);
    return seconds([&] { engine.advance_one_step(); });
  };
  const auto by_hand = [&] {
    BareSteps bare(solids, scene);
    return seconds([&] { bare.one_bare_step(); });
  };
  std::vector<double> ratios;
  for (int repeat = 0; repeat < 21; ++repeat) {
    // In turn, and in changing order: a busy moment falls on both.
    const double first = repeat % 2 ? by_engine() : by_hand(), second = repeat % 2 ? by_hand() : by_engine();
    ratios.push_back(repeat % 2 ? first / second : second / first);
  }
  std::sort(ratios.begin(), ratios.end());
  fmt::print(
      "the engine over its kernels by hand, the paper's scene, {} lanes: median {:.4f} of {} runs ({:.4f} to {:.4f} in "
      "the middle half)\n",
      lanes, ratios[ratios.size() / 2], ratios.size(), ratios[ratios.size() / 4], ratios[3 * ratios.size() / 4]);
}

TEST_CASE("a scene without effects takes the instructions of its kernels, to 1 %", "[.slow]") {
  const double engine = instructions("engine", "Engine*advance_one_step"),
               kernels = instructions("kernels", "one_bare_step");
  if (std::isnan(engine + kernels)) {
    WARN(
        "not counted: valgrind does not know this processor's newest instructions; configure with "
        "-DRICOCHET_NATIVE=OFF -DCMAKE_CXX_FLAGS=-march=x86-64-v3");
    return;
  }
  fmt::print("instructions of 40 steps: {:.0f} by the engine, {:.0f} by its kernels, ratio {:.6f}\n", engine, kernels,
             engine / kernels);
  CHECK(kernels > 1e7);
  CHECK(engine / kernels == Catch::Detail::Approx(1).epsilon(0.01));
}
