// Properties over the catalogue of effects: every kind is tested by what it says it is.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "body/elasticity.hpp"
#include "body/rigid_motion.hpp"
#include "body/springs/sweep.hpp"
#include "body/springs/tangent.hpp"
#include "body/vibration.hpp"
#include "contact/contacts.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "effect/acting.hpp"
#include "impact/batch.hpp"
#include "impact/launch/launch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

Lane<1> one(double value) { return Lane<1>::Constant(value); }

// Kept out of line: GCC 12 warns of a string in effects that have none, in a branch that they never take.
template <class E>
[[gnu::noinline]] void set_text(E& effect, std::string E::*place, const std::string& text) {
  effect.*place = text;
}

/// Every number different and not zero, so that no field can be left out unseen; on both bodies, where there is a
/// choice.
template <class E>
E set_up() {
  E effect;
  double value = 0.37;
  for (const auto& member : E::fields())
    std::visit(
        [&](auto place) {
          using Value = std::remove_reference_t<decltype(effect.*place)>;
          if constexpr (std::is_same_v<Value, double>) {
            effect.*place = value;
            value += 0.41;
          } else if constexpr (std::is_same_v<Value, std::string>)
            set_text(effect, place, member.field.choices.back());
        },
        member.place);
  return effect;
}

const std::vector<Turn> unturned(2);
const auto unbroken = [](int) { return 1.0; };

Motion<1> at_rest(const Solid& lattice, double stiffness) {
  Motion<1> body = ricochet::at_rest<1>(lattice);
  body.stiffness = one(stiffness);
  return body;
}

Motion<1> shaken(const Solid& lattice, double stiffness, std::uint64_t seed) {
  Motion<1> body = at_rest(lattice, stiffness);
  Random random(seed, 5);
  for (int i = 0; i < lattice.nodes(); ++i) {
    const Vec2 u(random.normal(), random.normal()), v(random.normal(), random.normal());
    body.q.set(i, 0, i < lattice.free ? Vec2(lattice.points[i] + 0.01 * u) : lattice.points[i]);
    if (i < lattice.free) body.v.set(i, 0, 0.1 * v);
  }
  return body;
}

double kinetic(const Motion<1>& body) {
  double sum = 0;
  for (int i = 0; i < body.solid->free; ++i) sum += body.solid->mass.each() * body.v.at(i, 0).squaredNorm() / 2;
  return sum;
}

Vec2 momentum(const Motion<1>& body) {
  Vec2 sum = Vec2::Zero();
  for (int i = 0; i < body.solid->nodes(); ++i) sum += body.solid->mass.each() * body.v.at(i, 0);
  return sum;
}

double angular_momentum(const Motion<1>& body) {
  double sum = 0;
  for (int i = 0; i < body.solid->nodes(); ++i)
    sum += body.solid->mass.each() * cross(body.q.at(i, 0), body.v.at(i, 0));
  return sum;
}

Scene scene_with(std::vector<Effect> effects, double psi1 = 1) {
  Scene scene = paper_scene();
  scene.projectile = disk(60, 1e4, 0.02, 3);
  scene.target = wall(200, 400, 0.02, 3, 5, 1.5);
  scene.launch.psi1 = psi1;
  scene.effects = std::move(effects);
  return scene;
}

}  // namespace

TEST_CASE("effects and their fields are documented, named once, and all in the text of a scene") {
  std::set<std::string> names;
  each_effect_kind([&]<class E>(const E&) {
    INFO(E::name);
    CHECK(names.insert(E::name).second);
    CHECK(std::string(E::doc).size() > 20);
    CHECK(std::string(E::example).starts_with(fmt::format("ricochet.{} {{", E::name)));
    CHECK((E::energy_doc ? std::string(E::energy_doc).size() > 8 : AtStart<E>));
    // Every kind says of itself what it is, once.
    CHECK(NodeForce<E> + NodeDamping<E> + SpringDamping<E> + SpringChange<E> + AnchorMotion<E> + PairForceEffect<E> +
              PairMemory<E> + AtStart<E> + ElementFlow<E> + EdgeDamping<E> ==
          1);
    std::set<std::string> fields;
    const Effect changed = set_up<E>(), initial = E{};
    const std::string text = text_of(std::span(&changed, 1)), plain = text_of(std::span(&initial, 1));
    for (const auto& member : E::fields()) {
      CHECK(fields.insert(member.field.name).second);
      CHECK(member.field.doc.size() > 8);
      CHECK_THAT(text, Catch::Matchers::Contains(" " + member.field.name + " = "));
    }
    CHECK(text != plain);
  });
}

