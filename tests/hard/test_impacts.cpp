// Hard cases of single impacts: symmetry, extreme ratios, angles and speeds, overlap, forces, and what breaks on the
// way.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "contact/contacts.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "hard/alone.hpp"
#include "hard/table.hpp"
#include "impact/batch.hpp"
#include "shape/triangulate.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

Outcome outcome_of(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

Solid moved(Solid lattice, const std::function<Vec2(const Vec2&)>& to) {
  for (Points* points : {&lattice.points, &lattice.smooth})
    for (Vec2& p : *points) p = to(p);
  return lattice;
}

/// Everything of an outcome but what depends on which end of the contact leads, or on which side of a cell is inside:
/// mirrored cells have it to their right.
std::vector<double> mirrored_values(const Outcome& o) {
  static const std::set<std::string> left_out{"centre_offset", "tan_alpha", "e_alpha", "normal_x", "normal_y",
                                              "e_n",           "beta_n",    "mu_n",    "overlap"};
  std::vector<double> values;
  for (const auto& [field, value] : Outcome::fields()) {
    if (!left_out.contains(field.name)) values.push_back(value(o));
  }
  return values;
}

}  // namespace

TEST_CASE("hard 7: the mirrored scene has the mirrored outcome, bit for bit") {
  Case of(7, "mirror x -> -x with the same node order");
  int equal = 0, scenes = 0;
  for (const char* sides : {"one", "two"})
    for (const double psi1 : {0.0, 1.0, 4.0})
      for (int seed = 1; seed <= 3; ++seed) {
        Scene scene = small_scene(seed, 1, 0.03), other;
        scene.contact.sides = sides;
        scene.launch.psi1 = not_given;
        scene.launch.normal_speed = 0.1;
        scene.launch.tangential_speed = 0.1 * psi1;
        scene.launch.spin = 0.02;
        other = scene;
        other.launch.tangential_speed *= -1;
        other.launch.spin *= -1;
        const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
        const auto mirror = [](const Vec2& x) { return Vec2(-x.x(), x.y()); };
        const Solid p_mirrored = moved(*p, mirror), t_mirrored = moved(*t, mirror);
        const Outcome a = run_scene({p.get(), t.get()}, scene, go_on),
                      b = run_scene({&p_mirrored, &t_mirrored}, other, go_on);
        REQUIRE(a.status == Status::finished);
        Outcome back = b;
        back.psi1 *= -1;
        back.psi2 *= -1;
        back.vt *= -1;
        back.omega *= -1;
        back.impulse_t *= -1;
        for (double* turns : {&back.target_vt, &back.target_omega, &back.last_vt, &back.last_omega}) *turns *= -1;
        const auto mine = mirrored_values(a), theirs = mirrored_values(back);
        bool same = a.status == b.status;
        for (std::size_t i = 0; i < mine.size(); ++i)
          same = same && (mine[i] == theirs[i] || (std::isnan(mine[i]) && std::isnan(theirs[i])));
        equal += same;
        ++scenes;
      }
  of.all(scenes, equal, "scenes whose outcomes are equal (but for which end of the contact leads)");
}

