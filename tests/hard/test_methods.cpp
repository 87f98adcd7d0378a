// Hard cases of the integrators: order, the edge of stability, steps that are wrong, long runs, runs backwards.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "hard/alone.hpp"
#include "hard/table.hpp"
#include "impact/accuracy.hpp"
#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "integrate/particle.hpp"
#include "script/program.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

using MassChain = Eigen::Array<long double, 8, 1>;

/// The chain of Fermi, Pasta, Ulam and Tsingou, with cubic and quartic terms and fixed ends.
MassChain fput(const MassChain& x) {
  MassChain slope = MassChain::Zero();
  for (int i = 0; i <= x.size(); ++i) {
    const long double stretch = (i < x.size() ? x[i] : 0) - (i > 0 ? x[i - 1] : 0);
    const long double tension = stretch + 0.25L * stretch * stretch + 0.3L * stretch * stretch * stretch;
    if (i < x.size()) slope[i] += tension;
    if (i > 0) slope[i - 1] -= tension;
  }
  return slope;
}

long double distance(long double a, long double b) { return std::abs(a - b); }
long double distance(const MassChain& a, const MassChain& b) { return std::sqrt((a - b).square().sum()); }

/// Slope of y against x by least squares.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / x.size();
    my += y[i] / x.size();
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xy / xx;
}

// Slope of the error over nine steps from one small enough for the order to show to half of it, all far from rounding.
template <class State, class Slope>
double order_of(const Method& method, Slope&& slope, const State& x0, const State& v0) {
  constexpr int times = 6;  // at one alone the leading term may happen to vanish
  std::vector<std::pair<State, State>> exact;
  for (int i = 0; i < times; ++i)
    exact.push_back(run<State>(method_named("blanes_moan_srkn14a"), x0, v0, 1.0 / 256, 256 * (i + 2), slope));
  const auto error = [&](int steps) {
    long double sum = 0;
    for (int i = 0; i < times; ++i) {
      const auto [x, v] = run<State>(method, x0, v0, 1.0 / steps, steps * (i + 2), slope);
      sum += std::hypot(distance(x, exact[i].first), distance(v, exact[i].second));
    }
    return sum;
  };
  int fewest = 1;
  while (!(error(fewest) < (method.order == 2 ? 1e-4 : method.order == 4 ? 1e-9 : method.order == 6 ? 2e-11 : 3e-11)))
    fewest = fewest * 5 / 4 + 1;
  std::vector<double> h, errors;
  for (int i = 0; i < 9; ++i) {
    const int steps = static_cast<int>(fewest * std::exp2(i / 8.0));
    h.push_back(-std::log(steps));
    errors.push_back(static_cast<double>(std::log(error(steps))));
  }
  return slope_of(h, errors);
}

// The greatest factor by which one step h of an oscillator stretches (x, v), from the trace and determinant of the
// matrix of the step. A symplectic one has determinant 1, and is bounded while its trace lies between -2 and 2; by that
// the limit is found more sharply.
double growth(const Method& method, double h) {
  const auto [xx, vx] = run<long double>(method, 1, 0, h, 1, oscillator);
  const auto [xv, vv] = run<long double>(method, 0, 1, h, 1, oscillator);
  const double trace = static_cast<double>(xx + vv), determinant = static_cast<double>(xx * vv - xv * vx);
  if (method.symplectic()) return std::max(1.0, std::abs(trace) / 2);
  const double root = trace * trace / 4 - determinant;
  return root < 0 ? std::sqrt(determinant) : std::abs(trace) / 2 + std::sqrt(root);
}

