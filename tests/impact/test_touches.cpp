// When bodies touch: the clock by itself, and contact times of impacts.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "impact/watch/touches.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

/// A load that rises and falls as the logarithm -40 (t - 1)^2 + 8 (t - 1)^3, samples of it a step apart.
double skew_load(double t) {
  const double x = t - 1;
  return std::abs(x) < 2 ? std::exp(-40 * x * x + 8 * x * x * x) : 0;
}

TouchClock clock_of(double step, double share, const std::function<double(double)>& load, double until) {
  TouchClock clock(1e-9, share, step);
  for (double t = 0.3 * step; t < until; t += step)
    if (clock.wants(load(t))) clock.follow({t, load(t)});
  return clock;
}

/// Where a load is `level`, between two times.
double passes(const std::function<double(double)>& load, double level, double low, double high) {
  const bool rises = load(high) > load(low);
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    ((load(middle) < level) == rises ? low : high) = middle;
  }
  return low;
}

/// A smooth disk that drops on a plane.
Scene drop(const std::string& method) {
  Scene scene;
  scene.projectile = disk(60, 1e4, 0, 3);
  Body plane;
  plane.plane = Plane{};
  scene.target = std::make_shared<Body>(plane);
  scene.contact = {150, 300, 0.1, "one"};
  scene.integration.method = method;
  return scene;
}

double contact_time_at(const BuiltSolids& solids, Scene scene, double theta) {
  scene.integration.theta = theta;
  const Outcome o = run_scene(solids, scene, go_on);
  INFO(o.reason);
  REQUIRE(o.status == Status::finished);
  return o.contact_time;
}

}  // namespace

TEST_CASE("both ends of a touch are found between steps, at order 5") {
  for (const double share : {1e-3, 1e-2}) {
    const double from = passes(skew_load, share, 0, 1), to = passes(skew_load, share, 1, 2.5);
    std::vector<double> errors;
    for (const double step : {0.02, 0.01, 0.005}) {
      const TouchClock clock = clock_of(step, share, skew_load, 3);
      REQUIRE(clock.count() == 1);
      CHECK(clock.last_counts());
      errors.push_back(std::max(std::abs(clock.begin() - from), std::abs(clock.end() - to)));
    }
    INFO(fmt::format("share {:g}: {:.2e} {:.2e} {:.2e}", share, errors[0], errors[1], errors[2]));
    CHECK(errors[0] < 1e-6);
    CHECK(errors[2] < errors[0] / 500);  // order 4.5
  }
}

TEST_CASE("the moments at which the load passes the floor are found between steps") {
  const double floor = 1e-9;
  const TouchClock clock = clock_of(0.01, 1e-3, skew_load, 3);
  const double lasts = passes(skew_load, floor, 1, 2.5) - passes(skew_load, floor, 0, 1);
  CHECK(clock.time_above_floor() == Catch::Detail::Approx(lasts).margin(1e-6));
}

TEST_CASE("a touch of less than a thousandth of the greatest load does not count, earlier or later") {
  const auto three = [](double t) { return 1e-4 * skew_load(t) + skew_load(t - 3) + 0.1 * skew_load(t - 6); };
  const TouchClock clock = clock_of(0.01, 1e-3, three, 10);
  CHECK(clock.count() == 2);
  const double from = passes(skew_load, 1e-3, 0, 1), to = passes(skew_load, 1e-3, 1, 2.5);
  CHECK(clock.begin() == Catch::Detail::Approx(3 + from).margin(1e-6));
  const TouchClock earlier = clock_of(0.01, 1e-3, three, 5);
  CHECK(earlier.end() == Catch::Detail::Approx(3 + to).margin(1e-6));
  CHECK(clock.end() == Catch::Detail::Approx(6 + to).margin(1e-6));  // of its own greatest load
}

TEST_CASE("a touch lasts as long as its load stays above the share of the greatest so far") {
  const auto twice = [](double t) { return skew_load(t) + 0.5 * skew_load(t - 0.6) + 1e-9; };
  TouchClock clock(1e-8, 1e-3, 0.01);
  for (double t = 0; t < 1.2; t += 0.01) clock.follow({t, twice(t)});
  CHECK(clock.touching());
  CHECK(std::isnan(clock.end()));
  CHECK(std::isfinite(clock.begin()));
  for (double t = 1.2; t < 3; t += 0.01) clock.follow({t, twice(t)});
  CHECK(clock.count() == 1);
}

TEST_CASE("contact_time converges at the order of the method") {
  for (const char* method : {"verlet", "pefrl", "chin_4a"}) {
    const Scene scene = drop(method);
    const BuiltSolids solids(scene);
    const double exact = contact_time_at(solids, drop("blanes_moan_srkn14a"), 0.8),
                 limit = method_named(method).stability_limit;
    const double coarse = std::abs(contact_time_at(solids, scene, 0.6 * limit) - exact),
                 fine = std::abs(contact_time_at(solids, scene, 0.15 * limit) - exact);
    INFO(fmt::format("{}: {:.3e} {:.3e}", method, coarse, fine));
    CHECK(std::log2(coarse / fine) / 2 == Catch::Detail::Approx(method_named(method).order).margin(0.6));
  }
}

TEST_CASE("a slow disk with much spin touches, and what it does is told") {
  Scene scene = drop("auto");
  scene.launch.speed = 1e-3;
  scene.launch.spin = 1;
  const Outcome o = run_scene(BuiltSolids(scene), scene, go_on);
  INFO(o.reason);
  CHECK(o.status != Status::no_contact);
}