namespace {

// Energy that effects without contact book.
double booked_of(const ActingEffects<1>& acting, const Motions<1>& bodies, std::size_t kind) {
  const Contacts<1> none({bodies[0].solid}, {});
  Lane<1> held = one(0);
  return acting.energies(bodies, none, held)[kind][0];
}

}  // namespace

TEST_CASE("forces of conservative effects are minus the gradient of their energies") {
  const auto lattice = build_solid(*wall(60, 30, 0.02, 1));
  each_effect_kind([&]<class E>(const E&) {
    if constexpr (NodeForce<E>) {
      const E effect = set_up<E>();
      {
        Motion<1> moving = shaken(*lattice, 30, 2);
        effect.add_forces(moving);
        for (int i = 0; i < lattice->free; ++i)
          for (int axis : {0, 1}) {
            const auto energy = [&](double shift) {
              Motion<1> moved = moving;
              moved.q.add(i, 0, axis == 0 ? Vec2(shift, 0) : Vec2(0, shift));
              return effect.energy(moved)[0];
            };
            const double h = 1e-4;
            CHECK(moving.f.at(i, 0)[axis] ==
                  Catch::Detail::Approx(-(energy(h) - energy(-h)) / (2 * h)).epsilon(1e-8).margin(1e-9));
          }
      }
    }
  });
}

TEST_CASE("what depends on velocities takes energy, exactly as much as it books, for steps of any length") {
  const auto free_lattice = build_solid(*disk(60, 30, 0.02, 1)), held_lattice = build_solid(*wall(80, 30, 0.02, 1));
  each_effect_kind([&]<class E>(const E&) {
    if constexpr (NodeDamping<E> || SpringDamping<E>) {
      for (const double h : {1e-3, 0.1, 10.0}) {
        INFO(E::name << " " << h);
        Motions<1> bodies{shaken(*free_lattice, 30, 7), shaken(*held_lattice, 30, 8)};
        ActingEffects<1> acting({set_up<E>()}, {free_lattice.get(), held_lattice.get()});
        acting.begin(0, h, {}, bodies, unturned);
        const double before = kinetic(bodies[0]) + kinetic(bodies[1]);
        acting.dissipate(bodies, one(h / 2), true);
        const double middle = kinetic(bodies[0]) + kinetic(bodies[1]);
        acting.dissipate(bodies, one(h / 2), false);
        const double after = kinetic(bodies[0]) + kinetic(bodies[1]),
                     booked = booked_of(acting, bodies, Effect(E{}).index());
        CHECK(middle < before);
        CHECK(after < middle);
        CHECK(booked == Catch::Detail::Approx(before - after).epsilon(1e-12).margin(1e-14 * before));
      }
    }
  });
}

TEST_CASE("damping conserves momentum and angular momentum, and leaves a body that moves rigidly alone") {
  const auto lattice = build_solid(*disk(60, 30, 0.02, 1));
  const Damping damping{0.3, "both"};
  Motion<1> moving = shaken(*lattice, 30, 4);
  const Vec2 p = momentum(moving);
  const double L = angular_momentum(moving);
  damping.damp(moving, *moving.solid->springs(), one(0.2), true, unbroken);
  damping.damp(moving, *moving.solid->springs(), one(0.2), false, unbroken);
  CHECK((momentum(moving) - p).norm() < 1e-13);
  CHECK(std::abs(angular_momentum(moving) - L) < 1e-13);
  for (int i = 0; i < lattice->nodes(); ++i) {
    moving.q.set(i, 0, lattice->points[i]);
    moving.v.set(i, 0, Vec2(0.3, -0.2) + 0.7 * perpendicular(lattice->points[i]));
  }
  CHECK(damping.damp(moving, *moving.solid->springs(), one(0.2), true, unbroken)[0] < 1e-25);
}

TEST_CASE("damping of two nodes is their exact decay, for steps of any length") {
  Solid pair;
  pair.points = {Vec2(0, 0), Vec2(1, 0)};
  pair.free = 2;
  pair.mass = Masses(2);
  Springs springs;
  springs.first = {0, 1, 1};
  springs.list.push_back({0, 1, false, 1.0, 1.5});
  pair.interior = springs;
  const Damping damping{0.25, "both"};
  const auto error = [&](int steps) {
    Motion<1> moving = at_rest(pair, 4);
    moving.v.set(1, 0, {1, 0});
    for (int i = 0; i < steps; ++i)
      damping.damp(moving, *moving.solid->springs(), one(1.0 / steps), i % 2 == 0, unbroken);
    // du/dt = -(1/m + 1/m) time k u with k = 4 * 1.5, m = 2: u = exp(-1.5).
    return std::abs(moving.v.at(1, 0).x() - moving.v.at(0, 0).x() - std::exp(-1.5));
  };
  for (const int steps : {1, 7, 40}) CHECK(error(steps) < 1e-14);
}

