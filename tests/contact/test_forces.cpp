#include <catch2/catch.hpp>
#include <cmath>

#include "body/springs/sweep.hpp"
#include "contact/contacts.hpp"
#include "core/rng.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

template <int W>
Motion<W> at_rest(const Solid& lattice, double stiffness) {
  Motion<W> body = ricochet::at_rest<W>(lattice);
  body.stiffness.setConstant(stiffness);
  return body;
}

template <int W>
void shake(Motion<W>& body, double size, int lane, std::uint64_t seed) {
  Random random(seed, 9);
  for (int i = 0; i < body.solid->nodes(); ++i) {
    const double x = size * random.normal(), y = size * random.normal();
    if (i < body.solid->free) body.q.add(i, lane, {x, y});
  }
}

}  // namespace

namespace {

Surface surface_of(const Points& outline) {
  Mesh<2> mesh;
  for (std::size_t i = 0; i < outline.size(); ++i) mesh.node.push_back(static_cast<int>(i));
  mesh.cell = ring(static_cast<int>(outline.size()));
  return mesh;
}

double outline_distance(const Points& a, const Points& b) {
  const Surface of_a = surface_of(a), of_b = surface_of(b);
  return distance_of(PlacedSurface(of_a, a), PlacedSurface(of_b, b));
}

}  // namespace

TEST_CASE("spring forces are minus the gradient of the spring energy, with a stiffness of every place its own") {
  Body body{box(2, 1), numbers(60, 30, 0, 1), {}, {}};
  body.numbers.quartic = 5;
  const NodePlan plan = plan_nodes(body.outline, body.numbers, {});
  for (const Vec2& p : plan.points) body.node_stiffness.push_back(30 * (1.5 + p.x() + 0.3 * p.y()));
  const auto lattice = build_solid(body);
  auto moving = at_rest<1>(*lattice, 30);
  shake(moving, 0.03, 0, 1);
  auto kicked = moving;
  kick_and_drift(kicked, Lane<1>::Ones(), Lane<1>::Zero());  // velocity = force
  Vec2 total = Vec2::Zero();
  for (int i = 0; i < lattice->nodes(); ++i) {
    total += kicked.v.at(i, 0);
    for (int axis = 0; axis < 2; ++axis) {
      const double h = 1e-5;
      const auto energy = [&](double shift) {
        auto moved = moving;
        moved.q.add(i, 0, axis == 0 ? Vec2(shift, 0) : Vec2(0, shift));
        return interior_energy(moved)[0];
      };
      CHECK(kicked.v.at(i, 0)[axis] ==
            Catch::Detail::Approx(-(energy(h) - energy(-h)) / (2 * h)).epsilon(1e-6).margin(1e-7));
    }
  }
  CHECK(total.norm() < 1e-12);
}

TEST_CASE("a lane has the same bits alone and among others") {
  const auto lattice = build_solid(*wall(150, 400, 0.02, 2));
  auto many = at_rest<lanes>(*lattice, 400);
  for (int lane = 0; lane < lanes; ++lane) shake(many, 0.01 * (lane + 1), lane, 10 + lane);
  const Lane<lanes> kick = Lane<lanes>::Constant(1e-3), drift = Lane<lanes>::Constant(2e-3);
  std::vector<Motion<1>> alone;
  for (int lane = 0; lane < lanes; ++lane) {
    alone.push_back(at_rest<1>(*lattice, 400));
    shake(alone.back(), 0.01 * (lane + 1), 0, 10 + lane);
  }
  for (int step = 0; step < 50; ++step) {
    kick_and_drift(many, kick, drift);
    for (auto& one : alone) kick_and_drift(one, Lane<1>::Constant(1e-3), Lane<1>::Constant(2e-3));
  }
  for (int lane = 0; lane < lanes; ++lane)
    for (int i = 0; i < lattice->nodes(); ++i) {
      REQUIRE(many.q.at(i, lane) == alone[lane].q.at(i, 0));
      REQUIRE(many.v.at(i, lane) == alone[lane].v.at(i, 0));
      if (i >= lattice->free) REQUIRE(many.q.at(i, lane) == lattice->points[i]);  // anchors never move
    }
}