std::vector<double> coordinates(const Snapshot& s) {
  std::vector<double> all;
  for (const Points& points : {s.bodies[0].place, s.bodies[1].place})
    for (const Vec2& x : points) {
      all.push_back(x.x());
      all.push_back(x.y());
    }
  return all;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

TEST_CASE(
    "hard 1: every method has its order on an oscillator, a pendulum, an anharmonic well and a chain of Fermi, Pasta, "
    "Ulam and Tsingou") {
  Case of(1, "order of every method: oscillator, pendulum, anharmonic well, FPUT chain, smooth impact");
  MassChain x, v;
  for (int i = 0; i < x.size(); ++i) {
    x[i] = 0.6L * std::sin(1.7L * (i + 1));
    v[i] = 0.5L * std::cos(2.3L * i);
  }
  double worst = 0;
  for (const Method& m : methods()) {
    INFO(m.name);
    const double orders[] = {order_of<long double>(m, oscillator, 1.1, 0.3),
                             order_of<long double>(m, pendulum, 2.4, 0.9),
                             order_of<long double>(m, anharmonic, 1.1, 0.3), order_of<MassChain>(m, fput, x, v)};
    for (const double order : orders) {
      // The terms of order 8 of dop853 are so small that those of order 9 hide them until rounding does.
      if (m.name == "dop853") {
        CHECK(order > m.order - 0.15);
        CHECK(order < m.order + 1);
      } else {
        worst = std::max(worst, std::abs(order - m.order));
        CHECK(std::abs(order - m.order) < 0.15);
      }
    }
  }
  of.at_most(0.15, worst, "slope less order, four systems, all but dop853 (8 to 9)");
}

TEST_CASE("hard 1: every method has its order on a smooth impact") {
  Case of(1, "order of every method: oscillator, pendulum, anharmonic well, FPUT chain, smooth impact");
  Scene scene = small_scene(1, 1, 0);
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  const auto final_state = [&](const char* method, double step) {
    scene.integration.method = method;
    scene.integration.step = step;
    return coordinates(run_until({p.get(), t.get()}, scene, 4.8));  // on the way out: contact passed its climax
  };
  const auto exact = final_state("blanes_moan_srkn14a", 0.0025);
  double worst = 0;
  // Steps at which each method's leading term shows; paths of takahashi_imada and multirate are of order 2, their
  // outcomes of order 4 (test_accuracy.cpp).
  for (const auto& [method, step] :
       {std::pair{"verlet", 0.005}, std::pair{"takahashi_imada", 0.005}, std::pair{"forest_ruth", 0.005},
        std::pair{"pefrl", 0.01}, std::pair{"chin_4a", 0.01}, std::pair{"mclachlan_sb3a4", 0.01},
        std::pair{"blanes_moan_srkn6b", 0.01}, std::pair{"rk4", 0.005}, std::pair{"multirate_2", 0.01},
        std::pair{"multirate_3", 0.01}, std::pair{"multirate_5", 0.01}, std::pair{"multirate_8", 0.01}}) {
    std::vector<double> h, errors;
    for (const int steps : {480, 600, 800, 960, 1200}) {
      h.push_back(std::log(0.01 / step * 4.8 / steps));
      errors.push_back(std::log(rms(final_state(method, step / 0.01 * 4.8 / steps), exact)));
    }
    const double order = slope_of(h, errors);
    INFO(method << " " << order);
    worst = std::max(worst, std::abs(order - method_named(method).order));
  }
  of.at_most(0.15, worst, "slope less order, paths in a smooth impact, order 2 and 4");
  // Those of order 6, and blanes_moan_s6, reach the floor that the ends of the contact's segments set before their
  // leading term shows.
  double rounding = 0;
  for (const auto& [method, step] : {std::pair{"blanes_moan_s6", 0.005}, std::pair{"okunbor_skeel_13", 0.005},
                                     std::pair{"blanes_moan_srkn11b", 0.005}, std::pair{"dop853", 0.005}})
    rounding = std::max(rounding, rms(final_state(method, step), exact));
  of.at_most(1e-10, rounding, "the same, blanes_moan_s6, order 6 and 8: paths at their floor already [R]");
}

TEST_CASE("hard 2: every method is bounded up to its stability limit, which is where the first unstable window opens") {
  Case of(2, "the edge of stability");
  double below = 0, amplitude = 0;
  int opens = 0;
  for (const Method& m : methods()) {
    INFO(m.name);
    double beyond = 0;
    for (int i = 1; i <= 100000; ++i) below = std::max(below, growth(m, m.stability_limit * i / 100000) - 1);
    for (int i = 1; i <= 2000; ++i) beyond = std::max(beyond, growth(m, m.stability_limit + 5e-6 * i));
    opens += beyond > 1 + 5e-12;
    const auto [x, v] = run<long double>(m, 1, 0, 0.97 * m.stability_limit, 100000, oscillator);
    amplitude = std::max(amplitude, static_cast<double>(std::hypot(x, v)));
  }
  const int all = static_cast<int>(methods().size());
  of.at_most(5e-12, below, "growth a step of an oscillator less 1, anywhere below the limit");
  of.all(all, opens, "methods of which it opens within 0.01 above the limit");
  of.at_most(100, amplitude, "amplitude of an oscillator after 1e5 steps at 0.97 of the limit");

  double energy = 0;
  for (const Method& m : methods()) {
    const auto disk = free_disk(m.name, 0.97 * m.stability_limit, Vec2(0, 0), 0, 1e-3);
    const double before = disk->now().energy.total();
    for (int block = 0; block < (sanitized ? 10 : 100); ++block) {
      disk->steps(1000);
      energy = std::max(energy, disk->now().energy.total() / before);
    }
  }
  of.at_most(10, energy, "energy of a vibrating disk, 1e5 steps at theta = 0.97 of the limit, over that at first");
}

TEST_CASE("hard 3: wrong steps are refused before the first one, and nothing is written") {
  Case of(2, "the edge of stability"), wrong(3, "wrong time steps");
  const Workplace here;
  const auto script = [](const std::string& step) {
    return "local ricochet = require 'ricochet'\nlocal p = ricochet.parameters {}\nricochet.sweep { name = 's', over = "
           "{ psi1 = { 0, 1 } }, scene = function(at) return ricochet.scene {\n"
           "projectile = ricochet.disk { nodes = 60, mass = 1 }, target = ricochet.wall { nodes = 150, width = 4, "
           "depth = 1.5, mass = 1, stiffness = 400 }, contact = { V0 = 150, xi = 300 },\n" +
           step + ", launch = { psi1 = at.psi1 } } end }:run()\n";
  };
  Scene scene;
  scene.projectile = disk(60, 1e4, 0, 1);
  const double limit =
      method_named("pefrl").stability_limit /
      frequency_bound(*build_solid(Body{scene.projectile->outline, numbers(60, 1e4, 0, 1), {}, {}}), 1e4).omega;
  const auto refused = [&](const std::string& step, std::initializer_list<const char*> words) {
    const Ended ended = here.script(script(step), "--quiet");
    INFO(step << "\n" << ended.err);
    bool right = ended.status == 1 && ended.first_line().starts_with("error: s.lua:") && !fs::exists(here.path / "out");
    for (const char* word : words) right = right && ended.err.find(word) != std::string::npos;
    CHECK(right);
    return right;
  };
  int named = 0;
  for (const std::string& step : {fmt::format("step = {}", 1.02 * limit), fmt::format("step = {}", 1.5 * limit),
                                  fmt::format("step = {}", 3 * limit), fmt::format("step = {}", 1e3 * limit),
                                  std::string("theta = 3"), std::string("theta = 1e300")})
    named += refused(step, {"is unstable: pefrl needs a", "below", "node ", "vibrates at up to", "works"});
  of.all(6, named, "above the limit refused, naming bound, node and a step that works");
  int others = named;
  for (const char* step : {"step = 0", "step = -0.01", "step = 0/0", "step = 1/0", "step = -1/0", "theta = 0",
                           "theta = 0/0", "theta = 1/0"})
    others += refused(step, {});
  for (const char* step : {"step = 5e-324", "step = 1e-310", "step = 1e-300", "step = 1e-15", "theta = 1e-300",
                           "theta = 5e-324", "step = 0.005, time_limit = 1e300"})
    others += refused(step, {"lost in rounding", "give a"});
  wrong.all(21, others,
            "1.02 to 1000 times the limit, 0, < 0, NaN, inf, denormal, t + step = t: refused, nothing written");
}

TEST_CASE("hard 6: a symmetric method runs back to where it came from") {
  Case of(6, "a reversed run of a symmetric method, contact included");
  double worst = 0;
  for (const Method& m : methods()) {
    if (!m.symplectic()) continue;
    Scene scene = small_scene(1, 1, 0);
    scene.integration.method = m.name;
    Alone alone(scene);
    const auto before = coordinates(alone.now());
    const auto count = static_cast<std::int64_t>(4 / alone.step());  // into the middle of the contact
    double contact = 0;
    for (std::int64_t i = 0; i < count; ++i) {
      alone.steps(1);
      contact = std::max(contact, alone.now().energy.contact);
    }
    CHECK(contact > 1e-2);
    alone.reverse();
    alone.steps(count);
    const auto after = coordinates(alone.now());
    double furthest = 0;
    for (std::size_t i = 0; i < before.size(); ++i) furthest = std::max(furthest, std::abs(after[i] - before[i]));
    worst = std::max(worst, furthest);
  }
  of.at_most(1e-12, worst, "furthest coordinate from the start after 4 R/c there and back [R]");
}

TEST_CASE("hard 18: Richardson's estimate of e is within 0.5 to 2 of the true error on smooth scenes") {
  Case of(18, "Richardson's estimate of e");
  const auto e_of = [](const Solid& p, const Solid& t, Scene scene, const std::string& method, double step) {
    scene.integration.method = method;
    scene.integration.step = step;
    const Outcome o = run_scene({&p, &t}, scene, go_on);
    REQUIRE(o.status == Status::finished);
    return o.e;
  };
  double worst = 1;
  // takahashi_imada and multirate by their outcome order, 4.
  for (const char* method : {"verlet", "forest_ruth", "pefrl", "chin_4a", "takahashi_imada", "multirate_3"})
    for (int seed : {1, 2, 3}) {
      Scene scene;
      scene.projectile = disk(60, 1e4, 0, seed);
      scene.target = wall(200, 1e3, 0, seed, 5, 1.5);
      scene.launch.psi1 = 1;
      const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
      const Method& m = method_named(method);
      scene.integration.method = method;
      const double step = launch(scene, {p.get(), t.get()}).step / m.usual * 0.8 * m.stability_limit;
      scene.integration.method = "pefrl";
      const double coarse = e_of(*p, *t, scene, method, step), fine = e_of(*p, *t, scene, method, step / 2);
      const double exact = e_of(*p, *t, scene, "blanes_moan_srkn14a", 0.6 * launch(scene, {p.get(), t.get()}).step);
      const double estimate = richardson(coarse, fine, m.outcome_order), error = std::abs(coarse - exact);
      INFO(method << " seed " << seed << " estimate " << estimate << " true " << error);
      worst = std::max({worst, estimate / error, error / estimate});
      CHECK(worst < 2);
    }
  of.at_most(2, worst, "estimate over true error, or the reverse: six methods of order 2 and 4, three smooth scenes");
}

TEST_CASE("hard 19: the energy of a long run has no trend") {
  Case of(19, "1e6 steps at rest and in vibration");
  const auto rest = free_disk("pefrl", 1.6, Vec2(0, 0), 0, 0);
  rest->steps(sanitized ? 100000 : 1000000);
  // Its velocities walk at random by the rounding of k eps R a step: 1e-26 of an energy each.
  of.at_most(1e-17, rest->now().energy.total() / (60 * 0.1 * 0.1 / 2),
             "energy of a disk at rest after 1e6 steps, over that of an impact at 0.1 c");
  double worst = 0, least = 0;
  for (const char* method : {"verlet", "pefrl", "chin_4a"}) {
    if (sanitized && method != std::string("verlet")) continue;
    const auto disk = free_disk(method, 0.3, Vec2(0, 0), 0, 1e-3);
    disk->steps(200000);                       // what began as motion alone becomes half stretch
    std::vector<double> block_number, energy;  // means of blocks long enough to be independent
    const double before = disk->now().energy.total();
    for (int block = 0; block < 20; ++block) {
      double mean = 0;
      for (int look = 0; look < 500; ++look) {
        disk->steps(100);
        mean += (disk->now().energy.total() / before - 1) / 500;
      }
      block_number.push_back(block);
      energy.push_back(mean);
    }
    // The slope of 20 independent numbers has the standard error sigma / sqrt(sum (i - 9.5)^2).
    const double slope = slope_of(block_number, energy);
    double square = 0, mean = 0;
    for (const double e : energy) mean += e / 20;
    for (int i = 0; i < 20; ++i) square += std::pow(energy[i] - mean - slope * (i - 9.5), 2);
    const double error = std::sqrt(square / 18 / 665);
    INFO(method << " slope " << slope << " +- " << error);
    worst = std::max(worst, std::abs(slope) / error);
    least = std::max(least, 20 * error);
  }
  of.at_most(3, worst, "trend of a vibrating disk's energy over 1e6 steps, in its standard errors");
  of.told(least, "that standard error, relative to the energy (verlet; pefrl and chin_4a below)");
}
