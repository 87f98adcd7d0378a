// ricochet.elasticity.

#include "body/elasticity.hpp"

#include <algorithm>

#include "script/objects.hpp"
#include "script/reader.hpp"

namespace ricochet {
namespace {

// What a long cylinder is made of, from its moduli in the plane, E/(1 - nu^2) and nu/(1 - nu).
Elasticity of_cylinder(const Elasticity& plane) {
  const double nu = plane.poisson_ratio / (1 + plane.poisson_ratio);
  return {plane.young_modulus * (1 - nu * nu), nu};
}

int elasticity(lua_State* L) {
  check_table(L, 1, function_named("elasticity"));
  lua_getfield(L, 1, "body");
  const Body& band = *body_at(L, -1).body;
  if (std::find(band.anchored.begin(), band.anchored.end(), true) != band.anchored.end())
    throw_here(L, FieldError("body", "must have no anchored nodes"));
  Elasticity result{};
  try {
    if (band.numbers.axisymmetric())
      throw FieldError("body", "must be of a plane: a band of state = \"plane_strain\" has the same moduli");
    const auto solid = build_solid(band);
    if (band.rigid()) throw FieldError("body", "must give way; a rigid one has no modulus");
    result = stretch_band(*solid, band.numbers.stiffness);
    if (band.numbers.of_elements() && band.numbers.state == "plane_strain") result = of_cylinder(result);
  } catch (const Error& error) {
    throw_here(L, FieldError("body", error.what()));
  }
  lua_createtable(L, 0, 2);
  // Of a material, a stress: its stiffness holds the thickness.
  lua_pushnumber(L, result.young_modulus / (band.material ? band.material->thickness : 1));
  lua_setfield(L, -2, "E");
  lua_pushnumber(L, result.poisson_ratio);
  lua_setfield(L, -2, "nu");
  push_strict(L, "the table of moduli");
  return 1;
}

}  // namespace

Group elasticity_functions() {
  return {.functions = {
              {.name = "elasticity",
               .doc = "Young's modulus E and Poisson's ratio nu of a band, stretched along y by a small strain and "
                      "solved statically. E is in m0 c^2/R^2, or in Pa if the band is of a material. They are those of "
                      "its plane, or of elements those they were given.",
               .fields = {{"body", "body", "", "a band longer along y than along x, nowhere anchored"}},
               .returns = "table",
               .example = "ricochet.elasticity { body = band }.E",
               .call = guarded<elasticity>}}};
}

}  // namespace ricochet
