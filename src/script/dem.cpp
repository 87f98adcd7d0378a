// ricochet.dem, written in Lua: lua/ricochet/dem.lua and dem_lines.lua.

#include <algorithm>
#include <optional>

#include "script/functions.hpp"
#include "script/objects.hpp"
#include "script/session.hpp"

namespace ricochet {
namespace {

// The scene of a row of this run, by its hash.
std::optional<Scene> scene_of_row(const Session& session, const std::string& hash) {
  for (const Swept& swept : session.swept)
    if (std::optional<Scene> scene = swept.scene_of(hash)) return scene;
  for (const auto& [scene, row] : session.singles)
    if (scene.hash() == hash) return scene;
  return std::nullopt;
}

// Pushes what a body is of, in SI, or false where it is rigid.
void push_material(lua_State* L, const Body& body, const Units& units) {
  if (body.rigid() || !body.material) return lua_pushboolean(L, false);
  PlaneMaterial plane = *body.material;
  const bool space = body.numbers.axisymmetric();
  plane.E *= units.worth(space ? "m0 c^2/R^3" : "m0 c^2/R^2");
  plane.density *= units.worth(space ? "m0/R^3" : "m0/R^2");
  const Material material = in_space(plane, body.numbers.state);
  lua_createtable(L, 0, 3);
  for (const auto& [name, value] :
       {std::pair{"E", material.E}, std::pair{"nu", material.nu}, std::pair{"density", material.density}}) {
    lua_pushnumber(L, value);
    lua_setfield(L, -2, name);
  }
}

// materials_of(hash): what the projectile and the target of a row of this run are of; nothing if it is of another run.
int materials_of(lua_State* L) {
  const std::optional<Scene> scene = scene_of_row(session_of(L), luaL_checkstring(L, 1));
  if (!scene) return 0;
  push_material(L, *scene->projectile, scene->units);
  push_material(L, *scene->target, scene->units);
  return 2;
}

}  // namespace

Group dem_functions() {
  return {
      .functions =
          {{.name = "dem",
            .doc =
                "What a code of discrete elements needs of a pair of materials, from rows of scenes in SI: e at every "
                "normal speed of the head-on impacts (psi1 = 0), and mu and beta0 of the oblique ones, each with its "
                "standard error. Leaves NAME_dem.csv and NAME_dem.json, and the lines that LAMMPS (NAME_dem.lammps: "
                "pair_style granular), YADE (NAME_dem_yade.py) and MercuryDPM (NAME_dem_mercury.cpp, not run) read "
                "for a sphere of the projectile's material on the target's. Those codes take one e for all speeds: "
                "the files say at which it was taken, and by how much it is off at a third and at three times that. "
                "Returns a table: e (a list of v, e, e_se, count), mu, mu_se, beta0, beta0_se (NaN where the rows do "
                "not tell them, and the files say why), at, e_at, and e_lammps, the number that LAMMPS must be given "
                "so that e_at comes out. The bodies of the rows are plane: mu and beta0 are theirs.",
            .fields = {{"rows", "rows", "",
                        "of a sweep over speeds, head on, in SI; oblique impacts may be among them"},
                       {"oblique", "rows", "", "of another sweep, over psi1, for mu and beta0", any_number, "", true},
                       {"projectile", "material", "",
                        "of the projectile; rows of this run must be of it, of others the files say that nobody knows"},
                       {"target", "material", "", "of the target, likewise; rigid unless given", any_number, "", true},
                       {"at", "number", "m/s",
                        "normal speed at which the constant e is taken; the middle one that was measured unless "
                        "given",
                        positive, "", true},
                       {"name", "string", "", "how the files' names begin", any_number, "pair"}},
            .returns = "table",
            .example = "ricochet.dem { rows = rows, projectile = ricochet.materials.steel, name = \"steel\" }"}},
      .natives = {{"materials_of", guarded<materials_of>}}};
}

}  // namespace ricochet
