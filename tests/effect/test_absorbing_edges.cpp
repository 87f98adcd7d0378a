// Edges that let waves out: of plane waves, of a sphere on a half-space, and what they book.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "effect/acting.hpp"
#include "impact/batch.hpp"
#include "impact/estimate.hpp"
#include "refusal.hpp"
#include "same_bits.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};
const std::vector<Turn> unturned(2);

Lane<1> one(double value) { return Lane<1>::Constant(value); }
std::size_t at(int i) { return static_cast<std::size_t>(i); }

Body cylinder(double radius, double height, double h_min, double h_max, double nu = 0.25) {
  Body block{{{0, -height}, {radius, -height}, {radius, 0}, {0, 0}}, element_numbers(0, 1e4, nu), {}, {}};
  block.numbers.state = "axisymmetric";
  block.numbers.h_min = h_min;
  block.numbers.h_max = h_max;
  block.numbers.fine_within = 4 * h_min;
  block.fine_at = Vec2(0, 0);
  return block;
}

Body sphere(double h_min) {
  Body ball{half_circle(1, 1000), element_numbers(0, 1e4, 0.25), {}, {}};
  ball.numbers.state = "axisymmetric";
  ball.numbers.h_min = h_min;
  ball.numbers.h_max = 0.3;
  return ball;
}

const double c0 = std::sqrt(1e4 / usual_density);

Scene onto(const Body& block, double speed) {
  Scene scene;
  scene.projectile = std::make_shared<Body>(sphere(0.06));
  scene.target = std::make_shared<Body>(block);
  scene.launch.speed = speed * c0;
  return scene;
}

Outcome run(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

/// A plane pulse runs down a wide block of plane strain, meets its lower edge and comes back: what of its velocity is
/// left in the middle, which the block's sides do not reach in that time. `across`: along its way, a pressure wave;
/// else a shear wave.
double came_back(const Solid& block, bool across, double impedance) {
  constexpr double E = 100, nu = 0.3, middle = -2, below = -5, spread = 0.4;
  const Lame lame = lame_of(nu, "plane_strain");
  const double speed = std::sqrt((across ? lame.lambda + 2 * lame.mu : lame.mu) * E / usual_density);
  Motions<1> bodies{at_rest<1>(block), at_rest<1>(block)};
  for (Motion<1>& body : bodies) body.stiffness = one(E);
  Motion<1>& moving = bodies[1];
  const Vec2 direction = across ? Vec2(0, 1) : Vec2(1, 0);
  for (int i = 0; i < block.nodes(); ++i) {
    const double s = (block.points[at(i)].y() - middle) / spread, f = 1e-4 * std::exp(-s * s / 2);
    moving.q.add(i, 0, f * direction);
    moving.v.set(i, 0, -speed * s / spread * f * direction);  // of f(y + c t)
  }
  ActingEffects<1> acting({AbsorbingEdges{impedance}}, {&block, &block});
  const double h = 0.5 / frequency_bound(block, E).omega;
  acting.begin(0, h, {}, bodies, unturned);
  const int steps = static_cast<int>(std::round(2 * (middle - below) / speed / h));
  for (int k = 0; k < steps; ++k) {
    acting.dissipate(bodies, one(h / 2), true);
    drift(moving, one(h / 2));
    kick_and_drift(moving, one(h), one(h / 2));
    acting.dissipate(bodies, one(h / 2), false);
  }
  double sum = 0;
  for (int i = 0; i < block.nodes(); ++i) {
    const Vec2 p = block.points[at(i)];
    const double s = (p.y() - middle) / spread;
    if (std::abs(p.x()) < 1) sum += block.mass[i] * direction.dot(moving.v.at(i, 0)) * s * std::exp(-s * s / 2);
  }
  return sum;
}

}  // namespace

TEST_CASE("absorbing edges send back the share of a plane wave that their doc says, of pressure and of shear") {
  Body wide{box(26, 5), element_numbers(6000, 100, 0.3, "linear", "triangular"), {}, {}};
  wide.numbers.state = "plane_strain";
  const auto block = build_solid(wide);
  for (const bool across : {true, false}) {
    const double whole = came_back(*block, across, 1e-9);
    for (const double s : {0.5, 1.0, 2.0}) {
      const double back = came_back(*block, across, s) / whole;
      INFO((across ? "pressure" : "shear") << ", impedance " << s << ": " << back << " comes back");
      CHECK(back == Catch::Detail::Approx((1 - s) / (1 + s)).margin(0.02));
    }
  }
}

