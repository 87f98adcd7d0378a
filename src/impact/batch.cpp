#include "impact/batch.hpp"

#include <chrono>

#include "body/kept_solids.hpp"
#include "core/error.hpp"
#include "impact/engine.hpp"
#include "impact/parallel.hpp"

namespace ricochet {
namespace {

using Clock = std::chrono::steady_clock;

/// What a thread works on.
struct Work {
  const Solids& solids;
  const std::vector<Scene>& scenes;
  Queue& queue;
  const std::atomic<bool>& stop;
  const Finished& finished;
  LaneUse& use;
  std::optional<SceneError>& refused;  ///< the first scene that could not start: nothing is begun after it

  template <int W>
  Engine<W> engine(int threads = 1) const {
    const Scene& any = scenes[queue.first()];
    return Engine<W>(solids, any.method(), any.effects, threads);
  }
};

// Runs what is in the engine's lanes and in the queue, `width` lanes at a time. When the queue is empty and half of the
// lanes would idle, the rest moves into an engine of half the width.
template <int W>
bool drain(Engine<W>& engine, const Work& work, int width) {
  const auto fill = [&](int lane) {
    while (engine.idle(lane)) {
      const auto index = work.queue.take();
      if (!index) return;
      try {
        if (const auto outcome = engine.begin(lane, work.scenes[*index], *index)) work.finished(*index, *outcome, 0);
      } catch (const FieldError& error) {
        engine.clear(lane);
        if (!work.refused) work.refused = SceneError(error, *index);
        work.queue.close();
        return;
      }
    }
  };
  const auto finish = [&](const std::vector<typename Engine<W>::Ended>& ended) {
    for (const auto& [lane, outcome] : ended) {
      work.finished(engine.run(lane).index, outcome, engine.run(lane).seconds);
      engine.clear(lane);
    }
  };
  auto counted = Clock::now();
  for (;;) {
    std::vector<int> busy;
    for (int lane = 0; lane < W; ++lane) {
      if (lane < width) fill(lane);
      if (!engine.idle(lane)) busy.push_back(lane);
    }
    if (busy.empty()) return true;
    if constexpr (W > 1)
      if (work.queue.left() == 0 && static_cast<int>(busy.size()) <= W / 2) {
        auto narrow = work.engine<W / 2>();
        for (std::size_t i = 0; i < busy.size(); ++i) narrow.take(static_cast<int>(i), engine.give(busy[i]));
        return drain(narrow, work, W / 2);
      }
    const int steps = engine.steps_between_looks();
    for (int i = 1; i <= steps; ++i) {
      engine.advance_one_step(i == steps);
      finish(engine.look_closely());
    }
    const auto now = Clock::now();
    for (const int lane : busy)
      engine.spend(lane, std::chrono::duration<double>(now - counted).count() / static_cast<double>(busy.size()));
    counted = now;
    work.use.steps += steps * W;
    work.use.busy += steps * static_cast<std::int64_t>(busy.size());
    if (work.stop) return false;
    finish(engine.look());
  }
}

}  // namespace

BuiltSolids::BuiltSolids(const Scene& scene) {
  for (const Body* body : scene.bodies()) solids_.push_back(kept_solid(*body));
}

BuiltSolids::operator Solids() const {
  Solids solids;
  for (const auto& solid : solids_) solids.push_back(solid.get());
  return solids;
}

bool run_queue(const Solids& solids, const std::vector<Scene>& scenes, Queue& queue, int width, int threads,
               const std::atomic<bool>& stop, const Finished& finished, LaneUse& use) {
  std::optional<SceneError> refused;
  const Work work{solids, scenes, queue, stop, finished, use, refused};
  const int used = std::min<int>(width, static_cast<int>(std::min<std::size_t>(queue.left(), lanes)));
  if (used == 0) return true;
  // One impact alone is faster without lanes; from two on, full registers win even if some lanes idle.
  const auto run = [&](auto engine) { return drain(engine, work, used); };
  const bool whole = used == 1 ? run(work.engine<1>(threads)) : run(work.engine<lanes>());
  if (refused) throw SceneError(*refused);
  return whole;
}

Outcome run_scene(const Solids& solids, const Scene& scene, const std::atomic<bool>& stop, const Observer* observer,
                  int threads) {
  Engine<1> engine(solids, scene.method(), scene.effects, static_cast<int>(threads_of(threads)));
  if (const auto outcome = engine.begin(0, scene, 0)) return *outcome;
  Outcome result;
  bool ended = false;
  const auto watch = [&] {
    if (observer && observer->due(engine.run(0).time())) observer->look(engine.snapshot(0));
  };
  watch();
  const auto seen = [&] { return engine.run(0).time() >= observer->until; };
  const auto finish = [&](const std::vector<Engine<1>::Ended>& now) {
    if (ended || now.empty()) return;
    result = now.front().outcome;
    ended = true;
  };
  while (!stop && !(ended && (!observer || seen())) && !(observer && observer->no_longer && seen())) {
    for (int i = 0; i < engine.steps_between_looks(); ++i) {
      engine.advance_one_step();
      finish(engine.look_closely());
      watch();
    }
    if (!ended) finish(engine.look());
    if (ended && (result.status == Status::not_finite || engine.broken(0))) break;
  }
  return result;
}

void check_start(const Solids& solids, const Scene& scene) {
  Engine<1>(solids, scene.method(), scene.effects).begin(0, scene, 0);
}

Snapshot run_until(const Solids& solids, const Scene& scene, double time) {
  Engine<1> engine(solids, scene.method(), scene.effects);
  if (engine.begin(0, scene, 0)) throw Error("run_until: the projectile passes by the target");
  while (engine.run(0).time() < time - engine.run(0).start.step / 2) engine.advance_one_step();
  return engine.snapshot(0);
}

}  // namespace ricochet
