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

/// A bar along y, symmetric about x = 0: a column of `cells` nodes `spacing` apart in the middle, one on either side half a spacing higher,
/// and springs along them and between neighbours. Its lower end is the middle's node, its upper one flat. Free to narrow, it holds no force
/// across: E A = 3 k h, mass / length = 3 m / h, so its waves have the speed h sqrt(k / m), and it is cells h long by its mass.
std::shared_ptr<Lattice> bar_of(double length, int cells, double bottom) {
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
      if (i + 1 < cells) edges.push_back({column(i), column(i + 1)}), edges.push_back({column(i), middle(i + 1)});
    }
  for (int i = 0; i + 1 < cells; ++i) edges.push_back({middle(i), middle(i + 1)});
  edges.push_back({right(cells - 1), left(cells - 1)});
  return lattice_of(points, edges, rim);
}

/// A symmetric disk: a hub, a rim whose lowest node is at (0, -1), spokes, and springs from each rim node to the next and the one after.
std::shared_ptr<Lattice> wheel_of(int nodes) {
  Points points;
  std::vector<std::array<int, 2>> edges;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    points.push_back({std::sin(angle), -std::cos(angle)});
    edges.push_back({i, (i + 1) % nodes}), edges.push_back({i, (i + 2) % nodes}), edges.push_back({i, nodes});
  }
  points.push_back({0, 0});
  return lattice_of(points, edges, nodes);
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
  // Springs so soft that the repulsion is stiffer, and steps as long as the springs alone allow: `unstable` comes first where the bound of the
  // frequency tells, energy_drift where it does not.
  for (const double tolerance : {1e-2, 3e-4}) {
    int right = 0, all = 0, drifted = 0, unstable = 0;
    for (const double theta : {0.3, 0.5})
      for (int seed = 1; seed <= 10; ++seed) {
        Scene scene = small_scene(seed, 1, 0);
        scene.projectile = disk(60, 300, 0, seed);
        scene.launch.speed = 0.5 + 0.06 * seed, scene.integration.method = "verlet", scene.integration.theta = theta, scene.integration.energy_tolerance = tolerance;
        const auto [outcome, error] = energy_error(scene);
        INFO(theta << " " << seed << " " << name_of(outcome.status) << " " << outcome.reason << " " << error);
        const bool drift = outcome.status == Status::energy_drift;
        const bool fine = drift ? outcome.energy_drift > tolerance && outcome.reason.find("give a step half as long") != std::string::npos : outcome.status == Status::unstable || outcome.energy_drift <= tolerance;
        CHECK(fine);
        right += fine, ++all, drifted += drift, unstable += outcome.status == Status::unstable;
      }
    CHECK(drifted + unstable >= 3);
    if (tolerance < 1e-2) CHECK(drifted >= 3);
    of.all(all, right, fmt::format("coarse runs that end energy_drift or unstable if they stray beyond {:g} ({} and {} do)", tolerance, drifted, unstable));
  }
}