TEST_CASE("drag is exact for any step: velocities fall as exp(-rate t)") {
  const auto lattice = build_solid(*disk(40, 30, 0, 1));
  Motions<1> bodies{shaken(*lattice, 30, 7), shaken(*lattice, 30, 8)};
  const Vec2 v = bodies[0].v.at(5, 0);
  ActingEffects<1> acting({Drag{0.8, "projectile"}}, {lattice.get(), lattice.get()});
  acting.begin(0, 0.5, {}, bodies, unturned);
  for (int i = 0; i < 6; ++i) acting.dissipate(bodies, one(0.25), i % 2 == 0);
  CHECK((bodies[0].v.at(5, 0) - v * std::exp(-0.8 * 6 * 0.25)).norm() < 1e-15);
}

TEST_CASE(
    "springs that remember pull by the slope of their energy, lose energy and never gain it, and hold none that their "
    "law would not") {
  const std::vector<double> stretches{0.001, 0.3, 1.1, 0.4, -0.9, -1.6, 0.2, 2.5, -2.4};
  each_effect_kind([&]<class E>(const E&) {
    if constexpr (SpringChange<E>) {
      INFO(E::name);
      const E effect = set_up<E>();
      const Quartic law{0.3};
      const Spring spring{0, 1, false, 1.7, 1.0};
      SpringMemory<1> memory{one(0), one(0)};
      double lost = 0, before = 0, work = 0;
      for (std::size_t k = 0; k < stretches.size(); ++k) {
        // Slowly from one stretch to the next: the work done on the spring is what it holds and what it has lost.
        constexpr int steps = 20000;
        for (int i = 1; i <= steps; ++i) {
          const double x = before + (stretches[k] - before) * i / steps, width = (stretches[k] - before) / steps;
          const double pulled = tension_of(effect, law, one(x - width), memory)[0];
          const double step_lost = effect.change(law, spring, one(x), memory)[0];
          CHECK_FALSE(step_lost < 0);
          lost += step_lost;
          work += (pulled + tension_of(effect, law, one(x), memory)[0]) / 2 * width;
        }
        before = stretches[k];
        const double held = energy_of(effect, law, one(before), memory)[0], h = 1e-5;
        CHECK(tension_of(effect, law, one(before), memory)[0] ==
              Catch::Detail::Approx((energy_of(effect, law, one(before + h), memory)[0] -
                                     energy_of(effect, law, one(before - h), memory)[0]) /
                                    (2 * h))
                  .epsilon(1e-7)
                  .margin(1e-9));
        CHECK(work == Catch::Detail::Approx(held + lost).epsilon(1e-3));
      }
      CHECK(lost > 0);
      CHECK(effect.counted(memory)[0]);
    }
  });
}

TEST_CASE("a plastic spring yields at its limit, hardens, and yields the other way as far below its new rest length") {
  const Plastic plastic{0.1, 0.5, "both"};
  const Spring spring{0, 1, false, 2.0, 1.0};
  SpringMemory<1> memory{one(0), one(0)};
  const auto tension_at = [&](double x) {
    plastic.change(Linear{}, spring, one(x), memory);
    return tension_of(plastic, Linear{}, one(x), memory)[0];
  };
  CHECK(tension_at(0.19) == Catch::Detail::Approx(0.19));
  // Past 0.2 the tension grows with slope H / (1 + H) = 1/3.
  CHECK(tension_at(0.5) == Catch::Detail::Approx(0.2 + 0.3 / 3));
  CHECK(memory[0][0] == Catch::Detail::Approx(0.2));
  CHECK(tension_at(0.2) == Catch::Detail::Approx(0).margin(1e-15));
  CHECK(tension_at(-0.09) == Catch::Detail::Approx(-0.29));
  CHECK(tension_at(-0.4) == Catch::Detail::Approx(-(0.3 + 0.3 / 3)));
}

