// case_matrix [COUNT [FIRST_SEED]]: runs random scenes of every kind, and counts how they end. Exits with 1 if an
// ending is wrong.

#include <fmt/format.h>

#include <chrono>
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
  std::map<std::string, int> endings;
  std::mutex counting;
  int wrong = 0, done = 0;
  double slowest = 0;
  long slowest_seed = 0;
  ricochet::in_parallel(seeds, 0, [&](long seed) {
    const auto began = std::chrono::steady_clock::now();
    const RandomScene random = random_scene(static_cast<std::uint64_t>(seed));
    const Verdict verdict = judged(random);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const std::lock_guard lock(counting);
    ++endings[verdict.ending];
    ++done;
    if (seconds > slowest) {
      slowest = seconds;
      slowest_seed = seed;
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
  for (const auto& [ending, number] : endings) fmt::print("{:14} {:6}\n", ending, number);
  fmt::print("{} scenes (seeds {} to {}), {} wrong; the slowest took {:.1f} s (seed {})\n", count, first,
             first + count - 1, wrong, slowest, slowest_seed);
  return wrong > 0;
}
