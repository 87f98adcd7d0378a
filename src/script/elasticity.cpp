// ricochet.elasticity.

#include "body/springs/elasticity.hpp"

#include <algorithm>

#include "script/objects.hpp"
#include "script/reader.hpp"

namespace ricochet {
namespace {

int elasticity(lua_State* L) {
  check_table(L, 1, function_named("elasticity"));
  lua_getfield(L, 1, "body");
  const Body& band = *body_at(L, -1).body;
  if (std::find(band.anchored.begin(), band.anchored.end(), true) != band.anchored.end())
    throw_here(L, FieldError("body", "must have no anchored nodes"));
  Elasticity result{};
  try {
    const auto solid = build_solid(band);
    if (!solid->springs()) throw FieldError("body", "must be of springs; leave interior out");
    result = stretch_band(*solid, *solid->springs(), band.numbers.stiffness);
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
                      "solved statically. E is in m0 c^2/R^2, or in Pa if the band is of a material.",
               .fields = {{"body", "body", "", "a band longer along y than along x, nowhere anchored"}},
               .returns = "table",
               .example = "ricochet.elasticity { body = band }.E",
               .call = guarded<elasticity>}}};
}

}  // namespace ricochet
