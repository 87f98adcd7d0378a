// Surfaces that are no ring, and lists of bodies: what contact, endings and the engine must not assume.

#include <catch2/catch.hpp>
#include <cmath>

#include "body/springs/sweep_kernel.hpp"
#include "contact/contacts.hpp"
#include "core/rng.hpp"
#include "impact/engine.hpp"
#include "impact/launch/launch.hpp"
#include "impact/watch/parting.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

Points ring_of(double radius, int corners, double turn) {
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners + turn;
    points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

/// A disk with a round hole: an outer chain counter-clockwise, an inner one clockwise.
struct Washer {
  Points points;
  Surface surface;
};
Washer washer(int corners) {
  Washer made;
  Mesh<2> mesh;
  const Points outer = ring_of(1, corners, 0);
  Points inner = ring_of(0.4, corners, 0.1);
  std::reverse(inner.begin(), inner.end());
  for (const Points& chain : {outer, inner}) {
    const int first = static_cast<int>(made.points.size());
    made.points.insert(made.points.end(), chain.begin(), chain.end());
    for (auto [a, b] : ring(corners)) mesh.cell.push_back({a + first, b + first});
  }
  for (int k = 0; k < static_cast<int>(made.points.size()); ++k) mesh.node.push_back(k);
  made.surface = mesh;
  return made;
}

/// A body of one surface, of which nothing moves.
Solid held(const Points& points, const Surface& surface) {
  Solid solid;
  solid.points = solid.smooth = points;
  solid.surface = surface;
  solid.interior = Rigid{};
  return solid;
}

}  // namespace

TEST_CASE("cells of several chains, closed or open, are taken apart into them") {
  const auto washer_chains = chains_of(std::get<Mesh<2>>(washer(5).surface).cell);
  REQUIRE(washer_chains.size() == 2);
  CHECK((washer_chains[0].closed && washer_chains[1].closed));
  CHECK(washer_chains[1].node == std::vector<int>{5, 6, 7, 8, 9});
  const auto open = chains_of({{0, 1}, {1, 2}, {3, 4}, {4, 5}, {5, 3}});
  REQUIRE(open.size() == 2);
  CHECK((!open[0].closed && open[0].node == std::vector<int>{0, 1, 2}));
  CHECK((open[1].closed && open[1].node == std::vector<int>{3, 4, 5}));
}

TEST_CASE("the inside of a body with a hole is between its chains, and the nearest cell may be of either") {
  const Washer w = washer(200);
  const PlacedSurface surface(w.surface, w.points);
  Random random(3, 0);
  for (int i = 0; i < 500; ++i) {
    const Vec2 p(random.uniform(-1.3, 1.3), random.uniform(-1.3, 1.3));
    const double r = p.norm();
    if (std::abs(r - 1) < 1e-3 || std::abs(r - 0.4) < 1e-3) continue;
    CHECK(surface.contains(p) == (r > 0.4 && r < 1));
    const double expected = std::min(std::abs(r - 1), std::abs(r - 0.4));
    CHECK(surface.distance(p, 10) == Catch::Detail::Approx(expected).margin(1e-3));
  }
  // A small body in the hole touches nothing, and is not inside.
  const Points small = ring_of(0.1, 30, 0);
  Mesh<2> mesh;
  for (int k = 0; k < 30; ++k) mesh.node.push_back(k);
  mesh.cell = ring(30);
  const Surface small_surface = mesh;
  const PlacedSurface inside(small_surface, small);
  CHECK(distance_of(inside, surface) == Catch::Detail::Approx(0.3).margin(2e-3));
  CHECK_FALSE(inside_one_another(inside, surface, true, 0));
  Points moved = small;
  for (Vec2& p : moved) p.x() += 0.45;
  CHECK(inside_one_another(PlacedSurface(small_surface, moved), surface, true, 0));
}

TEST_CASE("an open chain pushes nodes off its cells, and nothing joins its ends") {
  const Points line{{-1, 0}, {0, 0}, {1, 0}};
  Mesh<2> open;
  open.node = {0, 1, 2};
  open.cell = {{0, 1}, {1, 2}};
  Mesh<2> closed = open;
  closed.cell = ring(3);
  Mesh<2> point;
  point.node = {0, 1};
  point.cell = {{0, 1}};
  const Solid above = held({{0.3, 0.01}, {0.3, 5}}, point);
  const auto energy = [&](const Surface& surface) {
    const Solid below = held(line, surface);
    Contacts<1> contacts({&above, &below}, {});
    ExponentialRepulsion law = paper_contact();
    contacts.set(0, &law);
    Motions<1> bodies{at_rest<1>(above), at_rest<1>(below)};
    return contacts.energy(bodies)[0];
  };
  const ExponentialRepulsion law = paper_contact();
  const double on_cell = law.energy(0.01);
  CHECK(energy(open) == Catch::Detail::Approx(on_cell).epsilon(1e-12));
  CHECK(energy(closed) == Catch::Detail::Approx(2 * on_cell).epsilon(1e-12));  // the ring's last cell lies along both
}

