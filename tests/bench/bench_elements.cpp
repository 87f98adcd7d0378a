// What the sweep over elements costs beside that over springs of the same nodes, in four lanes and alone. `./workbench
// bench` runs it. Every time is per item (spring or triangle) and lane: a triangle may take as much as two
// springs, of which a node has three and of triangles two.

#include <benchmark/benchmark.h>

#include <algorithm>

#include "body/interior.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

constexpr int nodes_of_disk = 4900;

std::shared_ptr<const Solid> built(const BodyNumbers& numbers) { return build_solid(Body{circle(), numbers, {}, {}}); }

std::shared_ptr<const Solid> of_springs() {
  BodyNumbers numbers;
  numbers.nodes = nodes_of_disk;
  return built(numbers);
}

template <int W>
void sweep_of(benchmark::State& state, const std::shared_ptr<const Solid>& solid, double items) {
  Motion<W> body = at_rest<W>(*solid);
  body.stiffness.setConstant(1e4);
  for (int c = 0; c < body.v.size(); ++c)
    for (int lane = 0; lane < W; ++lane) body.v[c][lane] = 1e-3 * std::sin(7.0 * c + lane);
  const Lane<W> step = Lane<W>::Constant(1e-4);
  for (auto _ : state) kick_and_drift(body, step, step);
  state.counters["an_item"] =
      benchmark::Counter(items * W, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <int W>
void springs(benchmark::State& state) {
  const auto solid = of_springs();
  sweep_of<W>(state, solid, static_cast<double>(solid->springs()->list.size()));
}

template <int W, int law>
void triangles(benchmark::State& state) {
  const auto solid = built(element_numbers(nodes_of_disk, 1e4, 0.3, solid_law_names()[law]));
  sweep_of<W>(state, solid, solid->elements()->size());
}

// As in bench_springs: the least of many short runs is the core's own.
double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

BENCHMARK(springs<4>)->Name("springs, 4 lanes")->ComputeStatistics("least", least);
BENCHMARK(triangles<4, 0>)->Name("polynomial, 4 lanes")->ComputeStatistics("least", least);
BENCHMARK(triangles<4, 1>)->Name("linear, 4 lanes")->ComputeStatistics("least", least);
BENCHMARK(triangles<4, 2>)->Name("st_venant_kirchhoff, 4 lanes")->ComputeStatistics("least", least);
BENCHMARK(springs<1>)->Name("springs, alone")->ComputeStatistics("least", least);
BENCHMARK(triangles<1, 0>)->Name("polynomial, alone")->ComputeStatistics("least", least);
BENCHMARK(triangles<1, 1>)->Name("linear, alone")->ComputeStatistics("least", least);

}  // namespace

BENCHMARK_MAIN();
