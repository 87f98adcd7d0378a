#include "impact/contact_error.hpp"

#include <algorithm>
#include <cmath>

#include "impact/launch/launch.hpp"
#include "impact/sweep.hpp"

namespace ricochet {
namespace {

constexpr std::size_t most_scenes = 3;

// The scene with a contact twice as hard, which takes half the step.
Scene harder(const TrialScene& trial) {
  Scene scene = trial.scene;
  scene.contact.xi = 2 * launch(trial.scene, trial.solids).contact.xi;
  scene.integration.theta /= 2;
  return scene;
}

}  // namespace

double contact_error(const std::vector<TrialScene>& scenes, int threads, const std::atomic<bool>& stop) {
  std::vector<Scene> list;
  const std::size_t count = std::min(scenes.size(), most_scenes);
  for (std::size_t k = 0; k < count; ++k) {
    const TrialScene& trial = scenes[count > 1 ? k * (scenes.size() - 1) / (count - 1) : 0];
    if (!std::isnan(trial.scene.contact.xi)) return not_given;
    list.push_back(trial.scene);
    list.push_back(harder(trial));
  }
  std::vector<double> value(list.size(), not_given);
  run_sweep(list, std::vector<bool>(list.size(), true), {threads}, stop, [&](const std::vector<Result>& results) {
    for (const Result& r : results)
      if (r.outcome.status == Status::finished)
        value[r.index] = value_of(r.outcome, list[r.index].integration.accuracy_of);
  });
  double sum = 0;
  int settled = 0;
  for (std::size_t k = 0; k < list.size(); k += 2)
    if (const double change = std::abs(value[k] - value[k + 1]); !std::isnan(change)) {
      sum += 2 * change;
      ++settled;
    }
  return settled > 0 ? sum / settled : not_given;
}

}  // namespace ricochet
