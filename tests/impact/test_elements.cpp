// Impacts of bodies of elements, against the modes of the disk, against lattices, and among themselves.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "refusal.hpp"
#include "same_bits.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

/// c_P of a plane-stress sheet of the usual density and E = 1e4.
double pressure_speed(double nu) { return std::sqrt(1e4 / ((1 - nu * nu) * usual_density)); }

/// A disk whose mesh is finest at its lowest point, head on onto a rigid plane; speed in c_P of the disk.
Scene onto_plane(double nu, double speed, double h_min, const std::string& law = "linear", double coarser = 2) {
  Scene scene;
  Body disk{circle(1, 6000), element_numbers(0, 1e4, nu, law), {}, {}}, plane;
  disk.numbers.h_min = h_min;
  disk.numbers.h_max = coarser * h_min;
  plane.plane = Plane{};
  scene.projectile = std::make_shared<Body>(disk);
  scene.target = std::make_shared<Body>(plane);
  scene.launch.speed = speed * pressure_speed(nu);
  scene.launch.psi1 = 0;
  scene.contact.xi = 1000;
  return scene;
}

Outcome run(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

/// [R/c_P]
double contact_time(const Outcome& o, double nu) { return o.contact_time * pressure_speed(nu); }

}  // namespace

TEST_CASE("a disk of linear elements rebounds as its exact modes do") {
  // e of all modes of the continuum below 80 c_P/R (of 0.01 c_P below 40) on the same wall. Those above hold the rest:
  // at 0.1 c_P e rises by 0.0012 from 40 to 80, and by 0.0007 once more to 160.
  struct Known {
    double speed, e, tolerance;
  };
  for (const auto& [speed, e, tolerance] :
       {Known{0.01, 0.988642, 5e-4}, Known{0.05, 0.975634, 2e-3}, Known{0.1, 0.94503, 2e-3}}) {
    const Outcome o = run(onto_plane(0.33, speed, 0.05));
    CAPTURE(speed, o.e);
    REQUIRE(o.status == Status::finished);
    CHECK(std::abs(o.e - e) < tolerance);
    CHECK(o.energy_closure < 1e-6);
    CHECK(o.inverted == 0);
  }
}

TEST_CASE("e of elements converges as their mesh is refined", "[.slow]") {
  double before = 0, change = 1;
  for (const double h : {0.16, 0.08, 0.04, 0.02}) {
    const double e = run(onto_plane(0.33, 0.1, h, "linear", 1)).e;
    fmt::print("h {:g}: e {:.6f}\n", h, e);
    if (before > 0) {
      CHECK(std::abs(e - before) < 0.5 * change);
      change = std::abs(e - before);
    }
    before = e;
  }
  CHECK(change < 1e-4);
}

TEST_CASE("at a tenth of c_P the geometry of large strains raises e by 0.011, as it does in a lattice") {
  const Outcome small = run(onto_plane(1.0 / 3, 0.1, 0.05)), large = run(onto_plane(1.0 / 3, 0.1, 0.05, "polynomial"));
  CHECK(std::abs(small.e - 0.94465) < 2e-3);  // modes
  CHECK(std::abs(large.e - 0.95721) < 1e-3);  // another program of finite elements
  CHECK(std::abs(large.e - 0.9552) < 5e-3);   // a triangular lattice of 800 nodes
}

