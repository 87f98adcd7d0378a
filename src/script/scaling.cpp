#include "script/scaling.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

void check_material(const Body& body, const Units& units, const std::string& field) {
  if (units.si && !body.material && !body.rigid())
    throw FieldError(field,
                     "is of no material; in SI give it one (material = ricochet.materials.steel, or ricochet.material "
                     "{ E = ..., nu = ..., density = ... }) or, a target, interior = \"rigid\"");
  if (!units.si && body.material)
    throw FieldError(
        field, fmt::format("is of a material, whose numbers are in SI: give the scene units = \"SI\", or the body {} "
                           "and density instead",
                           body.numbers.of_elements() ? "E, nu" : "stiffness"));
}

// In space, moduli and densities are per volume.
std::string unit_of(const Body& body, const std::string& in_the_plane) {
  if (!body.numbers.axisymmetric()) return in_the_plane;
  return in_the_plane == "m0 c^2/R^2" ? "m0 c^2/R^3" : in_the_plane == "m0/R^2" ? "m0/R^3" : in_the_plane;
}

}  // namespace

Units si_units(const Body& projectile) {
  if (projectile.rigid()) throw FieldError("projectile", "must move inside; a rigid body can only be a target");
  check_material(projectile, {.si = true}, "projectile");
  const BodyNumbers usual;
  const Box box = bounding_box(projectile.outline);
  Units units{.si = true};
  if (projectile.numbers.axisymmetric()) {
    units.length = std::max(box.high.x(), (box.high.y() - box.low.y()) / 2);
    units.mass = projectile.material->density * std::pow(units.length, 3) / usual_density;
    units.time = std::sqrt(usual.stiffness * units.mass / (projectile.numbers.stiffness * units.length));
    return units;
  }
  units.length = (box.high - box.low).maxCoeff() / 2;
  units.mass = projectile.material->density * units.length * units.length / usual_density;
  units.time = std::sqrt(usual.stiffness * units.mass / projectile.numbers.stiffness);
  return units;
}

std::shared_ptr<const Body> scaled(const std::shared_ptr<const Body>& given, const Units& units,
                                   const std::string& field) {
  check_material(*given, units, field);
  if (!units.si) return given;
  auto body = std::make_shared<Body>(*given);
  for (Points* points : {&body->outline, &body->points})
    for (Vec2& p : *points) p /= units.length;
  for (Points& hole : body->holes)
    for (Vec2& p : hole) p /= units.length;
  for (double& modulus : body->node_stiffness) modulus /= units.worth(unit_of(*body, "m0 c^2/R^2"));
  for (double& density : body->node_density) density /= units.worth(unit_of(*body, "m0/R^2"));
  if (body->fine_at) *body->fine_at /= units.length;
  body->velocity /= units.worth("c");
  body->spin /= units.worth("c/R");
  if (body->plane) body->plane->offset /= units.length;
  for (const auto& member : BodyNumbers::fields())
    if (const auto* place = std::get_if<double BodyNumbers::*>(&member.place))
      body->numbers.** place /= units.worth(unit_of(*body, member.field.unit));
  if (body->rigid()) body->numbers.stiffness = BodyNumbers{}.stiffness;  // nobody gave it
  if (auto& material = body->material) {
    for (double* per_length : {&material->E, &material->yield, &material->hardening})
      *per_length /= units.worth(unit_of(*body, "m0 c^2/R^2"));
    material->density /= units.worth(unit_of(*body, "m0/R^2"));
  }
  return body;
}

}  // namespace ricochet
