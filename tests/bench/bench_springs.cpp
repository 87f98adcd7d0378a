// What the spring sweep costs: the bound that the core's own square root and division set, the engine's kernel in lanes of several
// widths and alone. `./workbench bench` runs it. Every time is per spring evaluation and lane.

#include <benchmark/benchmark.h>

#include "force/springs.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// The paper's scene at rest but for a small vibration, so that no operand is special.
struct PaperBodies {
  std::shared_ptr<const Lattice> projectile = build_lattice(*disk(800, 1e4, 0.03, 1)), target = build_lattice(*wall(4000, 100, 0.03, 1, 8, 2));
  static const PaperBodies& get() {
    static const PaperBodies bodies;
    return bodies;
  }
};

template <int W>
Moving<W> vibrating(const Lattice& lattice, double stiffness) {
  Moving<W> body{&lattice, {}, {}, {}, Lane<W>::Constant(stiffness)};
  for (auto* values : {&body.position, &body.velocity, &body.force}) values->resize(lattice.nodes());
  for (int i = 0; i < lattice.nodes(); ++i)
    for (int lane = 0; lane < W; ++lane) {
      body.position.set(i, lane, lattice.points[static_cast<std::size_t>(i)]);
      if (i < lattice.free) body.velocity.set(i, lane, 1e-3 * Vec2(std::sin(7.0 * i + lane), std::cos(5.0 * i + lane)));
    }
  return body;
}

void per_spring(benchmark::State& state, double springs) {
  state.counters["ns_per_spring"] = benchmark::Counter(springs * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Independent square roots and divisions, as many as springs need, nothing else: no sweep that uses them can be faster.
template <int W>
void bound(benchmark::State& state) {
  constexpr int count = 64;
  std::array<Lane<W>, count> in, out;
  for (int i = 0; i < count; ++i) in[static_cast<std::size_t>(i)].setConstant(1.0 + i / 7.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(in.data());
    for (std::size_t i = 0; i < count; ++i) out[i] = 1.0 / in[i].sqrt();
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  per_spring(state, count * W);
}

template <int W>
void sweep(benchmark::State& state) {
  const PaperBodies& bodies = PaperBodies::get();
  Moving<W> p = vibrating<W>(*bodies.projectile, 1e4), t = vibrating<W>(*bodies.target, 100);
  const Lane<W> kick = Lane<W>::Constant(1e-3), drift = Lane<W>::Constant(1e-3);
  for (auto _ : state) kick_and_drift(p, kick, drift), kick_and_drift(t, kick, drift);
  per_spring(state, static_cast<double>(bodies.projectile->spring.size() + bodies.target->spring.size()) * W);
}

BENCHMARK(bound<4>)->Name("bound, 1 / sqrt(x)");
BENCHMARK(sweep<4>)->Name("sweep, 4 lanes");
BENCHMARK(sweep<8>)->Name("sweep, 8 lanes");
BENCHMARK(sweep<12>)->Name("sweep, 12 lanes");
BENCHMARK(sweep<1>)->Name("sweep, alone");

}  // namespace

BENCHMARK_MAIN();