TEST_CASE("a spring breaks beyond its strain, for good, unless it is of the rim") {
  const Breaking breaking{0.1, "both"};
  SpringMemory<1> memory{one(0), one(0)}, rim = memory;
  const Spring inner{0, 1, false, 2.0, 1.0}, outer{0, 1, true, 2.0, 1.0};
  breaking.change(Linear{}, inner, one(0.199), memory);
  CHECK(tension_of(breaking, Linear{}, one(0.199), memory)[0] == 0.199);
  CHECK(breaking.change(Linear{}, inner, one(0.21), memory)[0] == Catch::Detail::Approx(0.21 * 0.21 / 2));
  CHECK(breaking.change(Linear{}, inner, one(0.3), memory)[0] == 0);
  CHECK(tension_of(breaking, Linear{}, one(0.01), memory)[0] == 0);
  breaking.change(Linear{}, outer, one(0.3), rim);
  CHECK(tension_of(breaking, Linear{}, one(0.3), rim)[0] == 0.3);
}

TEST_CASE("forces between rims of a pair are minus the slope of its energy") {
  each_effect_kind([&]<class E>(const E&) {
    if constexpr (PairForceEffect<E>) {
      const E effect = set_up<E>();
      for (const double d : {0.0, 0.01, 0.3, 2.0})
        CHECK(effect.force(d) ==
              Catch::Detail::Approx(-(effect.energy(d + 1e-5) - effect.energy(d - 1e-5)) / 2e-5).epsilon(1e-6));
    }
  });
}

TEST_CASE("what acts between rims has a reaction: no momentum or angular momentum comes of it") {
  const auto a = build_solid(*disk(60, 1e3, 0.02, 1)), b = build_solid(*disk(90, 1e3, 0.02, 2));
  each_effect_kind([&]<class E>(const E&) {
    if constexpr (PairForceEffect<E> || PairMemory<E>) {
      INFO(E::name);
      const E effect = set_up<E>();
      for (const char* sides : {"one", "two"}) {
        const std::vector<const Solid*> solids{a.get(), b.get()};
        Contacts<1> contact(solids, contact_laws(std::vector<Effect>{effect})), bare(solids, {});
        const ExponentialRepulsion law{150, 60, 0.5, sides};
        contact.set(0, &law);
        bare.set(0, &law);
        Motions<1> bodies{shaken(*a, 1e3, 5), shaken(*b, 1e3, 6)}, plain;
        for (int i = 0; i < a->nodes(); ++i) bodies[0].q.add(i, 0, Vec2(0.1, 2.02));
        std::vector<Lane<1>> energy(1);
        for (int k = 0; k < 3; ++k) {
          for (Motion<1>& body : bodies) {
            body.f.resize(body.solid->coordinates());
            for (int i = 0; i < body.solid->nodes(); ++i) body.q.add(i, 0, 0.02 * body.v.at(i, 0));
          }
          plain = bodies;
          contact.push(bodies, energy);
          bare.push(plain, energy);
        }
        Vec2 sum = Vec2::Zero();
        double moment = 0, size = 0, whole = 0;
        for (std::size_t side : {0, 1})
          for (int i = 0; i < bodies[side].solid->nodes(); ++i) {
            const Motion<1>* body = &bodies[side];
            const Vec2 f = body->f.at(i, 0) - plain[side].f.at(i, 0);
            sum += f;
            moment += cross(body->q.at(i, 0), f);
            size += f.norm();
            whole += body->f.at(i, 0).norm();
          }
        CHECK(size > 1e-3);
        CHECK(sum.norm() < 1e-14 * whole);  // the rounding of a difference
        CHECK(std::abs(moment) < 1e-13 * whole);
      }
    }
  });
}

TEST_CASE("friction holds up to mu times the load, then slides, and loses the work of sliding") {
  const Friction friction{0.5, 1};
  const auto held = friction.slide(0, 0.01, 4, 100);  // limit 0.02
  CHECK(held.stretch == 0.01);
  CHECK(held.lost == 0);
  const auto slid = friction.slide(0.02, 0.03, 4, 100);
  CHECK(slid.stretch == Catch::Detail::Approx(0.02));
  CHECK(slid.lost == Catch::Detail::Approx(0.5 * 4 * 0.03));  // mu N times the way
  CHECK(friction.slide(-0.02, -0.03, 4, 100).lost == Catch::Detail::Approx(0.5 * 4 * 0.03));
  CHECK(friction.slide(0.02, 0.0, 1, 100).stretch == Catch::Detail::Approx(0.005));  // a falling load lets go
}