TEST_CASE("modes, elements of every law and a triangular lattice agree where they should", "[.slow]") {
  // The same disk at nu = 1/3: e by modes below 80, by another program of finite elements, and by a lattice of springs.
  struct Row {
    const char* law;
    double speed, e, tolerance;
  };
  for (const auto& [law, speed, e, tolerance] :
       {Row{"linear", 0.02, 0.98914, 2e-3}, Row{"linear", 0.1, 0.94465, 2e-3}, Row{"linear", 0.02, 0.98939, 5e-4},
        Row{"linear", 0.1, 0.94586, 1e-3}, Row{"polynomial", 0.02, 0.98888, 5e-4},
        Row{"polynomial", 0.1, 0.95721, 1e-3}, Row{"st_venant_kirchhoff", 0.02, 0.98677, 1e-3},
        Row{"st_venant_kirchhoff", 0.1, 0.96952, 1e-3}}) {
    const Outcome o = run(onto_plane(1.0 / 3, speed, 0.03, law));
    fmt::print("{} at {:g} c_P: e {:.5f} ({:.5f}), contact time {:.3f} R/c_P\n", law, speed, o.e, e,
               contact_time(o, 1.0 / 3));
    CHECK(std::abs(o.e - e) < tolerance);
  }
  for (const double speed : {0.02, 0.1}) {
    Scene lattice = onto_plane(1.0 / 3, speed, 0.03);
    Body disk{circle(), {}, {}, {}};
    disk.numbers.placement = "triangular";
    disk.numbers.quartic = 0;
    disk.numbers.stiffness = 1e4 * std::sqrt(3.0) / 2;
    lattice.projectile = std::make_shared<Body>(disk);
    const Outcome springs = run(lattice), elements = run(onto_plane(1.0 / 3, speed, 0.03, "polynomial"));
    fmt::print("triangular lattice at {:g} c_P: e {:.5f} ({:.5f} by elements)\n", speed, springs.e, elements.e);
    CHECK(std::abs(springs.e - elements.e) < 5e-3);
    CHECK(std::abs(springs.contact_time / elements.contact_time - 1) < 0.05);
  }
}

TEST_CASE("impacts of elements have the same bits alone, in lanes and on threads") {
  std::vector<Scene> list;
  for (const double speed : {0.02, 0.05, 0.07, 0.1, 0.03})
    for (const char* law : {"polynomial", "linear"}) list.push_back(onto_plane(0.3, speed, sanitized ? 0.4 : 0.1, law));
  const std::vector<std::string> alone = exact_texts(list, 1, 1);
  for (const int batch : {2, 3, 4}) CHECK(exact_texts(list, 2, batch) == alone);
}

TEST_CASE("a rough disk of elements keeps its ledger on a wall of elements, with friction and gravity") {
  Scene scene = paper_scene();
  BodyNumbers numbers = element_numbers(150, 1e4, 0.3);
  numbers.roughness = 0.03;
  scene.projectile = std::make_shared<Body>(Body{circle(), numbers, {}, {}});
  Body wall{box(4, 1.5), element_numbers(200, 400, 0.2), {}, {}};
  for (const Vec2& p : plan_nodes(wall.outline, wall.numbers, {}).points)
    wall.anchored.push_back(p.y() < -1.5 + 1e-9 || std::abs(p.x()) > 2 - 1e-9);
  scene.target = std::make_shared<Body>(wall);
  scene.launch.speed = 0.05;
  scene.launch.psi1 = 1;
  scene.effects = {Friction{0.3, 1}, Gravity{1e-4, "both"}};
  const Outcome o = run(scene);
  REQUIRE(o.status == Status::finished);
  CHECK(o.energy_closure < 1e-3);
  CHECK(o.e > 0.1);
  scene.effects.clear();
  const Outcome smooth = run(scene);
  CHECK(smooth.energy_closure < 1e-6);
}

TEST_CASE("every method moves elements to the same rebound") {
  Scene scene = onto_plane(0.3, 0.05, 0.15, "polynomial");
  scene.integration.method = "blanes_moan_srkn14a";
  const double exact = run(scene).e;
  for (std::size_t k = 0; k < methods().size(); k += sanitized ? 4 : 1) {
    const Method& method = methods()[k];
    CAPTURE(method.name);
    scene.integration.method = method.name;
    const Outcome o = run(scene);
    REQUIRE(o.status == Status::finished);
    CHECK(std::abs(o.e - exact) < 1e-3);
    CHECK(o.energy_closure < (method.symplectic() ? 1e-3 : 1e-2));
  }
}

TEST_CASE("what elements do not have is refused by name") {
  Scene scene = onto_plane(0.3, 0.05, 0.15);
  for (const Effect& effect : {Effect(Plastic{1e-3, 0.1, "projectile"}), Effect(Breaking{0.01, "both"})}) {
    scene.effects = {effect};
    CHECK(refusal(scene) == "effects: " + name_of(effect) +
                                " acts on springs, and the projectile has none; let it act on "
                                "another body, or leave it out");
  }
  scene.effects.clear();
  scene.launch.spin = 0.1;
  CHECK_THAT(refusal(scene), Catch::Matchers::Contains("the linear law takes a rotation for a strain"));
}
