// Hard cases of single impacts: conservation, symmetry, extreme ratios, angles, speeds and spins, and what an impact must come to.

#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "force/contact/contact.hpp"
#include "hard/alone.hpp"
#include "hard/table.hpp"
#include "impact/batch.hpp"
#include "lattice/triangulate.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

Outcome outcome_of(const Scene& scene) { return run_scene(*build_lattice(*scene.projectile), *build_lattice(*scene.target), scene, go_on); }

struct Momenta {
  Vec2 linear = Vec2::Zero();
  double angular = 0;  ///< about the origin
};

Momenta momenta(const Points& places, const Points& velocities, double mass = 1) {
  Momenta m;
  for (std::size_t i = 0; i < places.size(); ++i) m.linear += mass * velocities[i], m.angular += mass * cross(places[i], velocities[i]);
  return m;
}

// Greatest |E - E0| / E0 at the ends of all steps of an impact.
std::pair<Outcome, double> energy_error(const Scene& scene) {
  double first = 0, worst = 0;
  const Observer observer{0, [](double) { return true; }, [&](const Snapshot& s) {
    if (first == 0) first = s.energy.total();
    worst = std::max(worst, std::abs(s.energy.total() / first - 1));
  }};
  const Outcome o = run_scene(*build_lattice(*scene.projectile), *build_lattice(*scene.target), scene, go_on, &observer);
  return {o, worst};
}

Lattice moved(Lattice lattice, const std::function<Vec2(const Vec2&)>& to) {
  for (Points* points : {&lattice.points, &lattice.smooth_rim})
    for (Vec2& p : *points) p = to(p);
  return lattice;
}

/// A lattice of given points and springs, all free, the first `rim` of them its rim.
std::shared_ptr<Lattice> lattice_of(const Points& points, const std::vector<std::array<int, 2>>& edges, int rim) {
  auto lattice = std::make_shared<Lattice>();
  lattice->points = points, lattice->free = static_cast<int>(points.size()), lattice->edges = edges;
  std::vector<std::array<int, 2>> sorted;
  for (const auto& [a, b] : edges) sorted.push_back({std::min(a, b), std::max(a, b)});
  std::sort(sorted.begin(), sorted.end());
  lattice->first.assign(points.size() + 1, 0);
  for (const auto& [a, b] : sorted) {
    lattice->spring.push_back({a, b, false, (points[static_cast<std::size_t>(b)] - points[static_cast<std::size_t>(a)]).norm(), 1});
    ++lattice->first[static_cast<std::size_t>(a) + 1];
  }
  for (std::size_t i = 0; i + 1 < lattice->first.size(); ++i) lattice->first[i + 1] += lattice->first[i];
  for (int i = 0; i < rim; ++i) lattice->rim.push_back(i), lattice->smooth_rim.push_back(points[static_cast<std::size_t>(i)]);
  return lattice;
}

/// A bar along y of two columns of nodes, zigzag, its springs `spacing` long; the lower end at y = `bottom`.
std::shared_ptr<Lattice> zigzag_bar(double length, int cells, double bottom) {
  const double spacing = length / cells, width = spacing * std::sqrt(3) / 2;
  Points points;
  std::vector<std::array<int, 2>> edges;
  // The rim runs up one side and down the other: column 0 has cells + 1 nodes, column 1 lies half a spacing higher and has cells.
  const int upper = cells + 1;
  for (int i = 0; i <= cells; ++i) points.push_back({width / 2, bottom + i * spacing});
  for (int i = cells - 1; i >= 0; --i) points.push_back({-width / 2, bottom + (i + 0.5) * spacing});
  const auto other = [&](int i) { return upper + cells - 1 - i; };
  for (int i = 0; i < cells; ++i) {
    edges.push_back({i, i + 1});
    if (i + 1 < cells) edges.push_back({other(i), other(i + 1)});
    edges.push_back({i, other(i)}), edges.push_back({i + 1, other(i)});
  }
  return lattice_of(points, edges, static_cast<int>(points.size()));
}