TEST_CASE("absorbing edges of a cylinder weigh the areas of its rings, with the material's impedances") {
  const double radius = 2, height = 1.5, nu = 0.25;
  Body body = cylinder(radius, height, 0.1, 0.4, nu);
  const Lame lame = lame_of(nu, "axisymmetric");
  const auto sums = [](const Solid& solid) {
    std::array<double, 3> sum{};
    for (const EdgeDashpot& d : AbsorbingEdges{}.dashpots(solid)) {
      CHECK(d.xx >= 0);
      CHECK(d.xx * d.yy >= d.xy * d.xy * (1 - 1e-12));
      sum[0] += d.xx;
      sum[1] += d.xy;
      sum[2] += d.yy;
    }
    return sum;
  };
  const auto solid = build_solid(body);
  const std::array<double, 3> sum = sums(*solid);
  const double below = std::numbers::pi * radius * radius, side = 2 * std::numbers::pi * radius * height;
  const double pressure = std::sqrt(usual_density * (lame.lambda + 2 * lame.mu)),
               shear = std::sqrt(usual_density * lame.mu);
  CHECK(sum[2] == Catch::Detail::Approx(pressure * below + shear * side).epsilon(1e-9));
  CHECK(std::abs(sum[1]) < 1e-9 * sum[2]);
  // The node on the axis, which cannot leave it, needs none across: pi h^2/3 of the area below.
  const double across = pressure * side + shear * below;
  CHECK(sum[0] < across);
  CHECK(sum[0] > across - shear * std::numbers::pi * 0.4 * 0.4 / 3 - 1e-9);
  // Four times the modulus everywhere, by a function, has twice the impedance.
  body.node_stiffness.assign(at(solid->nodes()), 4e4);
  CHECK(sums(*build_solid(body))[2] == Catch::Detail::Approx(2 * sum[2]).epsilon(1e-9));
}

TEST_CASE("absorbing edges book what they take, for steps of any length, and stop what they hold in a long one") {
  const auto block = build_solid(cylinder(2, 1.5, 0.2, 0.4));
  const std::vector<EdgeDashpot> dashpots = AbsorbingEdges{}.dashpots(*block);
  for (const double h : {1e-4, 0.1, 1e6}) {
    Motions<1> bodies{at_rest<1>(*block), at_rest<1>(*block)};
    Motion<1>& moving = bodies[1];
    moving.stiffness = one(1e4);
    Random random(3, 5);
    for (int i = 0; i < block->free; ++i) {
      const double vx = block->points[at(i)].x() == 0 ? 0 : random.normal(), vy = random.normal();
      moving.v.set(i, 0, Vec2(vx, vy));
    }
    const auto kinetic = [&] {
      double sum = 0;
      for (int i = 0; i < block->free; ++i) sum += block->mass[i] * moving.v.at(i, 0).squaredNorm() / 2;
      return sum;
    };
    Edges<1> edges(2);
    edges.let(1, dashpots);
    edges.begin(0, h, bodies);
    const double before = kinetic(), lost = edges.damp(moving, 1)[0];
    CAPTURE(h);
    CHECK(lost > 0);
    CHECK(lost == Catch::Detail::Approx(before - kinetic()).epsilon(1e-9));
    if (h > 1e3)
      for (const EdgeDashpot& d : dashpots) CHECK(moving.v.at(d.node, 0).norm() < 1e-12);
  }
}

TEST_CASE("a block with absorbing edges takes of a sphere's rebound what one does from which no wave is back yet") {
  // The large one ends before its own edges' waves are back at the sphere: 16 R/c0 of contact, 2 x 10 R/c_P. The small
  // one moves as a whole, on dashpots that bear no lasting load, and takes a little more; held, it gives all back.
  const double speed = 0.01, extent = 5;
  const Outcome half_space = run(onto(cylinder(10, 10, 0.06, 0.8), speed)), held = [&] {
    Body block = cylinder(extent, extent, 0.06, 0.8);
    for (const Vec2& p : ricochet::plan_nodes(block, {}).points)
      block.anchored.push_back(p.y() < -extent + 1e-9 || p.x() > extent - 1e-9);
    return run(onto(block, speed));
  }();
  Scene scene = onto(cylinder(extent, extent, 0.06, 0.8), speed);
  scene.effects = {AbsorbingEdges{}};
  const Outcome small = run(scene);
  for (const Outcome* o : {&half_space, &held, &small}) REQUIRE(o->status == Status::finished);
  const auto lost = [](const Outcome& o) {
    return 1 - (o.after.of(0).translation + o.after.of(0).vibration) / o.before.total();
  };
  const double law = 1.11 * std::pow(speed, 0.6);
  fmt::print(
      "lost of a sphere's energy at 0.01 c0: {:.5f} ({:.5f} by theory), absorbing {:.5f}, held {:.5f}; {:.5f} left "
      "by the edges; closure {:.1e}\n",
      lost(half_space), law, lost(small), lost(held),
      small.effect_energy[Effect(AbsorbingEdges{}).index()] / small.before.total(), small.energy_closure);
  CHECK(std::abs(lost(half_space) - law) < 0.1 * law);
  CHECK(std::abs(lost(small) - lost(half_space)) < 0.15 * lost(half_space));
  CHECK(std::abs(lost(held) - lost(half_space)) > 2 * std::abs(lost(small) - lost(half_space)));
  CHECK(small.effect_energy[Effect(AbsorbingEdges{}).index()] > 0.3 * lost(small) * small.before.total());
  CHECK(small.energy_closure < 1e-5);
}

