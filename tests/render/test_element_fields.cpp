// What pictures show of elements: a square of two triangles, sheared and stretched by known amounts.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "render/fields.hpp"
#include "render/picture.hpp"

using namespace ricochet;
using namespace ricochet::render;

namespace {

FrameMesh square(const std::string& law, double E) {
  FrameMesh mesh;
  mesh.bodies = {{0, 4, {}, {{{0, 1, 2, 3}}}, numbers_of(solid_law(law, lame_of(0.3, "plane_stress")))}};
  mesh.rest = {0, 0, 1, 0, 1, 1, 0, 1};
  mesh.mass.assign(4, 1.0);
  mesh.anchored.assign(4, false);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.modulus = {E, E};
  return mesh;
}

Frame placed(const FrameMesh& mesh, double stretch_x, double stretch_y, double angle) {
  Frame frame;
  for (int i = 0; i < mesh.nodes(); ++i) {
    const double x = stretch_x * mesh.rest[2 * i], y = stretch_y * mesh.rest[2 * i + 1];
    append(frame.position, Vec2(std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y));
    append(frame.velocity, Vec2(0, 0));
  }
  return frame;
}

}  // namespace

TEST_CASE("pictures show the stress of elements in space, whatever they turned by") {
  const double E = 50, nu = 0.3, strain = 1e-3;
  const FrameMesh mesh = square("polynomial", E);
  const Fields fields(mesh);
  for (const double angle : {0.0, 0.7}) {
    const Frame frame = placed(mesh, 1 + strain, 1 - nu * strain, angle);  // uniaxial stress E strain
    for (const double p : fields.of_material("pressure", frame))
      CHECK(p == Catch::Detail::Approx(-E * strain / 2).epsilon(3e-3));
    for (const double s : fields.of_material("von_mises", frame))
      CHECK(s == Catch::Detail::Approx(E * strain).epsilon(3e-3));
    for (const double w : fields.of_material("energy_density", frame))
      CHECK(w == Catch::Detail::Approx(E * strain * strain / 2).epsilon(3e-3));
    for (const double s : fields.of_material("stretch", frame))
      CHECK(s == Catch::Detail::Approx((1 - nu) * strain / 2).epsilon(1e-3));
  }
}

TEST_CASE("pictures take Lame's constants of a triangle where they depend on the place") {
  const double E = 50, strain = 1e-3;
  FrameMesh mesh = square("linear", E);
  const Lame lame = lame_of(0, "plane_stress");
  mesh.lame = {0, 0, lame.lambda, lame.mu};  // the first is of a body of one law, nu = 0.3
  const Frame frame = placed(mesh, 1 + strain, 1, 0);
  const std::vector<double> pressure = Fields(mesh).of_material("pressure", frame);
  const double along = -E * strain / 2;                              // nu = 0: along x alone
  CHECK(pressure[3] == Catch::Detail::Approx(along).epsilon(3e-3));  // at the second alone
  CHECK(pressure[1] == Catch::Detail::Approx(along * (1 + 0.3) / (1 - 0.3 * 0.3)).epsilon(3e-3));  // at the first alone
}

TEST_CASE("pictures say each quantity in the units of their user: per area in the plane, per volume of revolution") {
  FrameMesh plane = square("polynomial", 50), ring = plane;
  ring.bodies[0].axisymmetric = true;
  const auto von_mises = std::find_if(material_quantities().begin(), material_quantities().end(),
                                      [](const Quantity& q) { return q.name == "von_mises"; });
  CHECK(label_of(*von_mises, 0, plane) == "von Mises stress [m_0c^2/R^2]");
  CHECK(label_of(*von_mises, 0, ring) == "von Mises stress [m_0c^2/R^3]");
  plane.units = ring.units = {2, 3, 5, true};
  CHECK(label_of(*von_mises, 0, plane) == "von Mises stress [N/m]");
  CHECK(label_of(*von_mises, 6, ring) == "von Mises stress [10^{6} Pa]");
  CHECK(ring.units.worth(unit_of(*von_mises, ring)) == Catch::Detail::Approx(3 / (2.0 * 25)));
  for (const auto& quantities : {material_quantities(), spring_quantities(), plot_quantities()})
    for (const Quantity& q : quantities)
      if (!q.unit.empty()) CHECK(plane.units.name(unit_of(q, plane)) != q.unit);
}
