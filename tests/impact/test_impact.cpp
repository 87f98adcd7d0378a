#include <catch2/catch.hpp>
#include <cmath>

#include "body/interior.hpp"
#include "core/error.hpp"
#include "impact/batch.hpp"
#include "impact/launch/aim.hpp"
#include "impact/launch/launch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

Outcome outcome_of(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

/// A free disk hits another free disk off centre.
Scene two_disks() {
  Scene scene = paper_scene();
  scene.projectile = disk(60, 1e4, 0.02, 1);
  scene.target = disk(80, 3e3, 0.02, 2);
  scene.launch.at = 0.5;
  scene.launch.psi1 = 0.4;
  scene.launch.spin = 0.05;
  return scene;
}

}  // namespace

TEST_CASE("an impact finishes, closes its ledger, and its centre of mass gains no energy") {
  for (int seed = 1; seed <= 6; ++seed)
    for (double psi1 : {0.0, 1.0, 4.0, 8.0}) {
      for (const char* sides : {"one", "two"}) {
        Scene scene = small_scene(seed, psi1);
        scene.contact.sides = sides;
        const Outcome o = outcome_of(scene);
        INFO("seed " << seed << " psi1 " << psi1 << " " << o.reason);
        REQUIRE(o.status == Status::finished);
        CHECK(o.certified == (scene.contact.two_sided() ? 1 : 0));
        CHECK(o.energy_closure < 1e-4);  // 60 nodes: one asperity carries the contact; the paper's scene closes to 1e-6
        CHECK(o.after.of(0).translation + o.after.of(0).rotation <= o.before.total() * (1 + 1e-9));
        CHECK(o.psi1 == Catch::Detail::Approx(psi1).margin(1e-15));
        CHECK(std::isnan(o.beta) == (psi1 == 0));
        CHECK(o.touches >= 1);
        CHECK(o.contact_time > 0);
      }
    }
}

TEST_CASE("the outcome's quantities agree with each other") {
  const Outcome o = outcome_of(small_scene(2, 2));
  const double mass = 60, v = 0.1, vn = v / std::sqrt(5.0), vt = 2 * vn;
  CHECK(o.e == Catch::Detail::Approx(o.vn / vn).epsilon(1e-12));
  CHECK(o.impulse_n == Catch::Detail::Approx(mass * (o.vn + vn)).epsilon(1e-12));
  CHECK(o.impulse_t == Catch::Detail::Approx(mass * (o.vt - vt)).epsilon(1e-12));
  CHECK(o.mu == Catch::Detail::Approx(std::abs(o.impulse_t) / o.impulse_n).epsilon(1e-12));
  CHECK(o.after.of(0).translation == Catch::Detail::Approx(mass * (o.vn * o.vn + o.vt * o.vt) / 2).epsilon(1e-12));
  CHECK(o.psi2 == Catch::Detail::Approx(-o.beta * o.psi1).epsilon(1e-12));
}

TEST_CASE(
    "momentum and angular momentum of two free disks are exact to rounding, but for the turning of force gradients "
    "without a Hessian") {
  Scene scene = two_disks();
  const auto a = build_solid(*scene.projectile), b = build_solid(*scene.target);
  const auto totals = [&](const Snapshot& s) {
    Vec2 p = Vec2::Zero();
    double L = 0;
    for (std::size_t i = 0; i < s.bodies[0].place.size(); ++i) {
      p += s.bodies[0].velocity[i];
      L += cross(s.bodies[0].place[i], s.bodies[0].velocity[i]);
    }
    for (std::size_t i = 0; i < s.bodies[1].place.size(); ++i) {
      p += s.bodies[1].velocity[i];
      L += cross(s.bodies[1].place[i], s.bodies[1].velocity[i]);
    }
    return std::pair(p, L);
  };
  for (const char* method : {"pefrl", "chin_4a", "takahashi_imada", "multirate_3", "verlet"}) {
    scene.integration.method = method;
    if (scene.integration.method == "verlet")
      scene.effects = {Damping{1e-3, "both"}, Plastic{2e-3, 0.1, "both"}, Adhesion{0.5, 200}, Friction{0.3, 1},
                       Thermal{1e-6, 3, "both"}};
    const Start start = launch(scene, {a.get(), b.get()});
    std::pair<Vec2, double> first, last;
    bool begun = false;
    double contact = 0;
    const Observer observer{0, equally_spaced(0, 0.5, 1000, start.step), [&](const Snapshot& s) {
                              if (!begun) {
                                first = totals(s);
                                begun = true;
                              }
                              last = totals(s);
                              contact = std::max(contact, s.energy.contact);
                            }};
    const Outcome o = run_scene({a.get(), b.get()}, scene, go_on, &observer);
    INFO(o.reason);
    CHECK(o.status == Status::finished);
    CHECK(contact > 1e-3);
    CHECK(o.after.of(1).translation > 0.01);
    // 140 nodes of speed 0.1, some thousand steps of rounding 1e-16 each.
    CHECK((last.first - first.first).norm() < 1e-12 * 6);
    // Forces at places displaced by forces turn a body by the square of the displacement; chin_4a's is small enough.
    const double turned = scene.integration.method == "takahashi_imada" ? 1e-9
                          : method_named(method).multirate()            ? 1e-7
                                                                        : 6e-12;
    CHECK(std::abs(last.second - first.second) < turned);
  }
}