TEST_CASE("contact forces are minus the gradient of the contact energy, one-sided and two-sided, vertices included") {
  const auto disk_lattice = build_solid(*disk(60, 1e4, 0.03, 1));
  const auto wall_lattice = build_solid(*wall(150, 100, 0.03, 1));
  Random random(5, 5);
  for (const char* sides : {"one", "two"}) {
    ExponentialRepulsion law = paper_contact();
    law.sides = sides;
    law.V0 = 37;
    law.xi = 250;
    for (int pose = 0; pose < 60; ++pose) {
      Motions<1> bodies{at_rest<1>(*disk_lattice, 1e4), at_rest<1>(*wall_lattice, 100)};
      const Vec2 shift(random.uniform(-1, 1), 1 + random.uniform(-0.2, 0.08));  // deep overlaps as well
      for (int i = 0; i < disk_lattice->nodes(); ++i) bodies[0].q.add(i, 0, shift);
      Contacts<1> contact({disk_lattice.get(), wall_lattice.get()}, {});
      contact.set(0, &law);
      std::vector<Lane<1>> energy(1);
      contact.push(bodies, energy);
      CHECK(energy[0][0] == contact.energy(bodies)[0]);
      Vec2 total = Vec2::Zero();
      double largest = 0;
      for (Motion<1>& body : bodies)
        for (int i = 0; i < body.solid->nodes(); ++i) {
          total += body.f.at(i, 0);
          largest = std::max(largest, body.f.at(i, 0).norm());
        }
      CHECK(total.norm() <= 1e-13 * std::max(1.0, largest) * 100);  // action and reaction
      for (Motion<1>& body : bodies)
        for (const int node : surface_nodes(body.solid->surface))
          for (int axis = 0; axis < 2; ++axis) {
            const double h = 1e-7, force = body.f.at(node, 0)[axis];
            if (std::abs(force) < 1e-4 * largest || largest < 1e-6) continue;
            const auto at = [&](double by) {
              body.q.add(node, 0, axis == 0 ? Vec2(by, 0) : Vec2(0, by));
              const double value = contact.energy(bodies)[0];
              body.q.add(node, 0, axis == 0 ? Vec2(-by, 0) : Vec2(0, -by));
              return value;
            };
            // Deep overlaps cross segments within 2h here and there, where the unsigned distance has its crease: skip
            // the crease itself.
            const double left = (at(0) - at(-h)) / h, right = (at(h) - at(0)) / h;
            if (std::abs(left - right) > 0.01 * largest) continue;
            CHECK(force == Catch::Detail::Approx(-(left + right) / 2).epsilon(1e-5).margin(1e-5 * largest));
          }
    }
  }
}

TEST_CASE("candidates are exactly the pairs within the distance") {
  const auto disk_lattice = build_solid(*disk(200, 1e4, 0.03, 1));
  const auto wall_lattice = build_solid(*wall(400, 100, 0.03, 1));
  Points nodes;
  for (const Vec2& p : surface_points(*disk_lattice)) nodes.push_back(p + Vec2(0.3, 0.95));
  const Points rim = surface_points(*wall_lattice);
  std::size_t expected = 0, k = 0;
  const auto pairs = candidates_within(nodes, PlacedSurface(wall_lattice->surface, rim), 0.15);
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i)
    for (int s = 0; s < static_cast<int>(rim.size()); ++s)
      if (closest(nodes[i], rim[s], rim[(s + 1) % rim.size()]).distance <= 0.15) {
        ++expected;
        REQUIRE(k < pairs.size());
        CHECK((pairs[k].node == i && pairs[k].cell == s));
        ++k;
      }
  CHECK(pairs.size() == expected);
  CHECK(expected > 20);
}

TEST_CASE("the distance of two outlines is 0 as soon as they share area, even if no corner lies inside") {
  const Points bar{{-2, -0.1}, {2, -0.1}, {2, 0.1}, {-2, 0.1}}, post{{-0.1, -2}, {0.1, -2}, {0.1, 2}, {-0.1, 2}};
  CHECK(outline_distance(bar, post) == 0);
  Points moved = post;
  for (Vec2& p : moved) p.x() += 2.6;
  CHECK(outline_distance(bar, moved) == Catch::Detail::Approx(0.5));
  CHECK(outline_distance(moved, bar) == Catch::Detail::Approx(0.5));
  const Points inside{{-0.05, -0.05}, {0.05, -0.05}, {0, 0.05}};
  CHECK(outline_distance(bar, inside) == 0);
  CHECK(outline_distance(inside, bar) == 0);
}

