// ricochet.mesh.

#include "shape/mesh.hpp"

#include <numbers>

#include "body/solid.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "shape/curvature.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

// Of the described outline and holes: their area, or the volume that it goes through around the axis. [R^2, R^3]
double measure_of(const Body& body) {
  const auto of = [&](const Points& chain) {
    if (!body.numbers.axisymmetric()) return signed_area(chain);
    const Figure figure = figure_of(chain);
    return 2 * std::numbers::pi * figure.centre.x() * figure.area;
  };
  double sum = of(body.outline);
  for (const Points& hole : body.holes) sum += of(hole);
  return sum;
}

double measure_of(const Solid& solid) {
  double sum = 0;
  for (const Triangle& t : solid.cells) sum += measure_at_rest(solid, t);
  return sum;
}

int mesh(lua_State* L) {
  check_table(L, 1, function_named("mesh"));
  lua_getfield(L, 1, "body");
  const Body& body = *body_at(L, -1).body;
  if (body.rigid()) throw_here(L, FieldError("body", "is rigid, and has no triangles"));
  std::shared_ptr<const Solid> solid;
  try {
    solid = build_solid(body);
  } catch (const Error& error) {
    throw_here(L, FieldError("body", error.what()));
  }
  const MeshQuality quality = quality_of(solid->points, solid->cells);
  lua_createtable(L, 0, 6);
  for (const auto& [name, value] : {std::pair<const char*, double>{"nodes", solid->nodes()},
                                    {"triangles", static_cast<double>(solid->cells.size())},
                                    {"quality", quality.worst},
                                    {"shortest", quality.shortest},
                                    {"longest", quality.longest},
                                    {"mass_error", measure_of(*solid) / measure_of(body) - 1}}) {
    lua_pushnumber(L, value);
    lua_setfield(L, -2, name);
  }
  push_strict(L, "the table of a mesh");
  return 1;
}

}  // namespace

Group mesh_functions() {
  return {.functions = {{.name = "mesh",
                         .doc = "How the triangles of a body are: how many `nodes` and `triangles`; the `quality` of "
                                "the worst, 12 sqrt(3) area/perimeter^2, 1 if it is equilateral; the `shortest` and "
                                "`longest` side, in R, or in m of a body of a material; `mass_error`, by which share "
                                "their area, or volume, exceeds that of the outline.",
                         .fields = {{"body", "body", "", "of springs or elements"}},
                         .returns = "table",
                         .example = "ricochet.mesh { body = disk }.quality",
                         .call = guarded<mesh>}}};
}

}  // namespace ricochet
