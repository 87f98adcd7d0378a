// What a lattice costs as it grows: `growth [most nodes]`. Seconds to build, to launch and to search for contacts,
// nanoseconds a node and step of the spring sweep in full lanes and alone, bytes a node and lane of what a run holds.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "body/interior.hpp"
#include "contact/candidates.hpp"
#include "impact/launch/launch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Least time of nine sweeps a node and lane, after one that warms up. [ns]
template <int W>
double sweep(const Solid& solid) {
  Motion<W> body = at_rest<W>(solid);
  body.stiffness.setConstant(1e4);
  for (int i = 0; i < solid.nodes(); ++i)
    for (int lane = 0; lane < W; ++lane) body.v.set(i, lane, 1e-4 * Vec2(std::sin(i), std::cos(i)));
  const Lane<W> step = Lane<W>::Constant(1e-4);
  const int repeats = std::max(1, 200000 / solid.nodes());
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 10; ++round) {
    const double time = seconds([&] {
      for (int i = 0; i < repeats; ++i) kick_and_drift(body, step, step);
    });
    if (round > 0) least = std::min(least, time);
  }
  return least / repeats / solid.nodes() / W * 1e9;
}

}  // namespace

int main(int count, char** values) {
  const int most = count > 1 ? std::atoi(values[1]) : 1000000;
  fmt::print("{:>9} {:>12} {:>14} {:>12} {:>16} {:>26} {:>20}\n", "", "build [s]", "build [s]", "launch [s]",
             "candidates [s]", "sweep [ns/node/lane]", "");
  fmt::print("{:>9} {:>12} {:>14} {:>12} {:>16} {:>20} lanes {:>20}\n", "nodes", "uniform", "poisson_disk", "", "",
             lanes, "alone");
  for (int nodes = 1000; nodes <= most; nodes *= 10) {
    const auto body = [&](const char* placement) {
      return Body{circle(1, 2000), numbers(nodes, 1e4, 0, 1, placement), {}, {}};
    };
    std::shared_ptr<const Solid> solid;
    const double uniform = seconds([&] { solid = build_solid(body("uniform")); });
    const double poisson = seconds([&] { solid = build_solid(body("poisson_disk")); });
    // A disk on its like: where the flight starts, and the search for pairs of a node and a segment.
    Scene scene = paper_scene();
    scene.projectile = scene.target = std::make_shared<Body>(body("poisson_disk"));
    scene.launch.psi1 = 1;
    Start start;
    const double to_launch = seconds([&] { start = launch(scene, {solid.get(), solid.get()}); });
    const Points points = surface_points(*solid);
    const Points flying = placed(points, solid->centre(), start.bodies.front());
    const double to_search = seconds([&] {
      const PlacedSurface below(solid->surface, points);
      candidates_within(flying, below, 1.5 * scene.contact.reach);
    });
    fmt::print("{:>9} {:>12.3f} {:>14.3f} {:>12.4f} {:>16.4f} {:>26.2f} {:>20.2f}\n", nodes, uniform, poisson,
               to_launch, to_search, sweep<lanes>(*solid), sweep<1>(*solid));
  }
  // position, velocity, force of the run, position, velocity of its copy at a step's end, displacement of
  // force-gradient kicks
  fmt::print("a run holds {} bytes a node and lane, a solid {} bytes a spring and {} a node beside its triangles\n",
             8 * 2 * (3 + 3 + 1), sizeof(std::array<int, 2>) + 2 * sizeof(double), sizeof(Vec2) + sizeof(int));
}
