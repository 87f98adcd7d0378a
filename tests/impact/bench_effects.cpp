// What the catalogue of effects costs a scene that names none: the engine against one compiled without it.
// ricochet_tests "[.benchmark]" times both, "[.slow]" counts their instructions.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <fstream>

#include "no_effects.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

struct Bare {
  Scene scene = [] {
    Scene s;
    s.projectile = disk(800, 1e4, 0.03, 1);
    s.target = wall(4000, 100, 0.03, 1, 8, 2);
    s.launch.psi1 = 1;
    return s;
  }();
  std::shared_ptr<const Lattice> projectile = build_lattice(*scene.projectile), target = build_lattice(*scene.target);

  /// Steps of full lanes through the middle of the impact; returns the seconds that they took, and e so far.
  template <class Effects>
  double seconds(int steps) const {
    Engine<lanes, Effects> engine(*projectile, *target, scene.method(), {});
    for (int lane = 0; lane < lanes; ++lane) engine.begin(lane, scene, 0);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < steps; ++i) engine.advance_one_step();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
};

constexpr int steps = 400;

}  // namespace

TEST_CASE("a scene without effects costs what it would without the catalogue", "[.benchmark]") {
  const Bare bare;
  std::vector<double> ratios;
  double with = 0, without = 0;
  for (int repeat = 0; repeat < 21; ++repeat) {
    // In turn, and in changing order: a busy moment falls on both.
    if (repeat % 2) {
      with = bare.seconds<ActingEffects<lanes>>(steps);
      without = bare.seconds<NoEffects<lanes>>(steps);
    } else {
      without = bare.seconds<NoEffects<lanes>>(steps);
      with = bare.seconds<ActingEffects<lanes>>(steps);
    }
    ratios.push_back(with / without);
  }
  std::sort(ratios.begin(), ratios.end());
  fmt::print(
      "with the catalogue over without it, the paper's scene, {} lanes: median {:.4f} of {} runs ({:.4f} to {:.4f} in "
      "the middle half)\n",
      lanes, ratios[ratios.size() / 2], ratios.size(), ratios[ratios.size() / 4], ratios[3 * ratios.size() / 4]);
}

TEST_CASE("a scene without effects takes the instructions that it would without the catalogue, to 0.1 %", "[.slow]") {
  const auto count = [](const char* engine) {
    const std::string out = fmt::format("/tmp/ricochet_callgrind_{}.txt", ::getpid());
    const std::string command = fmt::format(
        "valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='*advance_one_step*' {} {} > {} "
        "2>&1",
        RICOCHET_STEPS, engine, out);
    INFO(command << " (needs Debian's valgrind)");
    REQUIRE(std::system(command.c_str()) == 0);
    std::ifstream file(out);
    for (std::string line; std::getline(file, line);)
      if (const auto at = line.find("Collected : "); at != std::string::npos) return std::stod(line.substr(at + 12));
    FAIL("no count in " << out);
    return 0.0;
  };
  const double with = count("with"), without = count("without");
  fmt::print("instructions of 40 steps: {:.0f} with the catalogue, {:.0f} without, ratio {:.6f}\n", with, without,
             with / without);
  CHECK(with > 1e7);
  CHECK(with / without == Catch::Detail::Approx(1).epsilon(0.001));
}
