// A pointed target between the nodes of a disk: what the contact keeps outside, and what a row says of what it does
// not.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "impact/batch.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const std::atomic<bool> go_on{false};

/// A smooth disk that falls on the tip of a free triangle, by a lattice and a speed.
Scene tip_and_disk(int lattice, double speed) {
  Scene scene;
  scene.projectile = disk(60, 1e4, 0, lattice);
  scene.target = std::make_shared<Body>(Body{{{-1, -1}, {1, -1}, {0, 1}}, numbers(150, 1e4, 0, lattice), {}, {}});
  scene.launch.speed = speed;
  return scene;
}

Outcome outcome_of(const Scene& scene) { return run_scene(BuiltSolids(scene), scene, go_on); }

}  // namespace

TEST_CASE("a tip that meets a disk stays outside by default, and one-sided it is told: 12 lattices, 3 speeds") {
  for (const bool paper : {false, true}) {
    int tunnelled = 0, finished = 0;
    double deepest = 0, shallowest = 1, least_e = 2, most_e = 0;
    for (const double speed : {0.05, 0.1, 0.2})
      for (int lattice = 1; lattice <= 12; ++lattice) {
        Scene scene = tip_and_disk(lattice, speed);
        if (paper) scene.contact = {paper_contact().V0, paper_contact().xi, paper_contact().reach, "two"};
        const Outcome two = outcome_of(scene);
        INFO((paper ? "the paper's contact" : "default")
             << ", lattice " << lattice << ", " << speed << " c: " << two.reason);
        REQUIRE(two.status == Status::finished);
        CHECK(two.penetration < 0.01);
        deepest = std::max(deepest, two.penetration);
        least_e = std::min(least_e, two.e_n);
        most_e = std::max(most_e, two.e_n);

        scene.contact.sides = "one";
        const Outcome one = outcome_of(scene);
        CHECK((one.status == Status::tunnelled || one.status == Status::finished));
        CHECK(one.certified == 0);
        CHECK(one.penetration > 0.01);  // a row that does not end tunnelled tells it
        (one.status == Status::tunnelled ? tunnelled : finished) += 1;
        shallowest = std::min(shallowest, one.penetration);
      }
    CHECK(least_e > 0.85);
    CHECK(most_e < 1);
    fmt::print(
        "tip and disk, {}: 36 of 36 finish, penetration {:.4f} R at most, e_n {:.3f} to {:.3f}; with one side {} "
        "are tunnelled, {} finish with a penetration of {:.3f} R or more\n",
        paper ? "the paper's contact" : "default", deepest, least_e, most_e, tunnelled, finished, shallowest);
  }
}

TEST_CASE("a contact has two sides by default") {
  Scene scene = tip_and_disk(1, 0.1);
  const Outcome by_default = outcome_of(scene);
  scene.contact.sides = "two";
  CHECK(exact_text(outcome_of(scene)) == exact_text(by_default));
}
