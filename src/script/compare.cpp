// ricochet.compare, written in Lua: lua/ricochet/compare.lua and compare_text.lua.

#include "script/functions.hpp"

namespace ricochet {
namespace {

Field of_one(const std::string& interior, const std::string& examples) {
  return {interior,   "table",
          "",         "fields of the projectile of " + interior + " alone, over those of the scene's: " + examples,
          any_number, "",
          true};
}

}  // namespace

Group compare_functions() {
  return {
      .functions = {
          {.name = "compare",
           .doc =
               "One impact with the projectile of springs, of elements and of modes, side by side: the same outline, "
               "E, nu and density, target and contact. A lattice has the moduli that it has: where the scene's "
               "projectile is of springs, elements and modes are given what a band of its lattice measures, and where "
               "it is not, springs are made as stiff as it asks. Prints each one's E, nu and c_P (measured, by "
               "ricochet.elasticity), e, contact time, greatest normal force, the energies of the modes that hold most "
               "after the impact, and what a correct digit of e costs in time; then what must agree, and why what "
               "differs may. Leaves NAME.csv, and the force over time as NAME_springs.csv and so on. Returns a list, "
               "one table an interior: interior, E, nu, density, wave_speed, nodes, e, contact_time, "
               "contact_time_energy, force, inverted, row, scene, ringing (tables of omega, share and modes, those "
               "whose omega differ by less than 2 % as one) and cost (method, seconds, error, a_digit).",
           .fields = {{"scene", "scene", "", "of a free projectile in the plane, which finishes"},
                      {"interiors", "strings", "", "of springs, elements and modes, in the order they are shown",
                       any_number, "{ \"springs\", \"elements\", \"modes\" }"},
                      of_one("springs", "nodes, placement"),
                      of_one("elements", "h_min, law"),
                      of_one("modes", "modes"),
                      {"omega_most",
                       "number",
                       "",
                       "of a smooth disk head on to a plane: beside them what theory.modal_disk tells, extrapolated to "
                       "all modes from those below omega R/c_P = omega_most and those below half of it; left out "
                       "unless given",
                       {2, 160},
                       "",
                       true},
                      {"count", "integer", "", "modes whose energies are taken, the slowest first", {1, 2000}, "40"},
                      {"name", "string", "", "how the files' names begin", any_number, "compare"}},
           .returns = "table",
           .example =
               "ricochet.compare { scene = scene, springs = { placement = \"triangular\" }, count = 20 }[1].e"}}};
}

}  // namespace ricochet
