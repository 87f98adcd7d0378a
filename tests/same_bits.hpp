#pragma once
// The outcomes of a sweep to the last bit, for comparison.

#include "impact/sweep.hpp"
#include "scenes.hpp"

namespace ricochet::test {

/// [scene] every column of its outcome in all its digits.
inline std::vector<std::string> exact_texts(const std::vector<Scene>& list, int threads, int batch) {
  static const std::atomic<bool> go_on{false};
  std::vector<std::string> of(list.size());
  run_sweep(list, std::vector<bool>(list.size(), true), {threads, batch}, go_on,
            [&](const std::vector<Result>& results) {
              for (const Result& r : results) of[r.index] = exact_text(r.outcome);
            });
  return of;
}

}  // namespace ricochet::test
