#pragma once
// An elastic material as handbooks tell it, and what it is in a plane.

#include <string>
#include <vector>

#include "core/field.hpp"

namespace ricochet {

/// In SI. `yield` and `hardening` are data: they act only where a scene names an effect that uses them.
struct Material {
  double E = 0, nu = 0, density = 0;
  double yield = not_given, hardening = not_given;
  std::string source;

  static const std::vector<Member<Material>>& fields();
};

/// What a material is in a plane. Stress times thickness is force per length. Of a body of revolution, whose thickness
/// is its circumference, everything is as in 1 m of a long cylinder.
struct PlaneMaterial {
  double E = 0;                                     ///< E2 times the thickness [N/m]
  double nu = 0;                                    ///< nu2
  double density = 0;                               ///< per area [kg/m^2]
  double yield = not_given, hardening = not_given;  ///< times the thickness [N/m]
  double thickness = 1;                             ///< [m]
};

/// A sheet that is free to bulge (plane_stress): E2 = E, nu2 = nu; a long cylinder (plane_strain) and a body of
/// revolution (axisymmetric): E2 = E/(1 - nu^2), nu2 = nu/(1 - nu). `thickness` in m.
PlaneMaterial in_plane(const Material& material, const std::string& state, double thickness);

/// The elastic material of which this is what it is in a plane.
Material in_space(const PlaneMaterial& material, const std::string& state);

}  // namespace ricochet