TEST_CASE("hard 8: a scene turned by 90 degrees has the same outcome, one shifted by 1e6 R loses digits") {
  Case of(8, "the scene turned by 90 degrees; shifted by 1e6 R");
  double turned = 0, shifted = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    Scene scene = small_scene(seed, 1, 0);
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    Alone straight(p, t, scene);
    const auto count = static_cast<std::int64_t>(8 / straight.step());
    const Snapshot start = straight.now();
    straight.steps(count);
    const auto mean = [](const Points& v) {
      Vec2 sum = Vec2::Zero();
      for (const Vec2& x : v) sum += x / static_cast<double>(v.size());
      return sum;
    };
    const Vec2 after = mean(straight.now().bodies[0].velocity);
    REQUIRE(straight.now().energy.contact == 0);
    REQUIRE(after.y() > 0.01);
    const auto with = [&](const std::function<Vec2(const Vec2&)>& place,
                          const std::function<Vec2(const Vec2&)>& direction, double at) {
      Scene other = scene;
      other.launch.at = at;
      Alone alone(std::make_shared<Solid>(moved(*p, place)), std::make_shared<Solid>(moved(*t, place)), other);
      alone.engine().change([&](Motions<1>& bodies) {
        for (int i = 0; i < p->nodes(); ++i) {
          bodies[0].q.set(i, 0, place(start.bodies[0].place[static_cast<std::size_t>(i)]));
          bodies[0].v.set(i, 0, direction(start.bodies[0].velocity[static_cast<std::size_t>(i)]));
        }
        for (int i = 0; i < t->nodes(); ++i) {
          bodies[1].q.set(i, 0, place(start.bodies[1].place[static_cast<std::size_t>(i)]));
          bodies[1].v.set(i, 0, Vec2(0, 0));
        }
      });
      alone.steps(count);
      return mean(alone.now().bodies[0].velocity);
    };
    const auto turn = [](const Vec2& x) { return Vec2(-x.y(), x.x()); };
    const Vec2 aside = with(turn, turn, t->centre().x() - 0.5);
    turned = std::max(turned, std::abs(aside.x() + after.y()) / 0.1);
    const auto shift = [](const Vec2& x) { return Vec2(x.x() + 1e6, x.y() + 1e6); };
    const Vec2 away = with(
        shift, [](const Vec2& v) { return v; }, 1e6);
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
    Scene scene = paper_scene();
    Body upper = *disk(60, 1e4, 0.01, 1), lower = *wall(150, 1e4 * stiffness_ratio, 0.01, 1);
    upper.numbers.mass = mass_ratio;
    scene.projectile = std::make_shared<Body>(upper);
    scene.target = std::make_shared<Body>(lower);
    // Slow beside the slower of both sounds, so that neither body is crushed; the repulsion as strong as the stiffer
    // body asks for.
    scene.launch.speed = 0.05 * std::min({1.0, std::sqrt(stiffness_ratio), 1 / std::sqrt(mass_ratio)});
    scene.contact.V0 *= std::max(1.0, mass_ratio * scene.launch.speed * scene.launch.speed / 1e-3);
    scene.launch.psi1 = 0.5;
    scene.integration.time_limit = 40 / scene.launch.speed;
    const Outcome o = outcome_of(scene);
    INFO(stiffness_ratio << " " << mass_ratio << " " << name_of(o.status) << " " << o.reason << " steps " << o.steps
                         << " drift " << o.energy_drift << " e " << o.e);
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
      right += r.right;
      ++all;
      drift = std::max(drift, r.drift);
      // A target as stiff as the projectile or stiffer, or a lighter projectile, sets the step: it goes as 1 / sqrt(k /
      // m).
      if (!of_mass && decade >= 2)
        scaling = std::max(scaling, std::abs(r.step / impact(1e2, 1).step * std::sqrt(ratio / 1e2) - 1));
      if (of_mass && decade <= -2)
        scaling = std::max(scaling, std::abs(r.step / impact(1, 1e-2).step * std::sqrt(1e-2 / ratio) - 1));
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
      scene.projectile = disk(60, 1e4, 0.03, seed);
      scene.target = wall(300, 400, 0.03, seed, 12, 1.5);
      scene.launch.psi1 = not_given;
      scene.launch.angle = angle;
      const Outcome o = outcome_of(scene);
      INFO(angle << " " << name_of(o.status) << " " << o.reason);
      // From 89 degrees on a disk may catch the wall's end: a normal that turns meanwhile leaves e_n undefined.
      const bool measured = std::isfinite(o.mu_n) && (std::isfinite(o.e_n) || (angle >= 89 && o.normal_x != 0));
      const bool fine = (o.status == Status::finished && o.energy_closure < 1e-4 && measured) ||
                        (o.status == Status::no_contact && angle == 90);
      CHECK(fine);
      right += fine;
      ++all;
    }
  for (const double at : {1.9, 1.97, 1.99, 2.1, 5.0}) {
    Scene scene = small_scene(1, 0, 0);
    scene.target = disk(80, 1e4, 0, 2);
    scene.launch.at = at;
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
    right += fine;
    ++all;
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
      outcome_of(scene);
    } catch (const FieldError& error) {
      const char* remedy = speed > 0 ? "lost in rounding; give a speed of" : "launch.height to fall from";
      right += error.field == "speed" && std::string(error.what()).find(remedy) != std::string::npos;
    }
  }
  of.all(3, right, "0, 1e-300 and 1e-16 c: refused, with what works");
  int ended = 0, all = 0;
  for (const double speed : {1.0, 3.0, 10.0})
    for (const bool certified : {true, false})
      for (int seed = 1; seed <= 4; ++seed) {
        Scene scene = small_scene(seed, 1);
        scene.launch.speed = speed;
        if (certified) {
          scene.contact.V0 = 60 * speed * speed;
          scene.contact.sides = "two";
        }
        const Outcome o = outcome_of(scene);
        INFO(speed << " " << certified << " " << name_of(o.status) << " " << o.reason);
        const bool said = o.reason.find("t = ") != std::string::npos || o.status == Status::out_of_time;
        bool fine = o.status == Status::finished
                        ? o.energy_closure <= 1e-2 && (o.inverted < 0.01 || std::isfinite(o.inversion_time))
                        : said;
        // Below V0 no node can cross a segment.
        if (certified) fine = fine && o.status != Status::tunnelled;
        CHECK(fine);
        ended += fine;
        ++all;
      }
  of.all(all, ended,
         "1, 3, 10 c: closed energy and the time of inversion, or a status that tells its time; none tunnels below V0");
}