TEST_CASE("a node's share of the rim weighs its repulsion") {
  const Points line{{-1, 0}, {1, 0}};
  Mesh<2> below, above;
  below.node = above.node = {0, 1};
  below.cell = above.cell = {{0, 1}};
  above.weight = {0.25, 1};
  const Solid a = held({{0.3, 0.01}, {0.3, 5}}, above), b = held(line, below);
  Contacts<1> contacts({&a, &b}, {});
  ExponentialRepulsion law = paper_contact();
  law.by_length = true;
  contacts.set(0, &law);
  Motions<1> bodies{at_rest<1>(a), at_rest<1>(b)};
  std::vector<Lane<1>> energy(1);
  contacts.push(bodies, energy);
  CHECK(energy[0][0] == Catch::Detail::Approx(0.25 * law.energy(0.01)).epsilon(1e-12));
  CHECK(bodies[0].f.at(0, 0).y() == Catch::Detail::Approx(0.25 * law.force(0.01)).epsilon(1e-12));
}

TEST_CASE("the sweep in space has the bits of the plane on a planar lattice") {
  const auto solid = build_solid(*wall(150, 400, 0.02, 2));
  const Springs& springs = *solid->springs();
  constexpr int W = lanes;
  Motion<W> flat = at_rest<W>(*solid), space{solid.get(), {}, {}, {}};
  flat.stiffness.setConstant(400);
  space.stiffness = flat.stiffness;
  Random random(1, 1);
  for (int i = 0; i < solid->free; ++i)
    for (int lane = 0; lane < W; ++lane) flat.q.add(i, lane, 0.01 * Vec2(random.normal(), random.normal()));
  for (Coordinates<W>* values : {&space.q, &space.v, &space.f}) values->resize(3 * solid->nodes());
  for (int i = 0; i < solid->nodes(); ++i)
    for (int d = 0; d < 2; ++d) space.q[3 * i + d] = flat.q[2 * i + d];
  const Lane<W> kick = Lane<W>::Constant(1e-3), drift = Lane<W>::Constant(2e-3);
  for (int step = 0; step < 2000; ++step) {
    kick_and_drift<2>(flat, springs, kick, drift);
    kick_and_drift<3>(space, springs, kick, drift);
  }
  bool same = true, planar = true;
  for (int i = 0; i < solid->nodes(); ++i) {
    for (int d = 0; d < 2; ++d)
      same = same && (space.q[3 * i + d] == flat.q[2 * i + d]).all() && (space.v[3 * i + d] == flat.v[2 * i + d]).all();
    planar = planar && (space.q[3 * i + 2] == 0).all();
  }
  CHECK(same);
  CHECK(planar);
}

TEST_CASE("nodes with masses of their own, all alike, move as nodes of one mass do") {
  const auto solid = build_solid(*disk(60, 1e4, 0.02, 1));
  Solid own = *solid;
  own.mass = Masses(std::vector<double>(static_cast<std::size_t>(solid->nodes()), 1.0));
  Scene scene = small_scene(1, 1);
  const BuiltSolids built(scene);
  const std::atomic<bool> go_on{false};
  for (const char* method : {"pefrl", "multirate_3", "takahashi_imada"}) {
    scene.integration.method = method;
    const Solid heavier = [&] {
      Solid copy = built[1];
      copy.mass = Masses(std::vector<double>(static_cast<std::size_t>(copy.nodes()), 1.0));
      return copy;
    }();
    const Outcome a = run_scene(built, scene, go_on), b = run_scene({&built[0], &heavier}, scene, go_on);
    CHECK(a.e == Catch::Detail::Approx(b.e).epsilon(1e-9));
    CHECK(a.energy_closure == Catch::Detail::Approx(b.energy_closure).margin(1e-9));
  }
  // A node ten times as heavy keeps energy and momentum: the frequency bound, drag, damping and the ledger know it.
  std::vector<double> masses(static_cast<std::size_t>(solid->nodes()), 1.0);
  for (std::size_t i = 0; i < masses.size(); i += 3) masses[i] = 10;
  own.mass = Masses(masses);
  scene.integration.method = "pefrl";
  scene.projectile = disk(60, 1e4, 0.02, 1);
  const Outcome heavy = run_scene({&own, &built[1]}, scene, go_on);
  CHECK(heavy.status == Status::finished);
  CHECK(heavy.energy_closure < 1e-6);
  scene.integration.method = "verlet";
  scene.effects = {Drag{0.05, "projectile"}, Damping{1e-3, "projectile"}, Gravity{1e-3, "projectile"}};
  const Outcome damped = run_scene({&own, &built[1]}, scene, go_on);
  CHECK(damped.status == Status::finished);
  CHECK(damped.energy_closure < 1e-3);
}