TEST_CASE("a smooth disk on a smooth wall transmits little tangential impulse: beta = -1") {
  Scene scene = paper_scene();
  scene.projectile = disk(300, 1e4, 0, 1);
  scene.target = wall(1000, 100, 0, 1, 6, 2);
  scene.launch.psi1 = 4;
  const Outcome o = outcome_of(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.beta == Catch::Detail::Approx(-1).margin(0.05));
}

TEST_CASE("a faster run of the same scene in other units is the same run") {
  // Lengths as they are, speeds twice, stiffness and V0 four times: the same path in half the time.
  Scene slow = small_scene(3, 1), fast = slow;
  slow.integration.step = 0.004;
  fast.integration.step = 0.002;
  fast.launch.speed = 0.2;
  for (auto* body : {&fast.projectile, &fast.target}) {
    Body scaled = **body;
    scaled.numbers.stiffness *= 4;
    *body = std::make_shared<Body>(scaled);
  }
  fast.contact.V0 *= 4;
  const Outcome a = outcome_of(slow), b = outcome_of(fast);
  CHECK(a.e == Catch::Detail::Approx(b.e).epsilon(1e-9));
  CHECK(a.contact_time == Catch::Detail::Approx(2 * b.contact_time).epsilon(1e-9));
}

TEST_CASE("endings are statuses with a reason") {
  Scene scene = small_scene(1, 1);
  SECTION("a grazing flight that never falls") {
    scene.launch.psi1 = not_given;
    scene.launch.angle = 90;
    const Outcome o = outcome_of(scene);
    CHECK(o.status == Status::no_contact);
    CHECK(o.reason == "the projectile passes by the target");
  }
  SECTION("a disk that flies past a free one") {
    scene.launch.psi1 = 0;
    scene.projectile = disk(60, 1e4, 0, 1);
    scene.target = disk(60, 1e4, 0, 2);
    scene.launch.at = 1.999;
    const Outcome o = outcome_of(scene);
    CHECK((o.status == Status::no_contact || o.status == Status::finished));
  }
  SECTION("a time limit within the contact") {
    scene.integration.time_limit = 2;
    const Outcome o = outcome_of(scene);
    CHECK(o.status == Status::out_of_time);
    CHECK_THAT(o.reason, Catch::Matchers::Contains("raise time_limit"));
  }
  SECTION("a drag that stops it") {
    scene.effects = {Drag{100, "projectile"}};
    scene.integration.method = "verlet";
    scene.integration.time_limit = 20;
    const Outcome o = outcome_of(scene);
    CHECK(o.status == Status::out_of_time);
    CHECK_THAT(o.reason, Catch::Matchers::Contains("they move as one and may never part"));
  }
  SECTION("a tolerance that no step can keep") {
    scene.integration.energy_tolerance = 1e-14;
    CHECK(outcome_of(scene).status == Status::energy_drift);
  }
  SECTION("a projectile too fast for the repulsion") {
    scene.launch.speed = 20;
    scene.launch.psi1 = 0;
    scene.integration.energy_tolerance = 1e6;
    scene.integration.step = 1e-4;
    const Outcome o = outcome_of(scene);
    CHECK(o.certified == 0);
    CHECK(o.status == Status::tunnelled);
  }
  SECTION("a step that is stable at rest and not while the contact is stiff") {
    scene.launch.speed = 1;
    scene.integration.method = "verlet";
    scene.integration.energy_tolerance = 1e6;
    scene.integration.step =
        1.9 / frequency_bound(*build_solid(*scene.projectile), scene.projectile->numbers.stiffness).omega;
    const Outcome o = outcome_of(scene);
    CHECK(o.status == Status::unstable);
    CHECK_THAT(o.reason, Catch::Matchers::Contains("where verlet is unstable with the time step") &&
                             Catch::Matchers::Contains("give a step of"));
    scene.integration.step /= 4;
    CHECK(outcome_of(scene).status != Status::unstable);
  }
  SECTION("a speed that overflows in a given step") {
    scene.launch.speed = 1e200;
    scene.integration.energy_tolerance = 1e300;
    scene.integration.step = 1e-3;
    CHECK_THROWS_WITH(outcome_of(scene), Catch::Matchers::Contains("might pass the contact unseen"));
  }
  SECTION("forces that overflow at once") {
    scene.contact.V0 = 1e308;
    const Outcome o = outcome_of(scene);
    CHECK(o.status == Status::not_finite);
    CHECK_THAT(o.reason, Catch::Matchers::Contains("lower contact.V0"));
  }
}