TEST_CASE("hard 11: an impact at 1e-8 c closes its energy", "[.slow]") {
  Case of(11, "speed 0, 1e-300, 1e-8, 1, 3, 10 c");
  // With springs of 1e4 it takes 2e9 steps, so 1e-8 c is taken with springs of 0.01, whose sound is a thousand times
  // slower.
  for (const auto& [speed, stiffness] : {std::pair{1e-6, 100.0}, std::pair{1e-8, 0.01}}) {
    Scene scene = small_scene(1, 0, 0);
    scene.projectile = disk(60, stiffness, 0, 1);
    scene.target = wall(150, 0.04 * stiffness, 0, 1);
    scene.launch.speed = speed;
    const Outcome o = outcome_of(scene);
    INFO(name_of(o.status) << " " << o.reason << " steps " << o.steps);
    CHECK(o.status == Status::finished);
    of.at_most(1e-6, o.energy_drift, fmt::format("largest |E - E0| / E0 at {:g} c, springs of {:g}", speed, stiffness));
    of.told(1 - o.e, fmt::format("1 - e of it, after {:.2g} steps", o.steps));
  }
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
    right += fine;
    ++all;
    return a;
  };
  for (const double roughness : {0.0, 0.1})
    for (int seed = 1; seed <= 4; ++seed) same_twice(small_scene(seed, 1, roughness));
  // Squares of the same lattice: every node stands above a node, every corner above a corner, falling straight or
  // sliding.
  for (const char* sides : {"one", "two"})
    for (const double psi1 : {0.0, 0.5}) {
      Scene scene = paper_scene();
      const auto square = [](int seed) {
        return std::make_shared<Body>(
            Body{Points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, numbers(100, 1e4, 0, seed, "triangular"), {}, {}});
      };
      scene.projectile = square(1);
      scene.target = square(1);
      scene.contact.sides = sides;
      scene.launch.psi1 = psi1;
      scene.launch.speed = 0.05;
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
      refused += fine;
      ++all;
    }
  of.all(all, refused, "heights refused, each naming one that then works");
}