TEST_CASE("hard 5: a free disk keeps its momentum and angular momentum over 1e5 steps") {
  Case of(5, "momentum and angular momentum of a free disk, 1e5 steps");
  double linear = 0, angular = 0, by_gradient = 0;
  for (const Method& m : methods()) {
    const auto change = [&](const Vec2& velocity, double spin) {
      const auto alone = free_disk(m.name, 0.4 * m.stability_limit, velocity, spin, 1e-3);
      const Snapshot first = alone->now();
      alone->steps(sanitized ? 10000 : 100000);
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

TEST_CASE("hard 9: any ratio of stiffness or mass ends finite, and the step follows it") {
  Case of(9, "stiffness ratio 1e-6 ... 1e6, mass ratio likewise");
  struct Ratio {
    double step, drift;
    bool right;
  };
  const auto impact = [](double stiffness_ratio, double mass_ratio) {
    Scene scene;
    Body upper = *disk(60, 1e4, 0.01, 1), lower = *wall(150, 1e4 * stiffness_ratio, 0.01, 1);
    upper.numbers.mass = mass_ratio;
    scene.projectile = std::make_shared<Body>(upper), scene.target = std::make_shared<Body>(lower);
    // Slow beside the slower of both sounds, so that neither body is crushed; the repulsion as strong as the stiffer body asks for.
    scene.launch.speed = 0.05 * std::min({1.0, std::sqrt(stiffness_ratio), 1 / std::sqrt(mass_ratio)});
    scene.contact.V0 *= std::max(1.0, mass_ratio * scene.launch.speed * scene.launch.speed / 1e-3);
    scene.launch.psi1 = 0.5, scene.integration.time_limit = 40 / scene.launch.speed;
    const Outcome o = outcome_of(scene);
    INFO(stiffness_ratio << " " << mass_ratio << " " << name_of(o.status) << " " << o.reason << " steps " << o.steps << " drift " << o.energy_drift << " e " << o.e);
    const bool right = o.status == Status::finished && std::isfinite(o.e) && o.e > 0 && o.e < 1.2;
    CHECK(right);
    return Ratio{o.step, o.energy_drift, right};
  };
  int right = 0, all = 0;
  double drift = 0, scaling = 0;
  for (const bool of_mass : {false, true}) {
    const double usual = impact(1, 1).step;
    for (int decade = sanitized ? -4 : -6; decade <= (sanitized ? 4 : 6); decade += sanitized ? 2 : 1) {
      const double ratio = std::pow(10, decade);
      const Ratio r = of_mass ? impact(1, ratio) : impact(ratio, 1);
      right += r.right, ++all, drift = std::max(drift, r.drift);
      // A target as stiff as the projectile or stiffer, or a lighter projectile, sets the step: it goes as 1 / sqrt(k / m).
      if (!of_mass && decade >= 2) scaling = std::max(scaling, std::abs(r.step / impact(1e2, 1).step * std::sqrt(ratio / 1e2) - 1));
      if (of_mass && decade <= -2) scaling = std::max(scaling, std::abs(r.step / impact(1, 1e-2).step * std::sqrt(1e-2 / ratio) - 1));
      CHECK(r.step <= 4 * usual);
    }
  }
  of.all(all, right, "impacts that finish with 0 < e < 1.2");
  of.at_most(1e-6, drift, "largest |E - E0| / E0, pefrl at its usual step");
  of.at_most(1e-9, scaling, "the step follows the square root of the ratio where the ratio sets it");
}

TEST_CASE("hard 10: any angle of incidence ends in a result or no_contact") {
  Case of(10, "incidence 0, 45, 80, 89, 89.9, 90 degrees; a disk that misses");
  int right = 0, all = 0;
  std::string statuses;
  for (const double angle : {0.0, 45.0, 80.0, 89.0, 89.9, 90.0})
    for (int seed = 1; seed <= 3; ++seed) {
      Scene scene = small_scene(seed, 0);
      scene.projectile = disk(60, 1e4, 0.03, seed), scene.target = wall(300, 400, 0.03, seed, 12, 1.5);
      scene.launch.psi1 = not_given, scene.launch.angle = angle;
      const Outcome o = outcome_of(scene);
      INFO(angle << " " << name_of(o.status) << " " << o.reason);
      const bool fine = (o.status == Status::finished && o.energy_closure < 1e-4 && std::isfinite(o.e)) || (o.status == Status::no_contact && angle == 90);
      CHECK(fine);
      right += fine, ++all;
    }
  for (const double at : {1.9, 1.97, 1.99, 2.1, 5.0}) {
    Scene scene = small_scene(1, 0, 0);
    scene.target = disk(80, 1e4, 0, 2), scene.launch.at = at;
    bool fine = false;
    try {
      const Outcome o = outcome_of(scene);
      fine = o.status == Status::finished || o.status == Status::no_contact;
      fine = fine && at < 2;
    } catch (const FieldError& error) {
      fine = at > 2 && std::string(error.what()).find("passes beside the target") != std::string::npos;
    }
    INFO("at " << at);
    CHECK(fine);
    right += fine, ++all;
  }
  of.all(all, right, "impacts that finish (energy to 1e-4), pass by at 90 degrees, or are refused beside the target");
}

TEST_CASE("hard 11: any speed ends in a result, a status with its time, or a refusal that gives a speed that works") {
  Case of(11, "speed 0, 1e-300, 1e-8, 1, 3, 10 c");
  int right = 0;
  for (const double speed : {0.0, 1e-300, 1e-16}) {
    Scene scene = small_scene(1, 1);
    scene.launch.speed = speed;
    try {
      right += outcome_of(scene).status == Status::no_contact && speed == 0;
    } catch (const FieldError& error) {
      right += speed > 0 && error.field == "speed" && std::string(error.what()).find("lost in rounding; give a speed of") != std::string::npos;
    }
  }
  of.all(3, right, "0: no_contact; 1e-300 and 1e-16 c: refused, with a speed that works");
  int ended = 0, all = 0;
  for (const double speed : {1.0, 3.0, 10.0})
    for (const bool certified : {true, false})
      for (int seed = 1; seed <= 4; ++seed) {
        Scene scene = small_scene(seed, 1);
        scene.launch.speed = speed;
        if (certified) scene.contact.V0 = 60 * speed * speed, scene.contact.sides = "two";
        const Outcome o = outcome_of(scene);
        INFO(speed << " " << certified << " " << name_of(o.status) << " " << o.reason);
        const bool said = o.reason.find("t = ") != std::string::npos || o.status == Status::out_of_time;
        bool fine = o.status == Status::finished ? o.energy_closure <= 1e-2 && (o.inverted < 0.01 || std::isfinite(o.inversion_time)) : said;
        // Below V0 no node can cross a segment.
        if (certified) fine = fine && o.status != Status::tunnelled;
        CHECK(fine);
        ended += fine, ++all;
      }
  of.all(all, ended, "1, 3, 10 c: closed energy and the time of inversion, or a status that tells its time; none tunnels below V0");
}

TEST_CASE("hard 11: an impact at 1e-8 c closes its energy", "[.slow]") {
  Case of(11, "speed 0, 1e-300, 1e-8, 1, 3, 10 c");
  // With springs of 1e4 it takes 2e9 steps, so 1e-8 c is taken with springs of 0.01, whose sound is a thousand times slower.
  for (const auto& [speed, stiffness] : {std::pair{1e-6, 100.0}, std::pair{1e-8, 0.01}}) {
    Scene scene = small_scene(1, 0, 0);
    scene.projectile = disk(60, stiffness, 0, 1), scene.target = wall(150, 0.04 * stiffness, 0, 1);
    scene.launch.speed = speed;
    const Outcome o = outcome_of(scene);
    INFO(name_of(o.status) << " " << o.reason << " steps " << o.steps);
    CHECK(o.status == Status::finished);
    of.at_most(1e-6, o.energy_drift, fmt::format("largest |E - E0| / E0 at {:g} c, springs of {:g}", speed, stiffness));
    of.told(1 - o.e, fmt::format("1 - e of it, after {:.2g} steps", o.steps));
  }
}

TEST_CASE("hard 12: angular momentum balances whatever the spin") {
  Case of(12, "spin 0, 1, 5 c/R");
  double worst = 0;
  for (const double spin : {0.0, 1.0, -1.0, 5.0}) {
    Scene scene;
    scene.projectile = disk(60, 1e4, 0.02, 1), scene.target = disk(80, 3e3, 0.02, 2);
    scene.launch.at = 0.5, scene.launch.psi1 = 0.4, scene.launch.spin = spin;
    Momenta first, last;
    bool begun = false;
    const Observer observer{0, equally_spaced(0, 0.2, 1000, 1e-3), [&](const Snapshot& s) {
      const Momenta a = momenta(s.projectile, s.projectile_velocity), b = momenta(s.target, s.target_velocity);
      last = {a.linear + b.linear, a.angular + b.angular};
      if (!begun) first = last, begun = true;
    }};
    const Outcome o = run_scene(*build_lattice(*scene.projectile), *build_lattice(*scene.target), scene, go_on, &observer);
    INFO(spin << " " << name_of(o.status) << " " << o.reason);
    CHECK((o.status == Status::finished || (spin == 5 && !o.reason.empty())));  // a disk flies apart at 5 c/R: its rim is faster than sound
    worst = std::max(worst, std::abs(last.angular - first.angular) / std::max(std::abs(first.angular), 0.1 * 60));
  }
  of.at_most(1e-12, worst, "relative change of the total angular momentum of two free disks");
}

TEST_CASE("hard 13: aligned rims and rough ones are deterministic and finite") {
  Case of(13, "roughness 0 and 0.1 R; rims exactly aligned (ties everywhere)");
  int right = 0, all = 0;
  const auto same_twice = [&](const Scene& scene) {
    const Outcome a = outcome_of(scene), b = outcome_of(scene);
    INFO(name_of(a.status) << " " << a.reason);
    bool same = a.status == b.status;
    for (const auto& [field, value] : Outcome::fields()) {
      const double x = value(a), y = value(b);
      same = same && (x == y || (std::isnan(x) && std::isnan(y)));
    }
    const bool fine = same && a.status == Status::finished && std::isfinite(a.e) && a.energy_closure < 1e-4;
    CHECK(fine);
    right += fine, ++all;
    return a;
  };
  for (const double roughness : {0.0, 0.1})
    for (int seed = 1; seed <= 4; ++seed) same_twice(small_scene(seed, 1, roughness));
  // Squares of the same lattice: every node stands above a node, every corner above a corner, falling straight or sliding.
  for (const char* sides : {"one", "two"})
    for (const double psi1 : {0.0, 0.5}) {
      Scene scene;
      const auto square = [](int seed) { return std::make_shared<Body>(Body{Points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, numbers(100, 1e4, 0, seed, "triangular"), {}, {}}); };
      scene.projectile = square(1), scene.target = square(1);
      scene.contact.sides = sides, scene.launch.psi1 = psi1, scene.launch.speed = 0.05;
      const Outcome o = same_twice(scene);
      if (psi1 == 0) CHECK(std::abs(o.vt) < 1e-2 * 0.05);
    }
  of.all(all, right, "impacts with the same bits twice, finished, energy to 1e-4");
}

TEST_CASE("hard 16: bodies that overlap at the start are refused with the gap that is needed") {
  Case of(16, "bodies overlapping at the start (contact energy > 1e-6 of the kinetic)");
  int refused = 0, all = 0;
  for (const double height : {-1.5, -0.5, -0.05, 0.0, 0.02})
    for (const double psi1 : {0.0, 2.0}) {
      Scene scene = small_scene(1, psi1, 0.02);
      scene.launch.height = height;
      bool fine = false;
      double needed = 0;
      try {
        outcome_of(scene);
      } catch (const FieldError& error) {
        const std::string text = error.what();
        const auto at = text.find("raise launch.height to ");
        fine = error.field == "height" && at != std::string::npos;
        if (fine) needed = std::stod(text.substr(at + 23));
      }
      // The height that it names works.
      scene.launch.height = needed;
      INFO("height " << height << " needed " << needed);
      if (fine) CHECK_NOTHROW(fine = outcome_of(scene).status == Status::finished);
      CHECK(fine);
      refused += fine, ++all;
    }
  of.all(all, refused, "heights refused, each naming one that then works");
}

TEST_CASE("hard 17: the contact force is minus the gradient of its energy in 1e5 poses") {
  Case of(17, "contact force against its energy: random poses, vertices, ties, deep overlap");
  Random random(11, 4);
  ExponentialRepulsion law;
  double worst = 0, jump = 0, values = 0;
  int poses = 0;
  for (int pose = 0; poses < 100000; ++pose) {
    // A node and the chain of three segments about two vertices, which it stands above, beside, exactly at, or beyond.
    const double turn = random.uniform(-1.2, 1.2), other = random.uniform(-1.2, 1.2), length = std::pow(10, random.uniform(-2, 0));
    const Vec2 b(0, 0), c = b + length * Vec2(1, 0), a = b - 0.3 * Vec2(std::cos(turn), std::sin(turn)), d = c + 0.3 * Vec2(std::cos(other), std::sin(other));
    const double depth = random.uniform(0, 1) < 0.2 ? random.uniform(1e-6, 1e-3) : random.uniform(1e-3, 0.09);
    Vec2 p;
    switch (pose % 4) {
      case 0: p = Vec2(random.uniform(-0.1, length + 0.1), depth); break;
      case 1: p = b + depth * Vec2(0, 1); break;                      // at the foot of a vertex: the segments' ends tie
      case 2: p = Vec2(length / 2, -depth); break;                    // inside
      default: p = b + depth * Vec2(std::sin(turn / 2), std::cos(turn / 2)); break;  // on the bisector
    }
    const auto energy_and_force = [&](const Vec2& at) {
      Gaps gaps;
      gaps.resize(3);
      const Vec2 from[] = {a, b, c}, to[] = {b, c, d};
      for (std::size_t i = 0; i < 3; ++i) gaps.px[i] = at.x(), gaps.py[i] = at.y(), gaps.ax[i] = from[i].x(), gaps.ay[i] = from[i].y(), gaps.bx[i] = to[i].x(), gaps.by[i] = to[i].y();
      measure(gaps, law);
      return std::pair(gaps.energy[0] + gaps.energy[1] + gaps.energy[2], Vec2(gaps.fx[0] + gaps.fx[1] + gaps.fx[2], gaps.fy[0] + gaps.fy[1] + gaps.fy[2]));
    };
    const auto [energy, force] = energy_and_force(p);
    if (energy == 0) continue;
    ++poses;
    // A small step, so that the crease at a vertex, where the second derivative jumps, is felt to 1e-7 only.
    const double h = std::min(1e-8, 1e-6 * depth), size = std::max(force.norm(), law.xi * energy * 1e-3);
    const auto exact_energy = [&](long double x, long double y) {
      long double sum = 0;
      for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, d}}) {
        const long double ex = static_cast<long double>(to.x()) - from.x(), ey = static_cast<long double>(to.y()) - from.y(), dx = x - from.x(), dy = y - from.y();
        const long double t = std::clamp((dx * ex + dy * ey) / (ex * ex + ey * ey), 0.0L, 1.0L), distance = std::hypot(dx - t * ex, dy - t * ey);
        if (distance < law.reach) sum += law.V0 * std::exp(-law.xi * distance);
      }
      return sum;
    };
    values = std::max(values, static_cast<double>(std::abs(exact_energy(p.x(), p.y()) / energy - 1)));
    for (const Vec2& along : {Vec2(1, 0), Vec2(0, 1)}) {
      const auto shifted = [&](long double by) { return exact_energy(p.x() + by * along.x(), p.y() + by * along.y()); };
      const double slope = static_cast<double>((shifted(h) - shifted(-h)) / (2 * static_cast<long double>(h)));
      worst = std::max(worst, std::abs(slope + force.dot(along)) / size);
      jump = std::max(jump, (energy_and_force(p + h * along).second - energy_and_force(p - h * along).second).norm() / size);
    }
  }
  of.at_most(1e-6, worst, "relative error of the force against differences of the energy in long double, 1e5 poses");
  of.at_most(1e-13, values, "relative error of the energy");
  of.at_most(1e-4, jump, "relative change of the force within 2e-8 R: no jump");
}