TEST_CASE("the default step resolves the contact of springs however soft, and of flights however fast") {
  for (const double stiffness : {0.1, 1.0, 10.0, 1e4})
    for (const double speed : {0.01, 0.1, 0.3}) {
      Scene scene = paper_scene();
      scene.projectile = disk(100, stiffness, 0.02, 3);
      scene.target = wall(300, 4e3, 0.02, 3, 6, 2);
      scene.launch.speed = speed;
      scene.launch.psi1 = 0.5;
      scene.integration.time_limit = 3 / speed;  // soft enough a disk wraps around the wall: only its energy is watched
      scene.integration.energy_tolerance = 2e-4;
      const Outcome o = outcome_of(scene);
      INFO(stiffness << " " << speed << " " << o.reason << " drift " << o.energy_drift);
      CHECK((o.status == Status::finished || o.status == Status::out_of_time));
      CHECK(o.theta <= 1.6);
    }
}

TEST_CASE("a spike of the target that slips between two nodes of the projectile is found out") {
  Scene scene = paper_scene();
  scene.projectile = disk(60, 1e4, 0, 1);
  Body spike{Points{{-0.2, -2}, {0.2, -2}, {0, 0}}, numbers(200, 1e4, 0, 1, "uniform"), {}, {}};
  for (const Vec2& q : plan_nodes(spike.outline, spike.numbers, {}).points) spike.anchored.push_back(q.y() < -1.9);
  scene.target = std::make_shared<Body>(spike);
  scene.launch.psi1 = 0;
  scene.launch.at = 0;
  int found = 0;
  for (const double at : {-0.01, 0.0, 0.01}) {
    scene.launch.at = at;
    scene.contact.sides = "one";
    const Outcome one = outcome_of(scene);
    if (one.status == Status::tunnelled) {
      ++found;
      CHECK_THAT(one.reason, Catch::Matchers::Contains("set contact = { sides = \"two\" }"));
    } else {
      CHECK((one.status != Status::finished || one.indentation < 0.5));
    }
    scene.contact.sides = "two";
    CHECK(outcome_of(scene).status != Status::tunnelled);
  }
  CHECK(found >= 1);
}

TEST_CASE("a disk that rolls off a post has parted from it") {
  Scene scene = paper_scene();
  Body post{box(2, 2), numbers(200, 1e4, 0, 1, "triangular"), {}, {}};
  for (const Vec2& q : plan_nodes(post.outline, post.numbers, {}).points) post.anchored.push_back(q.y() < -1.99);
  scene.projectile = disk(100, 1e4, 0, 1);
  scene.target = std::make_shared<Body>(post);
  scene.launch.at = 1.85;
  scene.launch.psi1 = 0;
  CHECK(outcome_of(scene).status == Status::finished);
}

TEST_CASE("a spinning bar has not parted before its ends can no longer come down") {
  Scene scene = paper_scene();
  scene.projectile = std::make_shared<Body>(
      Body{Points{{-1, -.15}, {1, -.15}, {1, .15}, {-1, .15}}, numbers(60, 1e4, 0, 1, "triangular"), {}, {}});
  scene.target = wall(300, 1e3, 0, 1, 8, 2);
  scene.launch.speed = 0.05;
  scene.launch.psi1 = 0;
  scene.launch.at = 0;
  int multiple = 0;
  for (const double spin : {0.1, 0.3, -0.3})
    for (const double height : {0.12, 0.5, 1.2, 2.0}) {
      if (sanitized && height > 0.12) continue;
      scene.launch.spin = spin;
      scene.launch.height = height;
      const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
      const Outcome o = outcome_of(scene);
      REQUIRE(o.status == Status::finished);
      multiple += o.touches > 1;
      // Watched for another 60 R/c, the centre's velocity does not change any more.
      Snapshot last;
      const Observer observer{o.time + 60, equally_spaced(o.time, 60, 2, o.step), [&](const Snapshot& s) { last = s; }};
      run_scene({p.get(), t.get()}, scene, go_on, &observer);
      Vec2 v = Vec2::Zero();
      for (const Vec2& u : last.bodies[0].velocity) v += u / p->nodes();
      CHECK(v.y() == Catch::Detail::Approx(o.vn).epsilon(1e-6));
    }
  CHECK((multiple >= 1 || sanitized));
}

