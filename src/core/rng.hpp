#pragma once
// Random streams that give the same numbers on every compiler and C library.

#include <cstdint>
#include <random>

namespace ricochet {

/// A stream of random numbers: std::mt19937_64, whose every bit the C++ standard fixes. `seed` is the user's; `purpose`
/// separates the streams of one body (places, roughness), so that changing one leaves the other alone.
class Random {
 public:
  Random(std::uint64_t seed, std::uint32_t purpose) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), purpose};
    engine_.seed(sequence);
  }

  /// Uniform in [0, 1): the top 53 bits of a draw (std::uniform_real_distribution is the library's own business).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Normal deviate of mean 0 and standard deviation 1, by algorithm N of C. F. F. Karney, "Sampling exactly from the
  /// normal distribution", ACM Trans. Math. Softw. 42, 3 (2016). It only compares uniform numbers: no log, sin or exp
  /// of a C library, whose last digits differ, enters a lattice.
  double normal() {
    for (;;) {
      int k = 0;
      while (with_probability_exp_half()) ++k;
      bool accepted = true;
      for (int i = 0; i < k * (k - 1) && accepted; ++i) accepted = with_probability_exp_half();
      if (!accepted) continue;
      const double x = uniform();
      for (int i = 0; i <= k && accepted; ++i) accepted = accepts(k, x);
      if (!accepted) continue;
      return (uniform() < 0.5 ? -1.0 : 1.0) * (k + x);
    }
  }

 private:
  /// True with probability exp(-1/2): the length of a falling run of uniform numbers that starts below 1/2 is even (von
  /// Neumann).
  bool with_probability_exp_half() {
    double last = 0.5;
    for (int n = 0;; ++n) {
      const double u = uniform();
      if (u >= last) return n % 2 == 0;
      last = u;
    }
  }

  /// True with probability exp(-x (2k + x) / (2k + 2)): step B of algorithm N.
  bool accepts(int k, double x) {
    double last = x;
    for (int n = 0;; ++n) {
      const double z = uniform();
      if (z >= last || uniform() >= (2 * k + x) / (2 * k + 2)) return n % 2 == 0;
      last = z;
    }
  }

  std::mt19937_64 engine_;
};

}  // namespace ricochet