TEST_CASE("a third body far away changes no bit of an impact") {
  const Scene scene = small_scene(1, 1);
  const BuiltSolids built(scene);
  const auto third = build_solid(*disk(40, 1e4, 0, 3));
  Start two = launch(scene, built), three = two;
  three.bodies.push_back(placed_at_rest(*third));
  three.bodies.back().centre.y() -= 100;
  three.stiffness.push_back(1);  // softer than both, so that its frequencies set no bound
  const auto run = [&](const Solids& solids, const Start& start) {
    Engine<1> engine(solids, scene.method(), {});
    engine.begin(0, scene, 0, start);
    for (;;) {
      for (int i = 0; i < engine.steps_between_looks(); ++i) engine.advance_one_step();
      for (const auto& [lane, outcome] : engine.look()) return outcome;
    }
  };
  const Outcome a = run(built, two), b = run({&built[0], &built[1], third.get()}, three);
  CHECK(a.status == Status::finished);
  CHECK(exact_text(a) == exact_text(b));
  CHECK(b.after.bodies.size() == 3);
}

TEST_CASE("a body in a hole touches nothing until it comes to the hole's rim, and bounces off it there") {
  Body plate{{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, numbers(700, 1, 0, 1), {}, {}};
  plate.numbers.interior = "rigid";
  plate.holes = {{{-2, -2}, {-2, 2}, {2, 2}, {2, -2}}};
  Scene scene;
  scene.projectile = std::make_shared<Body>(Body{circle(0.3), numbers(40, 1e4, 0, 1, "triangular"), {}, {}});
  scene.target = std::make_shared<Body>(plate);
  scene.contact = paper_contact();
  scene.contact.sides = "two";
  scene.launch.speed = 0.1;
  const BuiltSolids built(scene);
  const Solid& ball = built[0];
  const PlacedSurface frame(built[1].surface, surface_points(built[1]));
  Start start = launch(scene, built);
  Placement& at = start.bodies[0];
  const auto standing = [&](double height) {
    at.centre = Vec3(0, height, 0);
    return placed(surface_points(ball), ball.centre(), at);
  };
  CHECK(inside_one_another(PlacedSurface(ball.surface, standing(-1.8)), frame, true, 0));
  CHECK_FALSE(inside_one_another(PlacedSurface(ball.surface, standing(0)), frame, true, 0));
  CHECK(distance_of(PlacedSurface(ball.surface, standing(0)), frame) == Catch::Detail::Approx(1.7).epsilon(0.01));
  Engine<1> engine(built, scene.method(), {});
  engine.begin(0, scene, 0, start);
  const double energy = engine.snapshot(0).energy.total();
  while (engine.run(0).time() < 30) engine.advance_one_step();  // 17 R/c down, the rest up again
  const Snapshot after = engine.snapshot(0);
  double up = 0;
  for (const Vec2& v : after.bodies[0].velocity) up += v.y() / ball.nodes();
  CHECK(up > 0.09);
  CHECK(after.energy.total() == Catch::Detail::Approx(energy).epsilon(1e-5));
}

TEST_CASE("the skin of the contact's lists changes no bit, for two bodies and for six that meet at random") {
  Random random(11, 0);
  const auto solid = build_solid(*disk(40, 1e3, 0.02, 1));
  const std::vector<const Solid*> solids(6, solid.get());
  ExponentialRepulsion law = paper_contact();
  law.sides = "two";
  const auto contacts_with = [&](double skin) {
    ContactLaws laws;
    laws.skin = skin;
    Contacts<1> contacts(solids, laws);
    contacts.set(0, &law);
    return contacts;
  };
  Contacts<1> thin = contacts_with(0.25), usual = contacts_with(0.5), thick = contacts_with(1);
  Motions<1> bodies;
  Points way;
  for (int b = 0; b < 6; ++b) {
    bodies.push_back(at_rest<1>(*solid));
    const Vec2 from(2.1 * (b % 3), 2.1 * (b / 3));
    for (int i = 0; i < solid->nodes(); ++i) bodies.back().q.add(i, 0, from);
    way.push_back(0.004 * Vec2(random.normal(), random.normal()));
  }
  double most = 0;
  for (int step = 0; step < 300; ++step) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (int i = 0; i < solid->nodes(); ++i) bodies[b].q.add(i, 0, std::sin(0.05 * step) * way[b]);
    Motions<1> by_thin = bodies, by_usual = bodies, by_thick = bodies;
    std::vector<Lane<1>> energy(usual.size());
    thin.push(by_thin, energy);
    usual.push(by_usual, energy);
    thick.push(by_thick, energy);
    for (const Lane<1>& pair : energy) most = std::max(most, pair[0]);
    bool same = true;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (int c = 0; c < by_usual[b].f.size(); ++c)
        same = same && by_thin[b].f[c][0] == by_usual[b].f[c][0] && by_thick[b].f[c][0] == by_usual[b].f[c][0];
    REQUIRE(same);
  }
  CHECK(most > 1);
}
