// ricochet_tests "[.benchmark]": what elements cost beside a spring in the same lanes, and those that yield.

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>

#include "body/interior.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

constexpr int nodes = 4900, sweeps = 60, repeats = 15;
constexpr double E = 1e4;

/// A disk in lanes, or half of a sphere's section, in even shear: as many sweeps shear it by 3 %.
class Sheared {
 public:
  Sheared(const BodyNumbers& numbers, const Points& outline, double yield)
      : solid_(build_solid(Body{outline, numbers, {}, {}})), yield_(yield) {}

  double items() const {
    return static_cast<double>(solid_->elements() ? solid_->elements()->nodes.size() : solid_->springs()->list.size());
  }

  /// Of an item and lane. The first sweeps, in which elements reach their yield stress, do not count. [ns]
  double time() {
    Motion<lanes> body = at_rest<lanes>(*solid_);
    body.stiffness.setConstant(E);
    Flow<lanes> flow;
    if (yield_ > 0) {
      flow.yield = yield_;
      flow.memory.resize(solid_->elements()->nodes.size());
      body.flow = &flow;
    }
    for (int i = 0; i < solid_->nodes(); ++i)
      for (int lane = 0; lane < lanes; ++lane)
        body.v.set(i, lane, Vec2(0, solid_->points[static_cast<std::size_t>(i)].x()));
    const Lane<lanes> kick = Lane<lanes>::Zero(), drift = Lane<lanes>::Constant(0.03 / sweeps);
    for (int i = 0; i < sweeps / 2; ++i) kick_and_drift(body, kick, drift);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < sweeps; ++i) kick_and_drift(body, kick, drift);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    yielding_ = std::count_if(flow.memory.begin(), flow.memory.end(),
                              [](const PlasticMemory<lanes>& m) { return (m.strain > 0).all(); });
    return 1e9 * seconds / (sweeps * items() * lanes);
  }

  double share_yielding() const { return static_cast<double>(yielding_) / items(); }

 private:
  std::shared_ptr<const Solid> solid_;
  double yield_;
  std::ptrdiff_t yielding_ = 0;
};

}  // namespace

TEST_CASE("an element that yields beside a spring, in the same lanes", "[.benchmark]") {
  BodyNumbers plane = element_numbers(nodes, E, 0.3), rings = plane, springs;
  plane.state = "plane_strain";
  rings.state = "axisymmetric";
  springs.nodes = nodes;
  const struct {
    const char* name;
    BodyNumbers numbers;
    Points outline;
    double yield;
  } kinds[] = {{"springs", springs, circle(), 0},
               {"plane strain, elastic", plane, circle(), 1e3 * E},
               {"plane strain, all yielding", plane, circle(), 1e-3 * E},
               {"axisymmetric, elastic", rings, half_circle(), 1e3 * E},
               {"axisymmetric, all yielding", rings, half_circle(), 1e-3 * E},
               {"triangles, polynomial", plane, circle(), 0},
               {"rings, polynomial", rings, half_circle(), 0}};
  std::vector<Sheared> bodies;
  for (const auto& kind : kinds) bodies.emplace_back(kind.numbers, kind.outline, kind.yield);
  std::vector<double> least(bodies.size(), 1e9);
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t k = 0; k < bodies.size(); ++k) least[k] = std::min(least[k], bodies[k].time());
  for (std::size_t k = 0; k < bodies.size(); ++k)
    fmt::print("{}: {:.2f} ns an item and lane, {:.1f} springs, {:.0f} % of them yield\n", kinds[k].name, least[k],
               least[k] / least[0], 100 * bodies[k].share_yielding());
  CHECK(bodies[2].share_yielding() == 1);
  CHECK(bodies[4].share_yielding() == 1);
}