TEST_CASE("friction stays within its cone and leaves two bodies that turn together as one alone") {
  const auto a = build_solid(*disk(60, 1e3, 0.02, 1)), b = build_solid(*disk(90, 1e3, 0.02, 2));
  const Friction friction{0.4, 0.05};
  const std::vector<const Solid*> solids{a.get(), b.get()};
  Contacts<1> contact(solids, contact_laws(std::vector<Effect>{friction})), bare(solids, {});
  const ExponentialRepulsion law{150, 60, 0.5, "one"};
  contact.set(0, &law);
  bare.set(0, &law);
  Motions<1> bodies{shaken(*a, 1e3, 5), shaken(*b, 1e3, 6)};
  for (int i = 0; i < a->nodes(); ++i) bodies[0].q.add(i, 0, Vec2(0.1, 2.02));
  const auto forces = [&](auto&& moved) {
    for (Motion<1>& body : bodies)
      for (int i = 0; i < body.solid->nodes(); ++i) {
        body.q.set(i, 0, moved(&body, i));
        body.f.set(i, 0, Vec2::Zero());
      }
    Motions<1> plain = bodies;
    std::vector<Lane<1>> energy(1);
    contact.push(bodies, energy);
    bare.push(plain, energy);
    const Motion<1>&p = bodies[0], &plain_p = plain[0];
    double most = 0;
    for (int i = 0; i < a->nodes(); ++i)
      most = std::max(most, (p.f.at(i, 0) - plain_p.f.at(i, 0)).norm() - 0.4 * plain_p.f.at(i, 0).norm());
    double size = 0;
    for (int i = 0; i < a->nodes(); ++i) size += (p.f.at(i, 0) - plain_p.f.at(i, 0)).norm();
    return std::pair(most, size);
  };
  forces([](Motion<1>* body, int i) { return body->q.at(i, 0); });
  const double turn = 1e-4;
  const auto together = forces([&](Motion<1>* body, int i) {
    return Vec2(body->q.at(i, 0) + turn * perpendicular(body->q.at(i, 0)) + Vec2(0.3, -0.2));
  });
  CHECK(together.second < 1e-5);  // second order in the turn
  const auto apart = forces([&](Motion<1>* body, int i) {
    return Vec2(body->q.at(i, 0) + (body == &bodies[0] ? Vec2(0.3, 0) : Vec2(0, 0)));
  });
  CHECK(apart.second > 0.1);
  CHECK(apart.first < 1e-12);
}