TEST_CASE("hard 21: a NaN put into one node ends that impact in that step, names node and time, and leaves its neighbours alone") {
  Case of(21, "a NaN put into one node mid-run");
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  int named = 0, all = 0, untouched = 0;
  for (const char* method : {"pefrl", "verlet", "chin_4a", "blanes_moan_srkn6b", "rk4", "multirate_3"})
    for (const double poison : {nan, inf})
      for (const int body : {0, 1}) {
        std::vector<Scene> scenes;
        for (const double psi1 : {0.0, 1.0, 2.0, 4.0}) scenes.push_back(small_scene(1, psi1)), scenes.back().integration.method = method;
        const auto p = build_lattice(*scenes[0].projectile), t = build_lattice(*scenes[0].target);
        const auto run_all = [&](bool poisoned) {
          Engine<4> engine(*p, *t, scenes[0].method(), {});
          std::array<Outcome, 4> outcomes;
          for (int lane = 0; lane < 4; ++lane) engine.begin(lane, scenes[static_cast<std::size_t>(lane)], static_cast<std::size_t>(lane));
          const int node = body == 0 ? 17 : 40;
          for (int step = 0; !std::all_of(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.status != Status::not_run; });) {
            for (int i = 0; i < engine.steps_between_looks(); ++i, ++step) {
              if (poisoned && step == 100) engine.state()[static_cast<std::size_t>(body)].position.x(node)[2] = poison;
              engine.advance_one_step();
            }
            engine.look([&](int lane, const Outcome& o) { outcomes[static_cast<std::size_t>(lane)] = o, engine.clear(lane); });
          }
          if (poisoned) {
            const Outcome& o = outcomes[2];
            const std::string words = fmt::format("node {} of the {} was no longer finite at t = {:.6g}", node, body == 0 ? "projectile" : "target", 100 * o.step);
            INFO(method << ": " << o.reason << " | " << words);
            const bool fine = o.status == Status::not_finite && o.steps <= 101 && o.reason.find(words) != std::string::npos;
            CHECK(fine);
            named += fine, ++all;
          }
          return outcomes;
        };
        const auto with = run_all(true), without = run_all(false);
        bool same = true;
        for (const std::size_t lane : {0u, 1u, 3u})
          for (const auto& [field, value] : Outcome::fields()) {
            const double x = value(with[lane]), y = value(without[lane]);
            same = same && (x == y || (std::isnan(x) && std::isnan(y)));
          }
        CHECK(same);
        untouched += same;
      }
  of.all(all, named, "ended not_finite in that step, node and time named (6 methods, NaN and inf, either body)");
  of.all(all, untouched, "runs whose other three lanes kept every bit");
}

