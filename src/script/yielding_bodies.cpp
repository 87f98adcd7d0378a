#include "script/yielding_bodies.hpp"

#include <cmath>

namespace ricochet {
namespace {

// What yields as a body's material does, and where the body is in space, whose stresses are no forces per length.
Yielding yielding_of(Yielding given, const Scene& scene, const Body& body, const char* name) {
  given.on = name;
  if (body.numbers.axisymmetric())
    for (double* stress : {&given.yield, &given.hardening})
      *stress *= scene.units.worth("m0 c^2/R^2") / scene.units.worth("m0 c^2/R^3");
  if (std::isnan(given.yield) && body.material) given.yield = body.material->yield;
  if (std::isnan(given.hardening) && body.material) given.hardening = body.material->hardening;
  if (std::isnan(given.hardening)) given.hardening = 0;
  return given;
}

}  // namespace

std::string usually_on(const Yielding& given, const Scene& scene) {
  const auto metal = [](const Body& body) {
    return body.numbers.interior == "elements" && body.numbers.state != "plane_stress" &&
           body.numbers.law == "polynomial" && body.material && !std::isnan(body.material->yield);
  };
  if (!std::isnan(given.yield) || !metal(*scene.target)) return "projectile";
  return metal(*scene.projectile) ? "both" : "target";
}

void add_yielding(const Yielding& given, Scene& scene) {
  if (given.on != "target") scene.effects.push_back(yielding_of(given, scene, *scene.projectile, "projectile"));
  if (given.on == "target" || (given.on == "both" && !scene.target->rigid()))
    scene.effects.push_back(yielding_of(given, scene, *scene.target, "target"));
}

}  // namespace ricochet
