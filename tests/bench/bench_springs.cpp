// What the spring sweep costs: the bound that the core's own square root and division set, the engine's kernel in lanes
// of several widths and alone, and beside it the ways in variants.hpp. `./workbench bench` runs it. Every time is per
// spring evaluation and lane.

#include <benchmark/benchmark.h>

#include <algorithm>

#include "body/interior.hpp"
#include "scenes.hpp"
#include "variants.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// The paper's scene at rest but for a small vibration, so that no operand is special.
struct PaperBodies {
  std::shared_ptr<const Solid> projectile = build_solid(*disk(800, 1e4, 0.03, 1)),
                               target = build_solid(*wall(4000, 100, 0.03, 1, 8, 2));
  static const PaperBodies& get() {
    static const PaperBodies bodies;
    return bodies;
  }
};

template <int W>
Motion<W> vibrating(const Solid& solid, double stiffness) {
  Motion<W> body = at_rest<W>(solid);
  body.stiffness.setConstant(stiffness);
  for (int i = 0; i < solid.free; ++i)
    for (int lane = 0; lane < W; ++lane)
      body.v.set(i, lane, 1e-3 * Vec2(std::sin(7.0 * i + lane), std::cos(5.0 * i + lane)));
  return body;
}

void per_spring(benchmark::State& state, double springs) {
  state.counters["a_spring"] =
      benchmark::Counter(springs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Independent square roots and divisions, as many as springs need, nothing else: no sweep that uses them can be
/// faster.
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

/// Two bodies that vibrate, and how many springs they have.
template <int W>
struct Pair {
  Motion<W> projectile, target;
  double springs;
  Pair(const Solid& p, const Solid& t)
      : projectile(vibrating<W>(p, 1e4)),
        target(vibrating<W>(t, 100)),
        springs(static_cast<double>(p.springs()->list.size() + t.springs()->list.size())) {}
};

template <int W>
const Lane<W> step = Lane<W>::Constant(1e-3);

const auto as_built = [](auto& body, const auto& kick, const auto& drift) {
  kick_and_drift<2>(body, *body.solid->springs(), kick, drift);
};

/// `way(body, kick, drift)`, after a check that it does what kick_and_drift does.
template <int W, class Way>
void sweep(benchmark::State& state, const Solid& projectile, const Solid& target, Way&& way) {
  Pair<W> bodies(projectile, target), checked = bodies;
  for (auto* body : {&bodies.projectile, &bodies.target}) {
    way(*body, step<W>, step<W>);
    way(*body, step<W>, step<W>);
  }
  for (auto* body : {&checked.projectile, &checked.target}) {
    as_built(*body, step<W>, step<W>);
    as_built(*body, step<W>, step<W>);
  }
  for (int i = 0; i < target.free; ++i)
    if (!((bodies.target.q.at(i, 0) - checked.target.q.at(i, 0)).norm() <= 1e-13))
      return state.SkipWithError("this is another sweep");
  for (auto _ : state) {
    way(bodies.projectile, step<W>, step<W>);
    way(bodies.target, step<W>, step<W>);
  }
  per_spring(state, bodies.springs * W);
}

template <int W>
void sweep(benchmark::State& state) {
  const PaperBodies& bodies = PaperBodies::get();
  sweep<W>(state, *bodies.projectile, *bodies.target, as_built);
}

template <int W>
void raw(benchmark::State& state) {
  const PaperBodies& bodies = PaperBodies::get();
  sweep<W>(state, *bodies.projectile, *bodies.target,
           [](auto& body, const auto& kick, const auto& drift) { variants::raw(body, kick, drift); });
}

template <class Place>
void by_place(benchmark::State& state) {
  const PaperBodies& bodies = PaperBodies::get();
  sweep<4>(state, *bodies.projectile, *bodies.target,
           [](auto& body, const auto& kick, const auto& drift) { variants::by_place<Place>(body, kick, drift); });
}

void edge_list(benchmark::State& state) {
  const PaperBodies& bodies = PaperBodies::get();
  sweep<4>(state, *bodies.projectile, *bodies.target,
           [](auto& body, const auto& kick, const auto& drift) { variants::edge_list(body, kick, drift); });
}

template <int ahead, class Root, int W>
void by_node(benchmark::State& state) {
  const PaperBodies& bodies = PaperBodies::get();
  sweep<W>(state, *bodies.projectile, *bodies.target,
           [](auto& body, const auto& kick, const auto& drift) { variants::by_node<ahead, Root>(body, kick, drift); });
}

template <auto order>
void ordered(benchmark::State& state) {
  const PaperBodies& bodies = PaperBodies::get();
  sweep<4>(state, variants::renumbered(*bodies.projectile, order(*bodies.projectile)),
           variants::renumbered(*bodies.target, order(*bodies.target)), as_built);
}

void displacements(benchmark::State& state) {
  const PaperBodies& bodies = PaperBodies::get();
  Pair<4> pair(*bodies.projectile, *bodies.target);
  const auto displaced = [](Motion<4>& body) {
    const Solid& solid = *body.solid;
    std::vector<Vec2> rest;
    each_spring(*solid.springs(), solid.free, [&](int i, int, const Spring& spring) {
      rest.push_back(solid.points[static_cast<std::size_t>(spring.other)] - solid.points[static_cast<std::size_t>(i)]);
    });
    for (int i = 0; i < solid.nodes(); ++i)
      for (int lane = 0; lane < 4; ++lane) body.q.set(i, lane, Vec2(0, 0));
    return rest;
  };
  const std::vector<Vec2> of_projectile = displaced(pair.projectile), of_target = displaced(pair.target);
  for (auto _ : state) {
    variants::displacements(pair.projectile, of_projectile, step<4>, step<4>);
    variants::displacements(pair.target, of_target, step<4>, step<4>);
  }
  per_spring(state, pair.springs * 4);
}

// Other guests of a machine slow everything but the divider by half for seconds or hours: the least of many short runs
// is the core's own.
double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

BENCHMARK(bound<4>)->Name("bound, 1 / sqrt(x)")->ComputeStatistics("least", least);
BENCHMARK(sweep<4>)->Name("sweep, 4 lanes")->ComputeStatistics("least", least);
BENCHMARK(raw<4>)->Name("x and y as numbers of their own, 4 lanes")->ComputeStatistics("least", least);
BENCHMARK(by_place<Place<4, 2>>)->Name("Place, copied by hand, 4 lanes")->ComputeStatistics("least", least);
BENCHMARK(by_place<variants::Copied<4>>)
    ->Name("Place, copied as the compiler does, 4 lanes")
    ->ComputeStatistics("least", least);
BENCHMARK(sweep<8>)->Name("sweep, 8 lanes")->ComputeStatistics("least", least);
BENCHMARK(sweep<2>)->Name("sweep, 2 lanes")->ComputeStatistics("least", least);
BENCHMARK(raw<2>)->Name("x and y as numbers of their own, 2 lanes")->ComputeStatistics("least", least);
BENCHMARK(sweep<1>)->Name("sweep, alone")->ComputeStatistics("least", least);
BENCHMARK(raw<1>)->Name("x and y as numbers of their own, alone")->ComputeStatistics("least", least);
BENCHMARK(edge_list)->Name("flat edge list, kick and drift apart")->ComputeStatistics("least", least);
BENCHMARK(by_node<8, variants::Divider, 4>)->Name("prefetch 8 springs ahead")->ComputeStatistics("least", least);
BENCHMARK(by_node<0, variants::Newton, 4>)
    ->Name("4 lanes, Newton's steps instead of root and division")
    ->ComputeStatistics("least", least);
#ifdef __AVX512F__
BENCHMARK(by_node<0, variants::Estimate, 8>)
    ->Name("8 lanes, root from the processor's estimate")
    ->ComputeStatistics("least", least);
#endif
BENCHMARK(displacements)->Name("displacements")->ComputeStatistics("least", least);
BENCHMARK(ordered<variants::by_rows>)->Name("nodes by rows")->ComputeStatistics("least", least);
BENCHMARK(ordered<variants::at_random>)->Name("nodes at random")->ComputeStatistics("least", least);

}  // namespace

BENCHMARK_MAIN();
