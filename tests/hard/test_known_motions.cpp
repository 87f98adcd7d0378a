// Hard cases whose motion is known: masses on a spring, a wave along a bar, rods, a slow smooth disk.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "core/rng.hpp"
#include "hard/alone.hpp"
#include "hard/table.hpp"
#include "impact/batch.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

/// A body of given points and springs, all free, the first `rim` of them its rim.
std::shared_ptr<Solid> lattice_of(const Points& points, const std::vector<std::array<int, 2>>& edges, int rim) {
  auto solid = std::make_shared<Solid>();
  solid->points = points;
  solid->free = static_cast<int>(points.size());
  std::vector<std::array<int, 2>> sorted;
  for (const auto& [a, b] : edges) sorted.push_back({std::min(a, b), std::max(a, b)});
  std::sort(sorted.begin(), sorted.end());
  Springs springs;
  springs.law.quartic = 0;
  springs.first.assign(points.size() + 1, 0);
  for (const auto& [a, b] : sorted) {
    springs.list.push_back(
        {a, b, false, (points[static_cast<std::size_t>(b)] - points[static_cast<std::size_t>(a)]).norm(), 1});
    ++springs.first[static_cast<std::size_t>(a) + 1];
  }
  for (std::size_t i = 0; i + 1 < springs.first.size(); ++i) springs.first[i + 1] += springs.first[i];
  solid->interior = springs;
  Mesh<2> surface;
  for (int i = 0; i < rim; ++i) {
    surface.node.push_back(i);
    solid->smooth.push_back(points[static_cast<std::size_t>(i)]);
  }
  surface.cell = ring(rim);
  solid->surface = surface;
  return solid;
}

/// A bar along y, symmetric about x = 0: a column of `cells` nodes `spacing` apart in the middle, one on either side
/// half a spacing higher, and springs along them and between neighbours. Its lower end is the middle's node, its upper
/// one flat. Free to narrow, it holds no force across: E A = 3 k h, mass / length = 3 m / h, so its waves have the
/// speed h sqrt(k / m), and it is cells h long by its mass.
std::shared_ptr<Solid> bar_of(double length, int cells, double bottom) {
  const double h = length / cells, width = h * std::sqrt(3) / 2;
  Points points{{0, bottom}};
  std::vector<std::array<int, 2>> edges;
  // The rim first: up on the right, down on the left; then the middle.
  for (int i = 0; i < cells; ++i) points.push_back({width, bottom + (i + 0.5) * h});
  for (int i = cells - 1; i >= 0; --i) points.push_back({-width, bottom + (i + 0.5) * h});
  const int rim = static_cast<int>(points.size());
  for (int i = 1; i < cells; ++i) points.push_back({0, bottom + i * h});
  const auto right = [](int i) { return 1 + i; };
  const auto left = [&](int i) { return 2 * cells - i; };
  const auto middle = [&](int i) { return i == 0 ? 0 : rim + i - 1; };
  for (int i = 0; i < cells; ++i)
    for (const auto& column : {std::function<int(int)>(right), std::function<int(int)>(left)}) {
      edges.push_back({middle(i), column(i)});
      if (i + 1 < cells) {
        edges.push_back({column(i), column(i + 1)});
        edges.push_back({column(i), middle(i + 1)});
      }
    }
  for (int i = 0; i + 1 < cells; ++i) edges.push_back({middle(i), middle(i + 1)});
  edges.push_back({right(cells - 1), left(cells - 1)});
  return lattice_of(points, edges, rim);
}

/// A symmetric disk: a hub, a rim whose lowest node is at (0, -1), spokes, and springs from each rim node to the next
/// and the one after.
std::shared_ptr<Solid> wheel_of(int nodes) {
  Points points;
  std::vector<std::array<int, 2>> edges;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    points.push_back({std::sin(angle), -std::cos(angle)});
    edges.push_back({i, (i + 1) % nodes});
    edges.push_back({i, (i + 2) % nodes});
    edges.push_back({i, nodes});
  }
  points.push_back({0, 0});
  return lattice_of(points, edges, nodes);
}

}  // namespace

TEST_CASE("hard 22: a slow smooth disk leaves a flat rigid wall as fast as it came") {
  Case of(22, "analytic anchors");
  Scene scene = small_scene(1, 0, 0);
  Body rigid = *scene.target;
  std::fill(rigid.anchored.begin(), rigid.anchored.end(), true);
  scene.target = std::make_shared<Body>(rigid);
  const SolidPointer wall = build_solid(*scene.target), wheel = wheel_of(24), random = build_solid(*scene.projectile);
  std::vector<double> lost, turned;
  for (const double speed : {0.3, 0.1, 0.03, 0.01, 0.003}) {
    scene.launch.speed = speed;
    const Outcome a = run_scene({wheel.get(), wall.get()}, scene, go_on),
                  b = run_scene({random.get(), wall.get()}, scene, go_on);
    REQUIRE((a.status == Status::finished && b.status == Status::finished));
    CHECK((a.e <= 1 + 1e-7 && b.e <= 1 + 1e-7));
    lost.push_back(std::abs(1 - a.e));
    turned.push_back(std::abs(1 - (b.after.of(0).translation + b.after.of(0).rotation) / b.before.total()));
  }
  of.at_most(1e-6, lost.back(), "|1 - e| of a symmetric disk at 0.003 c");
  of.at_most(1e-6, turned.back(),
             "energy not in flight and spin, of a random disk at 0.003 c (which turns: the node that hits is not below "
             "its centre)");
}

