// ricochet.material; the known ones are in lua/ricochet/materials.lua.

#include <fmt/format.h>

#include <cmath>

#include "script/displays.hpp"
#include "script/fields.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "script/report.hpp"

namespace ricochet {
namespace {

// Waves in the fastest solids, diamond and graphene, run at some 2e4 m/s.
void check_units(lua_State* L, const Material& made) {
  constexpr double fastest = 5e4;  // a margin for benchmarks, which take stiffer ones
  const double speed = std::sqrt(made.E / made.density);
  if (speed > fastest)
    throw_here(L, FieldError("density", fmt::format("of {:g} makes waves of {:.2g} m/s with E = {:g}, and no solid has "
                                                    "{:g}: give density in kg/m^3 (steel has 7850) and E in Pa",
                                                    made.density, speed, made.E, fastest)));
}

int material(lua_State* L) {
  check_table(L, 1, function_named("material"));
  Material made;
  read_members(L, 1, made);
  check_units(L, made);
  push_object(L, "ricochet.material", MaterialObject{made});
  return 1;
}

// material.E, material.source, ...: nil if it was not given.
int member(lua_State* L) {
  const Material& of = material_at(L, 1).material;
  const std::string name = asked_name(L, 2);
  std::vector<std::string> names;
  for (const Member<Material>& known : Material::fields()) {
    names.push_back(known.field.name);
    if (known.field.name != name) continue;
    if (const auto* number = std::get_if<double Material::*>(&known.place))
      std::isnan(of.**number) ? lua_pushnil(L) : lua_pushnumber(L, of.**number);
    else
      lua_pushstring(L, of.source.c_str());
    return 1;
  }
  throw unknown_name(L, "a material", name, names);
}

void make_material_type(lua_State* L) {
  make_type(L, "ricochet.material", collect_object<MaterialObject>, guarded<material_shown>);
  luaL_getmetatable(L, "ricochet.material");
  lua_pushcfunction(L, guarded<member>);
  lua_setfield(L, -2, "__index");
  lua_pop(L, 1);
}

}  // namespace

Group material_functions() {
  return {
      .functions = {{.name = "material",
                     .doc =
                         "An elastic material, for the `material` of bodies in scenes with units = \"SI\". Known ones, "
                         "each with its source: ricochet.materials.steel, aluminium, glass, alumina, pmma, "
                         "polycarbonate, rubber, ice. Their numbers are read as fields: "
                         "ricochet.materials.steel.E.",
                     .fields = fields_of<Material>(),
                     .returns = "material",
                     .example = "ricochet.material { E = 117e9, nu = 0.35, density = 8930, source = \"...\" }",
                     .call = guarded<material>}},
      .add = make_material_type};
}

}  // namespace ricochet
