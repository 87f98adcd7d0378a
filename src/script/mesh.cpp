// ricochet.mesh.

#include "shape/mesh.hpp"

#include "body/solid.hpp"
#include "script/objects.hpp"
#include "script/reader.hpp"
#include "shape/outline.hpp"

namespace ricochet {
namespace {

// Of the described outline and holes. [R^2]
double area_of(const Body& body) {
  double area = signed_area(body.outline);
  for (const Points& hole : body.holes) area += signed_area(hole);
  return area;
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
                                    {"mass_error", quality.area / area_of(body) - 1}}) {
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
                                "their area exceeds that of the outline.",
                         .fields = {{"body", "body", "", "of springs or elements"}},
                         .returns = "table",
                         .example = "ricochet.mesh { body = disk }.quality",
                         .call = guarded<mesh>}}};
}

}  // namespace ricochet
