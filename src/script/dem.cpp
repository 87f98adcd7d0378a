// ricochet.dem, written in Lua: lua/ricochet/dem.lua and dem_lines.lua.

#include "script/functions.hpp"

namespace ricochet {

Group dem_functions() {
  return {
      .functions = {
          {.name = "dem",
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
           .fields = {{"rows", "rows", "", "of a sweep over speeds, head on, in SI; oblique impacts may be among them"},
                      {"oblique", "rows", "", "of another sweep, over psi1, for mu and beta0", any_number, "", true},
                      {"projectile", "material", "", "of the projectile"},
                      {"target", "material", "", "of the target; rigid unless given", any_number, "", true},
                      {"at", "number", "m/s",
                       "normal speed at which the constant e is taken; the middle one that was measured unless "
                       "given",
                       positive, "", true},
                      {"name", "string", "", "how the files' names begin", any_number, "pair"}},
           .returns = "table",
           .example = "ricochet.dem { rows = rows, projectile = ricochet.materials.steel, name = \"steel\" }"}}};
}

}  // namespace ricochet