/// Everything of an outcome but what depends on which end of the contact leads.
std::vector<double> mirrored_values(const Outcome& o) {
  std::vector<double> values;
  for (const auto& [field, value] : Outcome::fields()) {
    double v = value(o);
    if (field.name == "centre_offset" || field.name == "tan_alpha" || field.name == "e_alpha") continue;
    values.push_back(v);
  }
  return values;
}

}  // namespace

TEST_CASE("hard 4: the energy of a smooth contact closes") {
  Case of(4, "energy on a smooth contact");
  for (const auto& [method, allowed] : {std::pair{"pefrl", 1e-6}, std::pair{"verlet", 1e-3}}) {
    double worst = 0;
    for (int seed = 1; seed <= 3; ++seed) {
      Scene scene;
      scene.projectile = disk(400, 1e4, 0, seed), scene.target = wall(1600, 100, 0, seed, 6, 2);
      scene.launch.psi1 = 1, scene.integration.method = method, scene.integration.theta = 1.8;
      const auto [outcome, error] = energy_error(scene);
      CHECK(outcome.status == Status::finished);
      worst = std::max(worst, error);
    }
    of.at_most(allowed, worst, fmt::format("largest |E - E0| / E0 at any step, {}, theta 1.8", method));
  }
  int ended = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    Scene scene = small_scene(seed, 1, 0);
    scene.launch.speed = 0.5, scene.integration.method = "verlet", scene.integration.theta = 1.95, scene.integration.energy_tolerance = 1e-2;
    const auto [outcome, error] = energy_error(scene);
    ended += outcome.status == Status::energy_drift ? outcome.reason.find("give a step half as long") != std::string::npos : outcome.status != Status::finished || error < 2e-2;
    CHECK((error < 1e-2 || outcome.status != Status::finished || outcome.energy_drift <= 1e-2));
  }
  of.all(5, ended, "fast impacts at verlet's limit that end energy_drift, or stay within 1e-2");
}

TEST_CASE("hard 5: a free disk keeps its momentum and angular momentum over 1e5 steps") {
  Case of(5, "momentum and angular momentum of a free disk, 1e5 steps");
  double linear = 0, angular = 0, by_gradient = 0;
  for (const Method& m : methods()) {
    const auto change = [&](const Vec2& velocity, double spin) {
      const auto alone = free_disk(m.name, 0.4 * m.stability_limit, velocity, spin, 1e-3);
      const Snapshot first = alone->now();
      alone->steps(100000);
      const Snapshot last = alone->now();
      const Momenta before = momenta(first.projectile, first.projectile_velocity), after = momenta(last.projectile, last.projectile_velocity);
      return std::pair((after.linear - before.linear).norm() / before.linear.norm(), std::abs(after.angular / before.angular - 1));
    };
    linear = std::max(linear, change(Vec2(0.1, 0), 0).first);
    // A step that takes forces at displaced places, but applies them where the nodes are, turns a body that vibrates by its own error.
    const bool gradient = std::any_of(m.stages.begin(), m.stages.end(), [](const Stage& s) { return s.gradient != 0; });
    double& worst = gradient ? by_gradient : !m.symplectic() ? by_gradient : angular;
    worst = std::max(worst, change(Vec2(0, 0), 0.1).second);
  }
  of.at_most(1e-13, linear, "relative change of momentum at 0.1 c, all methods");
  of.at_most(1e-13, angular, "relative change of angular momentum about the centre at spin 0.1 c/R, symplectic methods without a force gradient");
  of.at_most(1e-8, by_gradient, "the same, force-gradient and Runge-Kutta methods: their own error, not rounding");
}