TEST_CASE("hard 22: a slow smooth disk leaves a flat rigid wall as fast as it came") {
  Case of(22, "analytic anchors");
  Scene scene = small_scene(1, 0, 0);
  Body rigid = *scene.target;
  std::fill(rigid.anchored.begin(), rigid.anchored.end(), true);
  scene.target = std::make_shared<Body>(rigid);
  const LatticePointer wall = build_lattice(*scene.target), wheel = wheel_of(24), random = build_lattice(*scene.projectile);
  std::vector<double> lost, turned;
  for (const double speed : {0.3, 0.1, 0.03, 0.01, 0.003}) {
    scene.launch.speed = speed;
    const Outcome a = run_scene(*wheel, *wall, scene, go_on), b = run_scene(*random, *wall, scene, go_on);
    REQUIRE((a.status == Status::finished && b.status == Status::finished));
    CHECK((a.e <= 1 + 1e-7 && b.e <= 1 + 1e-7));
    lost.push_back(std::abs(1 - a.e)), turned.push_back(std::abs(1 - (b.after.projectile_translation + b.after.projectile_rotation) / b.before.total()));
  }
  of.at_most(1e-6, lost.back(), "|1 - e| of a symmetric disk at 0.003 c");
  of.at_most(1e-6, turned.back(), "energy not in flight and spin, of a random disk at 0.003 c (which turns: the node that hits is not below its centre)");
}