TEST_CASE("scenes that cannot start are refused") {
  Scene scene = small_scene(1, 1);
  const auto starts = [&] { check_start(BuiltSolids(scene), scene); };
  CHECK_NOTHROW(starts());
  SECTION("an unstable step, naming bound, node and a step that works") {
    scene.integration.step = 1;
    CHECK_THROWS_WITH(starts(), Catch::Matchers::Contains("is unstable: pefrl needs a step below") &&
                                    Catch::Matchers::Contains("node ") && Catch::Matchers::Contains("works"));
  }
  SECTION("bodies that overlap") {
    scene.launch.height = -0.5;
    CHECK_THROWS_WITH(starts(), Catch::Matchers::Contains("overlap at the start"));
  }
  SECTION("a landing beside the target") {
    scene.launch.at = 50;
    CHECK_THROWS_WITH(starts(), Catch::Matchers::Contains("passes beside the target"));
  }
}

TEST_CASE("the disk lands where asked, whatever the angle") {
  for (double psi1 : {0.0, 2.0, 10.0})
    for (double at : {-0.5, 0.4}) {
      Scene scene = small_scene(1, psi1, 0);
      scene.launch.at = at;
      const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
      const Start start = launch(scene, {p.get(), t.get()});
      // From there on to where the smooth outlines touch.
      const double fall =
          (start.bodies[0].centre.y() - t->centre().y() - start.overlap_height) / -start.bodies[0].velocity.y();
      CHECK(start.bodies[0].centre.x() + fall * start.bodies[0].velocity.x() == Catch::Detail::Approx(at).margin(1e-9));
      CHECK(start.touches);
    }
}

TEST_CASE(
    "a projectile does not fly through its target unseen: such a step is refused, and without repulsion it has "
    "tunnelled") {
  struct Case {
    const char* method;
    double speed, theta;
  };
  Scene scene = paper_scene();
  scene.projectile = disk(40, 1, 0.03, 1);
  scene.target = wall(150, 0.1, 0.03, 1);
  scene.launch.psi1 = 0;
  scene.contact.xi = 3000;
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  for (const Case& c : {Case{"pefrl", 2, 2.9},
                        {"verlet", 2, 1.9},
                        {"verlet", 1, 0.4},
                        {"takahashi_imada", 0.5, 3},
                        {"multirate_8", 2, 20}}) {
    Scene coarse = scene;
    coarse.launch.speed = c.speed;
    coarse.integration.method = c.method;
    coarse.integration.theta = c.theta;
    INFO(c.method);
    CHECK_THROWS_WITH(launch(coarse, {p.get(), t.get()}), Catch::Matchers::Contains("might pass the contact unseen"));
    // What it says works.
    std::string words;
    try {
      launch(coarse, {p.get(), t.get()});
    } catch (const FieldError& error) {
      words = error.what();
    }
    coarse.integration.theta = std::stod(words.substr(words.rfind("give ") + 5));
    const Outcome o = run_scene({p.get(), t.get()}, coarse, std::atomic<bool>{false});
    INFO(words << " | " << name_of(o.status) << " " << o.reason);
    CHECK(o.status != Status::no_contact);
    if (o.status == Status::finished) CHECK(o.e > -0.1);
  }
  scene.contact = {};
  scene.contact.V0 = 1e-12;
  scene.launch.speed = 0.1;
  const Outcome through = run_scene({p.get(), t.get()}, scene, std::atomic<bool>{false});
  CHECK(through.status == Status::tunnelled);
  CHECK_THAT(through.reason, Catch::Matchers::Contains("raise contact.V0"));
}

TEST_CASE("the closest approach of a straight flight is that of two circles") {
  Scene scene = paper_scene();
  scene.projectile = disk(60, 1e4, 0, 1);
  scene.target = disk(80, 1e4, 0, 2);
  scene.launch.psi1 = not_given;
  scene.launch.angle = 0;
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  for (const double at : {0.0, 1.0, 1.9}) {
    scene.launch.at = at;
    CHECK(closest_approach(launch(scene, {p.get(), t.get()}), {p.get(), t.get()}, 1e-3) <= 1e-3);
  }
  Start beside = launch(scene, {p.get(), t.get()});
  beside.bodies[0].centre.x() = p->centre().x() + 2.2;
  CHECK(closest_approach(beside, {p.get(), t.get()}, 1e-3) == Catch::Detail::Approx(0.2).margin(0.03));
}

TEST_CASE("a launch may be given by speed and angle, by psi1, or by its components") {
  Launch a, b, c;
  a.speed = 0.2;
  a.psi1 = std::tan(0.7);
  b.speed = 0.2;
  b.angle = 0.7 * 180 / std::numbers::pi;
  c.normal_speed = 0.2 * std::cos(0.7);
  c.tangential_speed = 0.2 * std::sin(0.7);
  CHECK((a.velocity() - b.velocity()).norm() < 1e-15);
  CHECK((a.velocity() - c.velocity()).norm() < 1e-15);
  a.angle = 3;
  CHECK_THROWS_AS(a.velocity(), FieldError);
}
