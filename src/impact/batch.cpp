#include "impact/batch.hpp"

#include "core/error.hpp"
#include "impact/engine.hpp"

namespace ricochet {
namespace {

/// What is left to do of a batch.
struct Queue {
  const Lattice &projectile, &target;
  std::span<const Scene> scenes;
  const std::atomic<bool>& stop;
  const Finished& finished;
  std::size_t next = 0;
};

// Runs what is in the engine's lanes and in the queue, `width` lanes at a time. When the queue is empty and half of the lanes
// would idle, the rest moves into an engine of half the width.
template <int W>
bool drain(Engine<W>& engine, Queue& queue, int width) {
  const auto fill = [&](int lane) {
    while (queue.next < queue.scenes.size() && engine.idle(lane)) {
      const std::size_t index = queue.next++;
      try {
        if (const auto outcome = engine.begin(lane, queue.scenes[index], index)) queue.finished(index, *outcome, 0);
      } catch (const FieldError& error) {
        throw SceneError(error, index);
      }
    }
  };
  for (;;) {
    std::vector<int> busy;
    for (int lane = 0; lane < W; ++lane) {
      if (lane < width) fill(lane);
      if (!engine.idle(lane)) busy.push_back(lane);
    }
    if (busy.empty()) return true;
    if constexpr (W > 1)
      if (queue.next == queue.scenes.size() && static_cast<int>(busy.size()) <= W / 2) {
        Engine<W / 2> narrow(queue.projectile, queue.target, engine.method(), queue.scenes.front().effects);
        for (std::size_t i = 0; i < busy.size(); ++i) narrow.take(static_cast<int>(i), engine, busy[i]);
        return drain(narrow, queue, W / 2);
      }
    for (int i = 0; i < engine.steps_between_looks(); ++i) engine.advance_one_step();
    if (queue.stop) return false;
    engine.look([&](int lane, const Outcome& outcome) {
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - engine.run(lane).began).count() / static_cast<double>(busy.size());
      queue.finished(engine.run(lane).index, outcome, seconds);
      engine.clear(lane);
    });
  }
}

template <int W>
bool run_lanes(Queue queue, int width) {
  Engine<W> engine(queue.projectile, queue.target, queue.scenes.front().method(), queue.scenes.front().effects);
  return drain(engine, queue, width);
}

}  // namespace

bool run_batch(const Lattice& projectile, const Lattice& target, std::span<const Scene> scenes, int width, const std::atomic<bool>& stop,
               const Finished& finished) {
  const int used = std::min<int>(width, static_cast<int>(scenes.size()));
  const Queue queue{projectile, target, scenes, stop, finished};
  // One impact alone is faster without lanes; from two on, full registers win even if some lanes idle.
  return used == 1 ? run_lanes<1>(queue, 1) : run_lanes<lanes>(queue, used);
}

Outcome run_scene(const Lattice& projectile, const Lattice& target, const Scene& scene, const std::atomic<bool>& stop, const Observer* observer) {
  Engine<1> engine(projectile, target, scene.method(), scene.effects);
  if (const auto outcome = engine.begin(0, scene, 0)) return *outcome;
  Outcome result;
  bool ended = false;
  const auto watch = [&] {
    if (observer && observer->due(engine.run(0).time())) observer->look(engine.snapshot(0));
  };
  watch();
  while (!stop && !(ended && (!observer || engine.run(0).time() >= observer->until))) {
    for (int i = 0; i < engine.steps_between_looks(); ++i) engine.advance_one_step(), watch();
    if (!ended) engine.look([&](int, const Outcome& outcome) { result = outcome, ended = true; });
    if (ended && result.status == Status::not_finite) break;
  }
  return result;
}

void check_start(const Lattice& projectile, const Lattice& target, const Scene& scene) { launch(scene, projectile, target); }

Snapshot run_until(const Lattice& projectile, const Lattice& target, const Scene& scene, double time) {
  Engine<1> engine(projectile, target, scene.method(), scene.effects);
  if (engine.begin(0, scene, 0)) throw Error("run_until: the projectile passes by the target");
  while (engine.run(0).time() < time - engine.run(0).start.step / 2) engine.advance_one_step();
  return engine.snapshot(0);
}

}  // namespace ricochet