TEST_CASE("a half-space that is too small for its contact is told, where it takes more than 15 % too much") {
  using Catch::Matchers::Contains;
  const double speed = 0.01, theory = 1.11 * std::pow(speed, 0.6);
  struct Case {
    double extent;
    bool open;
  };
  for (const auto& [extent, open] : {Case{3, true}, Case{6, true}, Case{5, false}, Case{8, false}}) {
    Body block = cylinder(extent, extent, 0.06, 0.8);
    for (const Vec2& p : ricochet::plan_nodes(block, {}).points)
      block.anchored.push_back(p.x() == 0 && p.y() == -extent);
    Scene scene = onto(block, speed);
    if (open) scene.effects = {AbsorbingEdges{}};
    const Outcome o = run(scene);
    REQUIRE(o.status == Status::finished);
    const double lost = 1 - (o.after.of(0).translation + o.after.of(0).vibration) / o.before.total();
    const Estimate told = estimate(scene);
    const auto doubt = std::find_if(told.doubts.begin(), told.doubts.end(),
                                    [](const Doubt& d) { return d.kind == "small_half_space"; });
    const bool warned = doubt != told.doubts.end();
    fmt::print("half-space of {} R, {}: {:.3f} of the loss by theory, {}\n", extent, open ? "absorbing" : "free",
               lost / theory, warned ? doubt->reason : "not warned of");
    CHECK(warned == (lost > 1.15 * theory));
    CHECK(warned == (extent < 5.5));
    if (warned) CHECK_THAT(doubt->reason, Contains("take extent = "));
    if (warned) CHECK(doubt->reason.ends_with("or add ricochet.absorbing_edges {}") == !open);
  }
}

TEST_CASE("absorbing edges: the ledger closes ever better with a shorter step, and lanes have the same bits") {
  Scene scene = onto(cylinder(2, 2, 0.15, 0.4), 0.02);
  scene.projectile = std::make_shared<Body>(sphere(0.15));
  scene.effects = {AbsorbingEdges{0.7}, Gravity{1e-4, "both"}};
  const Outcome usual = run(scene);
  REQUIRE(usual.status == Status::finished);
  Scene finer = scene;
  finer.integration.step = usual.step / 4;
  CHECK(run(finer).energy_drift < usual.energy_drift / 8);
  std::vector<Scene> list;
  for (const double speed : {0.01, 0.02, 0.03, 0.05, 0.08}) {
    list.push_back(scene);
    list.back().launch.speed = speed * c0;
  }
  const std::vector<std::string> alone = exact_texts(list, 1, 1);
  for (const int batch : {2, 3, 4}) CHECK(exact_texts(list, 2, batch) == alone);
}

TEST_CASE("absorbing edges are refused by name where there are none") {
  using Catch::Matchers::Contains;
  Body block = cylinder(2, 2, 0.2, 0.4);
  for (const Vec2& p : ricochet::plan_nodes(block, {}).points)
    block.anchored.push_back(p.y() < -2 + 1e-9 || p.x() > 2 - 1e-9);
  Scene scene = onto(block, 0.02);
  scene.effects = {AbsorbingEdges{}};
  CHECK_THAT(refusal(scene), Contains("absorbing_edges: the target has no free edge that faces away"));
  Body plane;
  plane.plane = Plane{};
  scene.target = std::make_shared<Body>(plane);
  CHECK_THAT(refusal(scene), Contains("absorbing_edges acts on elements, and the target is rigid"));
  scene = small_scene();
  scene.effects = {AbsorbingEdges{}};
  CHECK_THAT(refusal(scene), Contains("absorbing_edges acts on elements, and the target is of springs"));
  scene = onto(cylinder(2, 2, 0.2, 0.4), 0.02);
  scene.effects = {AbsorbingEdges{}, MovingAnchor{0.02, 0.4, 30, "normal"}};
  CHECK_THAT(refusal(scene), Contains("absorbing_edges damps against a wall at rest"));
}