TEST_CASE("a tree of a chain finds what a look at every segment finds") {
  Random random(7, 0);
  const auto star = [&](int corners) {  // any angle, any distance from the centre: simple, mostly concave
    Points chain;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners, r = random.uniform(0.3, 1);
      chain.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return chain;
  };
  const auto nearest = [](const Points& chain, const Vec2& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < chain.size(); ++s)
      least = std::min(least, closest(p, chain[s], chain[(s + 1) % chain.size()]).distance);
    return least;
  };
  const auto winds_around = [](const Points& chain,
                               const Vec2& p) {  // by the angle that the chain sweeps as seen from p
    double angle = 0;
    for (std::size_t s = 0; s < chain.size(); ++s) {
      const Vec2 a = chain[s] - p, b = chain[(s + 1) % chain.size()] - p;
      angle += std::atan2(cross(a, b), a.dot(b));
    }
    return std::abs(angle) > M_PI;
  };
  int inside = 0, apart = 0;
  for (const int corners : {3, 4, 7, 30, 201}) {
    const Points chain = star(corners);
    REQUIRE(is_simple(chain));
    Points crossed = chain;
    for (Vec2& p : crossed) p.normalize();
    CHECK(is_simple(crossed));
    std::swap(crossed[0], crossed[1]);
    CHECK(is_simple(crossed) == (corners == 3));
    const Surface surface = surface_of(chain);
    const PlacedSurface tree(surface, chain);
    for (int i = 0; i < 200; ++i) {
      const Vec2 p(random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1));
      CHECK(tree.distance(p, 0.2) == std::min(0.2, nearest(chain, p)));
      CHECK(tree.distance(p, std::numeric_limits<double>::infinity()) == nearest(chain, p));
      CHECK(tree.contains(p) == winds_around(chain, p));
      inside += tree.contains(p);
    }
    for (int i = 0; i < 40; ++i) {
      Points other = star(20);
      const Vec2 by(random.uniform(0.5, 2.5), random.uniform(-1, 1));
      for (Vec2& p : other) p += by;
      double least = std::numeric_limits<double>::infinity();
      for (const Vec2& p : chain) least = std::min(least, nearest(other, p));
      for (const Vec2& p : other) least = std::min(least, nearest(chain, p));
      const double distance = outline_distance(chain, other);
      if (distance > 0) {
        CHECK(distance == least);
        ++apart;
      }
      // A point of one inside the other is an overlap; crossing edges without one are rare here.
      for (const Vec2& p : other)
        if (winds_around(chain, p)) CHECK(distance == 0);
      for (const Vec2& p : chain)
        if (winds_around(other, p)) CHECK(distance == 0);
    }
  }
  CAPTURE(inside, apart);
  CHECK((inside > 200 && apart > 20));
}

TEST_CASE("a list with a skin never loses a pair while the bodies move") {
  const auto disk_lattice = build_solid(*disk(60, 1e4, 0.03, 1));
  const auto wall_lattice = build_solid(*wall(150, 100, 0.03, 1));
  ExponentialRepulsion law = paper_contact();
  const std::vector<const Solid*> solids{disk_lattice.get(), wall_lattice.get()};
  Motions<1> bodies{at_rest<1>(*disk_lattice, 1e4), at_rest<1>(*wall_lattice, 100)};
  for (int i = 0; i < disk_lattice->nodes(); ++i) bodies[0].q.add(i, 0, {-1, 1.3});
  Contacts<1> kept(solids, {});
  kept.set(0, &law);
  double most = 0;
  for (int step = 0; step < 400; ++step) {
    for (int i = 0; i < disk_lattice->nodes(); ++i) bodies[0].q.add(i, 0, {0.005, step < 200 ? -0.0015 : 0.001});
    Contacts<1> fresh(solids, {});
    fresh.set(0, &law);
    const double energy = kept.energy(bodies)[0];
    REQUIRE(energy == fresh.energy(bodies)[0]);
    most = std::max(most, energy);
  }
  CHECK(most > 1e-3);
}

TEST_CASE("sliding never gives energy back, and closes the ledger wherever it does not turn within a step") {
  Random random(4, 1);
  int turned = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const Friction friction{random.uniform(), 1};
    const double k = 0.1 + random.uniform(), stretch = random.normal(), by = 3 * random.normal();
    const double load = 5 * random.uniform();
    const Friction::Slid slid = friction.slide(stretch, by, load, k);
    const double scale = k * (stretch * stretch + by * by);
    CHECK(slid.lost >= 0);
    CHECK(k * std::fabs(slid.stretch) <= friction.mu * load * (1 + 1e-15));
    const double work = 0.5 * k * (stretch + slid.stretch) * by;
    const double stored = 0.5 * k * (slid.stretch * slid.stretch - stretch * stretch);
    const bool turns = (stretch + slid.stretch) * (stretch + by - slid.stretch) < 0;
    turned += turns;
    if (!turns) CHECK(slid.lost == Approx(work - stored).margin(1e-14 * scale));
  }
  CHECK(turned > 100);
}
