// case_matrix [COUNT [FIRST_SEED]]: runs random scenes of every kind, and counts how they end: all, and of these
// kinds: with bodies of elements, of revolution, with elements that yield, and those that leave the step to the
// program. Exits with 1 if an ending is wrong.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <numeric>

#include "hard/random_scene.hpp"
#include "impact/parallel.hpp"

using namespace ricochet::test;

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::atol(argv[1]) : 2000, first = argc > 2 ? std::atol(argv[2]) : 1;
  if (count < 1 || first < 1 || argc > 3) {
    fmt::print(stderr, "error: case_matrix takes a count of scenes and the first seed, both above 0\n");
    return 2;
  }
  std::vector<long> seeds(static_cast<std::size_t>(count));
  std::iota(seeds.begin(), seeds.end(), first);
  std::map<std::string, std::array<int, 5>> endings;
  std::array<int, 5> kinds{};
  std::mutex counting;
  int wrong = 0, done = 0, smooth = 0, smooth_measured = 0;
  double most_e_n = 0;
  double slowest = 0;
  long slowest_seed = 0;
  ricochet::in_parallel(seeds, 0, [&](long seed) {
    const auto began = std::chrono::steady_clock::now();
    const RandomScene random = random_scene(static_cast<std::uint64_t>(seed));
    const Verdict verdict = judged(random);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const std::lock_guard lock(counting);
    const ricochet::Scene& scene = random.scene;
    const bool is_of[] = {true, scene.projectile->numbers.of_elements() || scene.target->numbers.of_elements(),
                          scene.projectile->numbers.axisymmetric(),
                          ricochet::find_effect<ricochet::Yielding>(scene.effects) != nullptr,
                          std::isnan(scene.integration.step) && std::isnan(scene.integration.theta)};
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      endings[verdict.ending][kind] += is_of[kind];
      kinds[kind] += is_of[kind];
    }
    ++done;
    if (seconds > slowest) {
      slowest = seconds;
      slowest_seed = seed;
    }
    if (verdict.e_n) {
      ++smooth;
      smooth_measured += std::isfinite(*verdict.e_n);
      most_e_n = std::fmax(most_e_n, *verdict.e_n);
    }
    if (verdict.wrong) {
      ++wrong;
      fmt::print("seed {}: {}\n  {}\n", seed, *verdict.wrong, random.text);
    }
    if (std::getenv("MATRIX_TELL") && verdict.ending == std::getenv("MATRIX_TELL"))
      fmt::print("seed {}: {}\n  {}\n", seed, verdict.reason, random.text);
    if (done % 200 == 0) fmt::print("{} scenes ...\n", done);
    std::fflush(stdout);
  });
  fmt::print("{:14} {:>6} {:>14} {:>14} {:>14} {:>14}\n", "", "all", "with elements", "axisymmetric", "yielding",
             "step chosen");
  const auto row = [](const std::string& name, const std::array<int, 5>& n) {
    fmt::print("{:14} {:6} {:14} {:14} {:14} {:14}\n", name, n[0], n[1], n[2], n[3], n[4]);
  };
  for (const auto& [ending, number] : endings) row(ending, number);
  row("", kinds);
  fmt::print("of {} impacts of cold, smooth bodies that finish, {} have e_n, at most {:.4f}\n", smooth, smooth_measured,
             most_e_n);
  fmt::print("{} scenes (seeds {} to {}), {} wrong; the slowest took {:.1f} s (seed {})\n", count, first,
             first + count - 1, wrong, slowest, slowest_seed);
  return wrong > 0;
}