TEST_CASE("hard 17: the contact force is minus the gradient of its energy in 1e5 poses") {
  Case of(17, "contact force against its energy: random poses, vertices, ties, deep overlap");
  Random random(11, 4);
  ExponentialRepulsion law = paper_contact();
  double worst = 0, jump = 0, values = 0;
  int poses = 0;
  for (int pose = 0; poses < 100000; ++pose) {
    // A node and the chain of three segments about two vertices, which it stands above, beside, exactly at, or beyond.
    const double turn = random.uniform(-1.2, 1.2), other = random.uniform(-1.2, 1.2),
                 length = std::pow(10, random.uniform(-2, 0));
    const Vec2 b(0, 0), c = b + length * Vec2(1, 0), a = b - 0.3 * Vec2(std::cos(turn), std::sin(turn)),
                        d = c + 0.3 * Vec2(std::cos(other), std::sin(other));
    const double depth = random.uniform(0, 1) < 0.2 ? random.uniform(1e-6, 1e-3) : random.uniform(1e-3, 0.09);
    Vec2 p;
    switch (pose % 4) {
      case 0:
        p = Vec2(random.uniform(-0.1, length + 0.1), depth);
        break;
      case 1:
        p = b + depth * Vec2(0, 1);
        break;  // at the foot of a vertex: the segments' ends tie
      case 2:
        p = Vec2(length / 2, -depth);
        break;  // inside
      default:
        p = b + depth * Vec2(std::sin(turn / 2), std::cos(turn / 2));
        break;  // on the bisector
    }
    const auto energy_and_force = [&](const Vec2& at) {
      Gaps gaps;
      gaps.resize(3);
      const Vec2 from[] = {a, b, c}, to[] = {b, c, d};
      for (std::size_t i = 0; i < 3; ++i) {
        gaps.px[i] = at.x();
        gaps.py[i] = at.y();
        gaps.ax[i] = from[i].x();
        gaps.ay[i] = from[i].y();
        gaps.bx[i] = to[i].x();
        gaps.by[i] = to[i].y();
      }
      measure(gaps, law);
      return std::pair(gaps.energy[0] + gaps.energy[1] + gaps.energy[2],
                       Vec2(gaps.fx[0] + gaps.fx[1] + gaps.fx[2], gaps.fy[0] + gaps.fy[1] + gaps.fy[2]));
    };
    const auto [energy, force] = energy_and_force(p);
    if (energy == 0) continue;
    ++poses;
    // A small step, so that the crease at a vertex, where the second derivative jumps, is felt to 1e-7 only.
    const double h = std::min(1e-8, 1e-6 * depth), size = std::max(force.norm(), law.xi * energy * 1e-3);
    const auto exact_energy = [&](long double x, long double y) {
      long double sum = 0;
      for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, d}}) {
        const long double ex = static_cast<long double>(to.x()) - from.x(),
                          ey = static_cast<long double>(to.y()) - from.y(), dx = x - from.x(), dy = y - from.y();
        const long double t = std::clamp((dx * ex + dy * ey) / (ex * ex + ey * ey), 0.0L, 1.0L),
                          distance = std::hypot(dx - t * ex, dy - t * ey);
        if (distance < law.reach) sum += law.V0 * std::exp(-law.xi * distance);
      }
      return sum;
    };
    values = std::max(values, static_cast<double>(std::abs(exact_energy(p.x(), p.y()) / energy - 1)));
    for (const Vec2& along : {Vec2(1, 0), Vec2(0, 1)}) {
      const auto shifted = [&](long double by) { return exact_energy(p.x() + by * along.x(), p.y() + by * along.y()); };
      const double slope = static_cast<double>((shifted(h) - shifted(-h)) / (2 * static_cast<long double>(h)));
      worst = std::max(worst, std::abs(slope + force.dot(along)) / size);
      jump = std::max(jump,
                      (energy_and_force(p + h * along).second - energy_and_force(p - h * along).second).norm() / size);
    }
  }
  of.at_most(1e-6, worst, "relative error of the force against differences of the energy in long double, 1e5 poses");
  of.at_most(1e-13, values, "relative error of the energy");
  of.at_most(1e-4, jump, "relative change of the force within 2e-8 R: no jump");
}

TEST_CASE(
    "hard 21: a NaN put into one node ends that impact in that step, names node and time, and leaves its neighbours "
    "alone") {
  Case of(21, "a NaN put into one node mid-run");
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  int named = 0, all = 0, untouched = 0;
  for (const char* method : {"pefrl", "verlet", "chin_4a", "blanes_moan_srkn6b", "rk4", "multirate_3"})
    for (const double poison : {nan, inf})
      for (const int body : {0, 1}) {
        std::vector<Scene> scenes;
        for (const double psi1 : {0.0, 1.0, 2.0, 4.0}) {
          scenes.push_back(small_scene(1, psi1));
          scenes.back().integration.method = method;
        }
        const auto p = build_solid(*scenes[0].projectile), t = build_solid(*scenes[0].target);
        const auto run_all = [&](bool poisoned) {
          Engine<4> engine({p.get(), t.get()}, scenes[0].method(), {});
          std::array<Outcome, 4> outcomes;
          for (int lane = 0; lane < 4; ++lane)
            engine.begin(lane, scenes[static_cast<std::size_t>(lane)], static_cast<std::size_t>(lane));
          const int node = body == 0 ? 17 : 40;
          for (int step = 0; !std::all_of(outcomes.begin(), outcomes.end(),
                                          [](const Outcome& o) { return o.status != Status::not_run; });) {
            for (int i = 0; i < engine.steps_between_looks(); ++i, ++step) {
              if (poisoned && step == 100) engine.bodies()[static_cast<std::size_t>(body)].q[2 * node][2] = poison;
              engine.advance_one_step();
            }
            for (const auto& [lane, o] : engine.look()) {
              outcomes[static_cast<std::size_t>(lane)] = o;
              engine.clear(lane);
            }
          }
          if (poisoned) {
            const Outcome& o = outcomes[2];
            const std::string words = fmt::format("node {} of the {} was no longer finite at t = {:.6g}", node,
                                                  body == 0 ? "projectile" : "target", 100 * o.step);
            INFO(method << ": " << o.reason << " | " << words);
            const bool fine =
                o.status == Status::not_finite && o.steps <= 101 && o.reason.find(words) != std::string::npos;
            CHECK(fine);
            named += fine;
            ++all;
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