TEST_CASE("hard 22: two masses on a spring swing as a cosine") {
  Case of(22, "analytic anchors");
  // Far above the wall that a scene must have: one spring, stretched by 0.01 of its length.
  const auto pair = lattice_of({{-0.5, 0}, {0.5, 0}}, {{0, 1}}, 2);
  Scene scene = small_scene(1, 0, 0);
  scene.integration.method = "blanes_moan_srkn14a", scene.integration.theta = 0.3;
  Alone alone(pair, build_lattice(*scene.target), scene);
  alone.engine().change([&](Engine<1>::Bodies& bodies) {
    for (int i = 0; i < bodies[1].lattice->nodes(); ++i) bodies[1].position.y(i) -= 10;
    for (int i : {0, 1}) bodies[0].position.set(i, 0, 1.01 * pair->points[static_cast<std::size_t>(i)]), bodies[0].velocity.set(i, 0, Vec2(0, 0));
  });
  const double omega = std::sqrt(2 * 1e4);
  double worst = 0;
  for (int look = 1; look <= 1000; ++look) {
    alone.steps(3);
    const Snapshot s = alone.now();
    worst = std::max(worst, std::abs((s.projectile[1] - s.projectile[0]).norm() - 1 - 0.01 * std::cos(omega * alone.step() * 3 * look)) / 0.01);
  }
  of.at_most(1e-6, worst, "two masses on a spring: stretch less cosine, over its amplitude, 1e3 rad");
}