TEST_CASE("a warm lattice has the energy of its modes, no rigid motion, and stays warm") {
  for (const auto& body : {disk(60, 30, 0.02, 1), wall(80, 30, 0.02, 1)}) {
    const auto lattice = build_solid(*body);
    const Vibrations vibrations(*lattice);
    const double temperature = 1e-7;
    const int coordinates = 2 * lattice->free - (lattice->anchored() ? 0 : 3);
    double potential = 0, motion = 0, later = 0;
    const int samples = 400;
    for (int seed = 1; seed <= samples; ++seed) {
      Motion<1> moving = shaken(*lattice, 30, 1);
      const auto sample = vibrations.draw(temperature, 30, seed, 0);
      for (int i = 0; i < lattice->nodes(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        moving.q.set(i, 0, lattice->points[k] + (i < lattice->free ? sample.displacement[k] : Vec2(Vec2::Zero())));
        moving.v.set(i, 0, i < lattice->free ? sample.velocity[k] : Vec2(Vec2::Zero()));
      }
      potential += interior_energy(moving)[0] / samples;
      motion += kinetic(moving) / samples;
      if (!lattice->anchored()) {
        CHECK(momentum(moving).norm() < 1e-15);
        CHECK(std::abs(angular_momentum(moving)) < 1e-15);
      }
      if (seed > 40) continue;
      const double h = 0.3 * std::sqrt(lattice->mass.each() / 30);
      for (int k = 0; k < 40; ++k) {
        kick_and_drift(moving, one(h), one(h));
        if (k >= 20) later += kinetic(moving) / 40 / 20;
      }
    }
    // Half of the temperature a coordinate, with a standard error of sqrt(2 / coordinates / samples).
    const double expected = coordinates * temperature / 2, error = std::sqrt(2.0 / coordinates / samples);
    CHECK(potential / expected == Catch::Detail::Approx(1).margin(4 * error));
    CHECK(motion / expected == Catch::Detail::Approx(1).margin(4 * error));
    CHECK(later / expected == Catch::Detail::Approx(1).margin(12 * error));
  }
}

TEST_CASE("prestress scatters the springs' lengths, leaves every node balanced, and adds no energy at rest") {
  auto stressed = *disk(120, 30, 0.02, 1);
  stressed.numbers.prestress = 0.05;
  const auto lattice = build_solid(stressed), plain = build_solid(*disk(120, 30, 0.02, 1));
  CHECK(spring_forces(*lattice, *lattice->springs()).lpNorm<Eigen::Infinity>() < 1e-13);
  CHECK(lattice->springs()->rest_energy > 1e-4);
  CHECK(std::abs(interior_energy(at_rest(*lattice, 30))[0]) < 1e-14);
  double square = 0;
  for (std::size_t s = 0; s < plain->springs()->list.size(); ++s)
    square += std::pow(lattice->springs()->list[s].length / plain->springs()->list[s].length - 1, 2) /
              static_cast<double>(plain->springs()->list.size());
  CHECK(std::sqrt(square) == Catch::Detail::Approx(0.05).epsilon(0.15));
  // The matrix of small motions is the slope of the forces, prestress included.
  Solid moved = *lattice;
  const double h = 1e-6;
  moved.points[7].x() += h;
  const Eigen::VectorXd up = spring_forces(moved, *moved.springs());
  moved.points[7].x() -= 2 * h;
  const Eigen::VectorXd slope = (spring_forces(moved, *moved.springs()) - up) / (2 * h),
                        column = tangent_stiffness(*lattice, *lattice->springs()).col(14);
  CHECK((slope - column).lpNorm<Eigen::Infinity>() < 1e-8);
}

TEST_CASE("anchors that move slowly do the work that lifts what they hold") {
  Scene scene = scene_with({MovingAnchor{0.02, 0.3, 40, "normal"}}, 0);
  scene.launch.speed = 0.01;  // the disk is far enough away to leave the wall alone for a while
  scene.contact.reach = 0.3;
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  const Snapshot start = run_until({p.get(), t.get()}, scene, 0), later = run_until({p.get(), t.get()}, scene, 3);
  CHECK(std::abs(later.energy.effects) > 1e-3);
  CHECK(later.energy.total() == Catch::Detail::Approx(start.energy.total()).epsilon(1e-4));
  const MovingAnchor& shaken = std::get<MovingAnchor>(scene.effects[0]);
  CHECK((later.bodies[1].place[static_cast<std::size_t>(t->nodes() - 1)] - t->points.back() -
         shaken.displacement(later.time))
            .norm() < 1e-12);
}

TEST_CASE(
    "the ledger closes with every effect and with all that stand together, ever better with a shorter step, and each "
    "takes its part") {
  const std::vector<Effect> all{Gravity{0.004, "both"},   Drag{0.006, "both"},
                                Absorbing{0.8, 0.5},      MovingAnchor{0.02, 0.4, 30, "tangential"},
                                Damping{4e-3, "both"},    Plastic{2e-4, 0.2, "projectile"},
                                Breaking{0.01, "target"}, Adhesion{0.5, 200},
                                Friction{0.3, 1},         Thermal{1e-6, 1, "both"}};
  // Yielding and absorbing edges, of elements, do so by themselves (impact/test_yielding.cpp,
  // test_absorbing_edges.cpp).
  REQUIRE(all.size() + 2 == effect_kinds);
  std::vector<std::vector<Effect>> sets{all, all};  // absorbing and moving anchors do not stand together
  std::erase_if(sets[0], [](const Effect& e) { return std::holds_alternative<Absorbing>(e); });
  std::erase_if(sets[1], [](const Effect& e) { return std::holds_alternative<MovingAnchor>(e); });
  for (const Effect& effect : all) sets.push_back({effect});
  for (const auto& effects : sets) {
    Scene scene = scene_with(effects);
    scene.contact.reach = 0.2;  // what adhesion is cut at is then exp(-40)
    if (effects.size() == 1 && std::holds_alternative<Thermal>(effects[0])) scene.integration.method = "verlet";
    INFO(text_of(effects));
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    const Outcome usual = run_scene({p.get(), t.get()}, scene, go_on);
    INFO(usual.reason);
    REQUIRE(usual.status == Status::finished);
    CHECK(usual.energy_closure < 3e-4);
    scene.integration.step = usual.step / 8;
    const Outcome fine = run_scene({p.get(), t.get()}, scene, go_on);
    INFO(usual.energy_drift << " " << fine.energy_drift);
    CHECK(fine.energy_drift < std::max(usual.energy_drift / 10, 1e-8));
    // Out of each other's reach no attraction is left.
    for (std::size_t kind = 0; kind < effect_kinds; ++kind) {
      const bool named =
          std::any_of(effects.begin(), effects.end(), [&](const Effect& e) { return e.index() == kind; });
      CHECK(std::isfinite(usual.effect_energy[kind]) == named);
      if (named)
        CHECK((std::abs(usual.effect_energy[kind]) > 1e-6) ==
              (kind != Effect(Thermal{}).index() && kind != Effect(Adhesion{}).index()));
    }
  }
}

TEST_CASE("a real impact with effects that depend on velocities converges at order 2, beside friction at order 1") {
  const Effect gravity = Gravity{0.01, "projectile"};
  for (const Effect& effect :
       {Effect(Drag{0.05, "both"}), Effect(Damping{2e-3, "both"}), Effect(Absorbing{0.7, 2.0}),
        Effect(MovingAnchor{0.03, 0.4, 30, "normal"}), Effect(Plastic{5e-3, 0.3, "both"}), Effect(Friction{0.3, 1})}) {
    Scene scene = scene_with({effect, gravity});
    INFO(text_of(scene.effects));
    scene.projectile = disk(60, 1e4, 0, 3);
    scene.target = wall(200, 400, 0, 3, 5, 1.5);
    scene.launch.psi1 = 0;
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    const auto at = [&](double step) {
      scene.integration.step = step;
      return run_until({p.get(), t.get()}, scene, 4.8);
    };
    const auto distance = [](const Snapshot& a, const Snapshot& b) {
      double sum = 0;
      for (std::size_t body : {1, 0}) {
        const Points &of_a = a.bodies[body].place, &of_b = b.bodies[body].place;
        for (std::size_t i = 0; i < of_a.size(); ++i) sum += (of_a[i] - of_b[i]).squaredNorm();
      }
      return std::sqrt(sum);
    };
    // Springs that yield and contacts that slip do so at moments that fall anywhere within a step: from one step to its
    // half the order scatters, over three halvings it shows.
    const Snapshot coarse = at(0.004), middle = at(0.002), finest = at(0.0005), reference = at(0.00025);
    const double order = std::log2(distance(coarse, middle) / distance(finest, reference)) / 3;
    if (order_beside(effect) == 2)
      CHECK(order == Catch::Detail::Approx(2).margin(std::holds_alternative<Plastic>(effect) ? 0.3 : 0.1));
    else
      CHECK(order > 0.9);  // friction
  }
}

TEST_CASE("a conservative effect keeps the order of its method, which effects that are split would lower: refused") {
  Scene scene = scene_with({Gravity{0.01, "both"}});
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  scene.integration.method = "blanes_moan_srkn6b";
  CHECK(run_scene({p.get(), t.get()}, scene, go_on).energy_closure < 1e-7);
  scene.effects.push_back(Drag{0.1, "projectile"});
  CHECK_THROWS_WITH(launch(scene, {p.get(), t.get()}),
                    Catch::Matchers::Contains("blanes_moan_srkn6b of order 4 would fall to order 2 beside drag"));
  scene.integration.method = "multirate_3";
  CHECK_THROWS_WITH(launch(scene, {p.get(), t.get()}), Catch::Matchers::Contains("multirate_3 cannot hold gravity"));
  scene.integration.method = "auto";
  CHECK(scene.method().name == "verlet");
}

TEST_CASE("a disk that rests on nothing falls as Galilei says") {
  Scene scene = scene_with({Gravity{0.01, "projectile"}}, 0);
  scene.launch.speed = 1e-3;
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  const auto height = [&](double time) {
    const Snapshot s = run_until({p.get(), t.get()}, scene, time);
    double sum = 0;
    for (const Vec2& x : s.bodies[0].place) sum += x.y() / static_cast<double>(s.bodies[0].place.size());
    return std::pair(sum, s.time);
  };
  // A rim a reach of 0.1 R away is not felt before half of it is crossed, after 3 R/c.
  const auto [start, zero] = height(0);
  const auto [later, time] = height(2);
  CHECK(later - start ==
        Catch::Detail::Approx(-1e-3 * (time - zero) - 0.005 * (time * time - zero * zero)).epsilon(1e-6));
}

TEST_CASE("e beside gravity and drag is that of the moment of parting, whenever one looks") {
  // The engine looks for the end after whole steps, at other times for every step; the outcomes must not follow it.
  for (const Effect& effect : {Effect(Gravity{0.02, "projectile"}), Effect(Drag{0.2, "projectile"})}) {
    Scene scene = scene_with({effect});
    const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
    std::vector<double> e, beta;
    for (double theta : {0.03, 0.05, 0.08, 0.12}) {
      scene.integration.method = "verlet";
      scene.integration.theta = theta;
      const Outcome outcome = run_scene({p.get(), t.get()}, scene, go_on);
      REQUIRE(outcome.status == Status::finished);
      e.push_back(outcome.e);
      beta.push_back(outcome.beta);
    }
    for (std::size_t i = 1; i < e.size(); ++i) {
      INFO(text_of(std::vector<Effect>{effect}) << " " << i << " " << e[i] - e[0] << " " << beta[i] - beta[0]);
      // Verlet's own error is of the order of theta^2 / 24.
      CHECK(std::abs(e[i] - e[0]) < 1e-4);
      CHECK(std::abs(beta[i] - beta[0]) < 1e-4);
    }
  }
}

TEST_CASE("the absorbing layer lets waves of a bar come back with the share of amplitude that its doc says") {
  // A thin bar along y, held at its upper end; a pulse much longer than the bar is wide runs up, then back.
  constexpr double length = 24, breadth = 0.3, stiffness = 100, middle = 5, spread = 0.8;
  Body body{
      {{0, 0}, {breadth, 0}, {breadth, length}, {0, length}}, numbers(2400, stiffness, 0, 1, "triangular"), {}, {}};
  const auto unheld = build_solid(body);
  const Elasticity moduli = stretch_band(*unheld, stiffness);
  const double speed = std::sqrt(moduli.young_modulus * length * breadth / unheld->total_mass());
  std::vector<bool> rim;
  for (const Vec2& p : plan_rim(body.outline, body.numbers)) rim.push_back(p.y() > length - 1e-9);
  body.anchored = rim;
  body.anchored.resize(plan_nodes(body.outline, body.numbers, rim).points.size(), false);
  const auto lattice = build_solid(body);
  const auto amplitude = [&](const std::vector<Effect>& effects) {
    Motions<1> bodies{shaken(*lattice, stiffness, 1), shaken(*lattice, stiffness, 1)};
    Motion<1>& bar = bodies[1];
    for (int i = 0; i < lattice->nodes(); ++i) {
      const Vec2 p = lattice->points[i];
      // u_y = f(y - c t), u_x = -nu x u_y': the bar's long wave, which leaves nothing behind.
      const double s = (p.y() - middle) / spread, f = 1e-4 * std::exp(-s * s / 2), slope = -s / spread * f,
                   bend = (s * s - 1) / (spread * spread) * f;
      const double x = moduli.poisson_ratio * (p.x() - breadth / 2);
      bar.q.set(i, 0, i < lattice->free ? Vec2(p + Vec2(-x * slope, f)) : p);
      bar.v.set(i, 0, i < lattice->free ? Vec2(speed * x * bend, -speed * slope) : Vec2(0, 0));
    }
    ActingEffects<1> acting(effects, {lattice.get(), lattice.get()});
    const double h = 0.3 * std::sqrt(lattice->mass.each() / stiffness);
    acting.begin(0, h, {}, bodies, unturned);
    const int steps = static_cast<int>(2 * (length - middle) / speed / h);  // until it is back where it began
    for (int k = 0; k < steps; ++k) {
      acting.dissipate(bodies, one(h / 2), true);
      kick_and_drift(bar, one(h), one(h));
      acting.dissipate(bodies, one(h / 2), false);
    }
    // The share of the pulse's shape in the velocities: what the lattice's disorder scattered on the way does not
    // count.
    double sum = 0;
    for (int i = 0; i < lattice->free; ++i) {
      const double s = (lattice->points[i].y() - middle) / spread;
      sum += bar.v.at(i, 0).y() * s * std::exp(-s * s / 2);
    }
    return std::abs(sum);
  };
  const double whole = amplitude({});
  const double width = 12;
  for (const double share : {0.5, 0.1, 0.02}) {
    const double rate = -3 * speed / width * std::log(share);
    const double back = amplitude({Absorbing{width, rate}}) / whole;
    INFO("rate " << rate << " expected " << share << " came back " << back);
    CHECK(back == Catch::Detail::Approx(share).epsilon(0.1).margin(0.01));
  }
}