TEST_CASE("hard 7: the mirrored scene has the mirrored outcome, bit for bit") {
  Case of(7, "mirror x -> -x with the same node order");
  int equal = 0, scenes = 0;
  for (const char* sides : {"one", "two"})
    for (const double psi1 : {0.0, 1.0, 4.0})
      for (int seed = 1; seed <= 3; ++seed) {
        Scene scene = small_scene(seed, 1, 0.03), other;
        scene.contact.sides = sides;
        scene.launch.psi1 = not_given, scene.launch.normal_speed = 0.1, scene.launch.tangential_speed = 0.1 * psi1, scene.launch.spin = 0.02;
        other = scene;
        other.launch.tangential_speed *= -1, other.launch.spin *= -1;
        const auto p = build_lattice(*scene.projectile), t = build_lattice(*scene.target);
        const auto mirror = [](const Vec2& x) { return Vec2(-x.x(), x.y()); };
        const Outcome a = run_scene(*p, *t, scene, go_on), b = run_scene(moved(*p, mirror), moved(*t, mirror), other, go_on);
        REQUIRE(a.status == Status::finished);
        Outcome back = b;
        back.psi1 *= -1, back.psi2 *= -1, back.vt *= -1, back.omega *= -1, back.impulse_t *= -1;
        const auto mine = mirrored_values(a), theirs = mirrored_values(back);
        bool same = a.status == b.status;
        for (std::size_t i = 0; i < mine.size(); ++i) same = same && (mine[i] == theirs[i] || (std::isnan(mine[i]) && std::isnan(theirs[i])));
        equal += same, ++scenes;
      }
  of.all(scenes, equal, "scenes whose outcomes are equal (but for which end of the contact leads)");
}

TEST_CASE("hard 8: a scene turned by 90 degrees has the same outcome, one shifted by 1e6 R loses digits") {
  Case of(8, "the scene turned by 90 degrees; shifted by 1e6 R");
  double turned = 0, shifted = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    Scene scene = small_scene(seed, 1, 0);
    const auto p = build_lattice(*scene.projectile), t = build_lattice(*scene.target);
    Alone straight(p, t, scene);
    const auto count = static_cast<std::int64_t>(8 / straight.step());
    const Snapshot start = straight.now();
    straight.steps(count);
    const auto mean = [](const Points& v) {
      Vec2 sum = Vec2::Zero();
      for (const Vec2& x : v) sum += x / static_cast<double>(v.size());
      return sum;
    };
    const Vec2 after = mean(straight.now().projectile_velocity);
    REQUIRE(straight.now().energy.contact == 0);
    REQUIRE(after.y() > 0.01);
    const auto with = [&](const std::function<Vec2(const Vec2&)>& place, const std::function<Vec2(const Vec2&)>& direction, double at) {
      Scene other = scene;
      other.launch.at = at;
      Alone alone(std::make_shared<Lattice>(moved(*p, place)), std::make_shared<Lattice>(moved(*t, place)), other);
      alone.engine().change([&](Engine<1>::Bodies& bodies) {
        for (int i = 0; i < p->nodes(); ++i) bodies[0].position.set(i, 0, place(start.projectile[static_cast<std::size_t>(i)])), bodies[0].velocity.set(i, 0, direction(start.projectile_velocity[static_cast<std::size_t>(i)]));
        for (int i = 0; i < t->nodes(); ++i) bodies[1].position.set(i, 0, place(start.target[static_cast<std::size_t>(i)])), bodies[1].velocity.set(i, 0, Vec2(0, 0));
      });
      alone.steps(count);
      return mean(alone.now().projectile_velocity);
    };
    const auto turn = [](const Vec2& x) { return Vec2(-x.y(), x.x()); };
    const Vec2 aside = with(turn, turn, t->centre().x() - 0.5);
    turned = std::max(turned, std::abs(aside.x() + after.y()) / 0.1);
    const auto shift = [](const Vec2& x) { return Vec2(x.x() + 1e6, x.y() + 1e6); };
    const Vec2 away = with(shift, [](const Vec2& v) { return v; }, 1e6);
    shifted = std::max(shifted, std::abs(away.y() - after.y()) / 0.1);
  }
  of.at_most(1e-9, turned, "change of e, turned");
  of.told(shifted, "change of e, shifted by 1e6 R: ten digits of a place are left, so it is reported only");
}