TEST_CASE("hard 22: a wave runs along a bar, and rods of lengths 1 and 2 part, at the rates of the lattice") {
  Case of(22, "analytic anchors");
  const auto rate = [](const std::vector<double>& h, const std::vector<double>& error) { return std::log(error.front() / error.back()) / std::log(h.front() / h.back()); };
  std::vector<double> spacing, period_error, rod_error;
  for (const int cells : {16, 32, 64, 128}) {
    const double length = 4, h = length / cells, c = h * std::sqrt(1e4);
    const auto bar = bar_of(length, cells, 0);
    Scene scene = small_scene(1, 0, 0);
    scene.integration.theta = 0.3;
    Alone alone(bar, build_lattice(*scene.target), scene);
    const auto mode = [&](int i) { return std::cos(std::numbers::pi * bar->points[static_cast<std::size_t>(i)].y() / length); };
    alone.engine().change([&](Engine<1>::Bodies& bodies) {
      for (int i = 0; i < bodies[1].lattice->nodes(); ++i) bodies[1].position.y(i) -= 20;
      for (int i = 0; i < bar->nodes(); ++i) bodies[0].position.set(i, 0, bar->points[static_cast<std::size_t>(i)] + Vec2(0, 1e-5 * mode(i))), bodies[0].velocity.set(i, 0, Vec2(0, 0));
    });
    // The amplitude of the slowest vibration, by projection; it passes zero twice a period.
    double before = 1, first = 0, last = 0;
    int crossings = 0;
    for (int step = 1; crossings < 9; ++step) {
      alone.steps(1);
      const Snapshot s = alone.now();
      double amplitude = 0;
      for (int i = 0; i < bar->nodes(); ++i) amplitude += (s.projectile[static_cast<std::size_t>(i)].y() - bar->points[static_cast<std::size_t>(i)].y()) * mode(i);
      if (before * amplitude < 0) {
        last = alone.step() * (step - std::abs(amplitude) / (std::abs(amplitude) + std::abs(before)));
        if (crossings++ == 0) first = last;
      }
      before = amplitude;
    }
    const double exact = 2 * length / c;
    spacing.push_back(h), period_error.push_back(std::abs((last - first) / 4 / exact - 1));

    // A rod that hits one twice as long stops dead and leaves it half its speed: e = 1/2.
    const auto upper = bar_of(100, cells, 0), lower = bar_of(200, 2 * cells, -300);
    Scene rods;
    rods.projectile = disk(60, 1e4, 0, 1), rods.target = disk(60, 1e4, 0, 1);
    rods.launch.speed = 1e-3 * (100.0 / cells) * std::sqrt(1e4), rods.launch.psi1 = 0;
    rods.contact.xi = 7000, rods.contact.reach = 0.05, rods.contact.sides = "two";
    const Outcome o = run_scene(*upper, *lower, rods, go_on);
    INFO(o.reason);
    CHECK(o.status == Status::finished);
    rod_error.push_back(std::abs(o.e - 0.5));
  }
  of.at_most(2e-3, period_error.back(), "bar: relative error of the slowest period, 128 spacings long");
  of.at_most(0.3, std::abs(rate(spacing, period_error) - 2), "the rate at which it falls with the spacing, less 2");
  of.at_most(0.03, rod_error.back(), "rods 1 : 2: |e - 1/2|, 128 and 256 spacings long");
  of.at_most(1.0, 0.3 / rate(spacing, rod_error), "0.3 over the rate at which that falls");
}
