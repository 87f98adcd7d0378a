#include "impact/launch/symmetry.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "impact/axes.hpp"

namespace ricochet {
namespace {

// The field by which a scene says how fast its projectile moves along the surface.
const char* sliding_field(const Launch& launch) {
  if (!std::isnan(launch.tangential_speed)) return "tangential_speed";
  return std::isnan(launch.angle) ? "psi1" : "angle";
}

void check_partners(const Solids& solids) {
  for (std::size_t b = 0; b < solids.size(); ++b) {
    const Solid& solid = *solids[b];
    if (solid.axisymmetric || std::holds_alternative<Plane>(solid.surface)) continue;
    throw FieldError(body_name(b),
                     "is of a plane section, and another body is axisymmetric; give it elements of state = "
                     "\"axisymmetric\" too, or take ricochet.plane {} as the target");
  }
}

}  // namespace

void check_symmetry(const Scene& scene, const Solids& solids) {
  const bool any = std::any_of(solids.begin(), solids.end(), [](const Solid* solid) { return solid->axisymmetric; });
  if (!any) return;
  check_partners(solids);
  const auto refuse = [](const std::string& field, const char* what) {
    throw FieldError(field, fmt::format("{}, and an axisymmetric body moves along its axis alone; leave it out", what));
  };
  if (tangential(scene.launch.velocity()) != 0) refuse(sliding_field(scene.launch), "slants the flight");
  if (scene.launch.spin != 0) refuse("spin", "turns the projectile off its axis");
  if (scene.launch.at != 0) refuse("at", "takes the projectile beside the target's axis");
  if (scene.target->spin != 0) refuse("target", "has a spin");
  if (tangential(scene.target->velocity) != 0) refuse("target", "has a velocity along the surface");
  if (!std::isnan(scene.contact.V0))
    throw FieldError("V0",
                     "is that of a rim node, whatever its share, and those of an axisymmetric body are rings of other "
                     "areas; leave it out");
}

}  // namespace ricochet