TEST_CASE("hard 22: two masses on a spring swing as a cosine") {
  Case of(22, "analytic anchors");
  // Far above the wall that a scene must have: one spring, stretched by 0.01 of its length.
  const auto pair = lattice_of({{-0.5, 0}, {0.5, 0}}, {{0, 1}}, 2);
  Scene scene = small_scene(1, 0, 0);
  scene.integration.method = "blanes_moan_srkn14a";
  scene.integration.theta = 0.3;
  Alone alone(pair, build_solid(*scene.target), scene);
  alone.engine().change([&](Motions<1>& bodies) {
    for (int i = 0; i < bodies[1].solid->nodes(); ++i) bodies[1].q[2 * i + 1] -= 10;
    for (int i : {0, 1}) {
      bodies[0].q.set(i, 0, 1.01 * pair->points[static_cast<std::size_t>(i)]);
      bodies[0].v.set(i, 0, Vec2(0, 0));
    }
  });
  const double omega = std::sqrt(2 * 1e4);
  double worst = 0;
  for (int look = 1; look <= 1000; ++look) {
    alone.steps(3);
    const Snapshot s = alone.now();
    worst = std::max(worst, std::abs((s.bodies[0].place[1] - s.bodies[0].place[0]).norm() - 1 -
                                     0.01 * std::cos(omega * alone.step() * 3 * look)) /
                                0.01);
  }
  of.at_most(1e-6, worst, "two masses on a spring: stretch less cosine, over its amplitude, 1e3 rad");
}

TEST_CASE("hard 22: a wave runs along a bar, and rods of lengths 1 and 2 part, at the rates of the lattice") {
  Case of(22, "analytic anchors");
  const auto rate = [](const std::vector<double>& h, const std::vector<double>& error) {
    return std::log(error.front() / error.back()) / std::log(h.front() / h.back());
  };
  std::vector<double> spacing, period_error, rod_error;
  for (const int cells : {16, 32, 64, 128}) {
    const double length = 4, h = length / cells, c = h * std::sqrt(1e4);
    const auto bar = bar_of(length, cells, 0);
    Scene scene = small_scene(1, 0, 0);
    scene.integration.theta = 0.3;
    Alone alone(bar, build_solid(*scene.target), scene);
    const auto mode = [&](int i) {
      return std::cos(std::numbers::pi * bar->points[static_cast<std::size_t>(i)].y() / length);
    };
    alone.engine().change([&](Motions<1>& bodies) {
      for (int i = 0; i < bodies[1].solid->nodes(); ++i) bodies[1].q[2 * i + 1] -= 20;
      for (int i = 0; i < bar->nodes(); ++i) {
        bodies[0].q.set(i, 0, bar->points[static_cast<std::size_t>(i)] + Vec2(0, 1e-5 * mode(i)));
        bodies[0].v.set(i, 0, Vec2(0, 0));
      }
    });
    // The amplitude of the slowest vibration, by projection; it passes zero twice a period.
    double before = 1, first = 0, last = 0;
    int crossings = 0;
    for (int step = 1; crossings < 9; ++step) {
      alone.steps(1);
      const Snapshot s = alone.now();
      double amplitude = 0;
      for (int i = 0; i < bar->nodes(); ++i)
        amplitude +=
            (s.bodies[0].place[static_cast<std::size_t>(i)].y() - bar->points[static_cast<std::size_t>(i)].y()) *
            mode(i);
      if (before * amplitude < 0) {
        last = alone.step() * (step - std::abs(amplitude) / (std::abs(amplitude) + std::abs(before)));
        if (crossings++ == 0) first = last;
      }
      before = amplitude;
    }
    const double exact = 2 * length / c;
    spacing.push_back(h);
    period_error.push_back(std::abs((last - first) / 4 / exact - 1));

    // A rod that hits one twice as long stops dead and leaves it half its speed: e = 1/2.
    const auto upper = bar_of(100, cells, 0), lower = bar_of(200, 2 * cells, -300);
    Scene rods = paper_scene();
    rods.projectile = disk(60, 1e4, 0, 1);
    rods.target = disk(60, 1e4, 0, 1);
    rods.launch.speed = 1e-3 * (100.0 / cells) * std::sqrt(1e4);
    rods.launch.psi1 = 0;
    rods.contact.xi = 7000;
    rods.contact.reach = 0.05;
    rods.contact.sides = "two";
    const Outcome o = run_scene({upper.get(), lower.get()}, rods, go_on);
    INFO(o.reason);
    CHECK(o.status == Status::finished);
    rod_error.push_back(std::abs(o.e - 0.5));
  }
  of.at_most(2e-3, period_error.back(), "bar: relative error of the slowest period, 128 spacings long");
  of.at_most(0.3, std::abs(rate(spacing, period_error) - 2), "the rate at which it falls with the spacing, less 2");
  of.at_most(0.03, rod_error.back(), "rods 1 : 2: |e - 1/2|, 128 and 256 spacings long");
  of.at_most(1.0, 0.3 / rate(spacing, rod_error), "0.3 over the rate at which that falls");
}
