#include <catch2/catch.hpp>
#include <sstream>

#include "body/interior.hpp"
#include "body/springs/sweep.hpp"
#include "core/error.hpp"
#include "impact/launch/launch.hpp"
#include "record/lammps.hpp"
#include "scenes.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

/// The numbers of a section of a data file, a line each.
std::vector<std::vector<double>> section(const std::string& data, const std::string& title) {
  std::vector<std::vector<double>> lines;
  std::istringstream in(data.substr(data.find("\n\n", data.find("\n" + title)) + 2));
  for (std::string line; std::getline(in, line) && !line.empty();) {
    std::istringstream words(line);
    lines.emplace_back();
    for (double x; words >> x;) lines.back().push_back(x);
  }
  return lines;
}

}  // namespace

TEST_CASE("a LAMMPS data file holds the nodes as launched, and bonds of class2 with the springs' energy") {
  Scene scene = small_scene(1, 0.7);
  Body target = *scene.target;
  target.numbers.quartic = 40;
  const std::size_t planned = static_cast<std::size_t>(target.numbers.nodes);
  for (std::size_t i = 0; i < planned; ++i)
    target.node_stiffness.push_back(target.numbers.stiffness * (1 + 0.5 * std::sin(static_cast<double>(i))));
  scene.target = std::make_shared<Body>(target);
  scene.launch.spin = 0.01;
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  const LammpsFiles files = lammps_files(scene, {p.get(), t.get()}, "s");
  const Start start = launch(scene, {p.get(), t.get()});

  const auto atoms = section(files.data, "Atoms"), bonds = section(files.data, "Bonds"),
             coefficients = section(files.data, "Bond Coeffs"), velocities = section(files.data, "Velocities");
  REQUIRE(static_cast<int>(atoms.size()) == p->nodes() + t->nodes());
  REQUIRE(bonds.size() == p->springs()->list.size() + t->springs()->list.size());
  REQUIRE(coefficients.size() == bonds.size());
  CHECK_THAT(files.data, Catch::Matchers::Contains(std::to_string(atoms.size()) + " atoms\n" +
                                                   std::to_string(bonds.size()) + " bonds\n5 atom types\n"));
  Vec2 centre = Vec2::Zero(), velocity = Vec2::Zero();
  int anchored = 0;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const bool flies = static_cast<int>(i) < p->nodes();
    CHECK(atoms[i][1] == (flies ? 1 : 2));
    anchored += atoms[i][2] == 5;
    if (flies) {
      centre += Vec2(atoms[i][3], atoms[i][4]) / p->nodes();
      velocity += Vec2(velocities[i][1], velocities[i][2]) / p->nodes();
    } else
      CHECK((velocities[i][1] == 0 && velocities[i][2] == 0));
  }
  CHECK((centre - in_plane(start.bodies[0].centre)).norm() < 1e-13);
  CHECK((velocity - in_plane(start.bodies[0].velocity)).norm() < 1e-13);
  CHECK(anchored == t->nodes() - t->free);

  // Both energies where the nodes have been shaken.
  const auto shaken = [](std::size_t i) -> Vec2 {
    return 0.02 * Vec2(std::sin(3.0 * static_cast<double>(i)), std::cos(5.0 * static_cast<double>(i)));
  };
  double theirs = 0;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const auto place = [&](double atom) {
      const auto i = static_cast<std::size_t>(atom) - 1;
      return Vec2(Vec2(atoms[i][3], atoms[i][4]) + shaken(i));
    };
    const auto& k = coefficients[static_cast<std::size_t>(bonds[b][1]) - 1];  // type, r0, K2, K3, K4
    const double x = (place(bonds[b][2]) - place(bonds[b][3])).norm() - k[1];
    theirs += k[2] * x * x + k[3] * x * x * x + k[4] * x * x * x * x;
  }
  double ours = 0;
  for (int body : {0, 1}) {
    const Solid& lattice = body == 0 ? *p : *t;
    Motion<1> moving = at_rest<1>(lattice);
    moving.stiffness.setConstant((body == 0 ? scene.projectile : scene.target)->numbers.stiffness);
    for (int i = 0; i < lattice.nodes(); ++i) {
      const std::size_t atom = static_cast<std::size_t>(i + (body == 0 ? 0 : p->nodes()));
      moving.q.set(i, 0, Vec2(Vec2(atoms[atom][3], atoms[atom][4]) + shaken(atom)));
    }
    ours += interior_energy(moving)[0];
  }
  CAPTURE(theirs - ours, ours);
  CHECK(theirs == Catch::Detail::Approx(ours).epsilon(1e-12));
}

TEST_CASE("LAMMPS files of effects, or of bodies that pass by each other, are refused") {
  Scene scene = small_scene(1, 0);
  const auto p = build_solid(*scene.projectile), t = build_solid(*scene.target);
  scene.effects = {Gravity{0.01, "both"}};
  CHECK_THROWS_AS(lammps_files(scene, {p.get(), t.get()}, "s"), FieldError);
  scene.effects.clear();
  scene.launch.psi1 = not_given;
  scene.launch.angle = 90;
  CHECK_THROWS_AS(lammps_files(scene, {p.get(), t.get()}, "s"), FieldError);
}
