#include "script/sweep_descriptions.hpp"

#include "script/fields.hpp"

namespace ricochet {
namespace {

Function sweep_function() {
  return {
      .name = "sweep",
      .doc =
          "Scenes over every combination of some values. `sweep:run()` runs them on all cores, leaves results.h5 and "
          "results.csv in the run's folder and returns the rows. A sample that did not finish is counted and never "
          "averaged in. Of more points than --at-once (8192), but not with samples, the scenes are made and run chunk "
          "by chunk, those that share a lattice together, and the rows are read from results.h5 as they are asked for: "
          "`scene` must then depend on `at` alone.",
      .fields =
          {{"name", "string", "", "names the folder of its results"},
           {"over", "table", "",
            "name = list of values, each a number, string or boolean; and what zip or latin_hypercube returns. Of the "
            "columns psi1, seed and step may be among them: a row then holds what was asked for as psi1 and over_psi1, "
            "and what the impact had, a spin included, as outcome_psi1; in files they are over_psi1 and psi1"},
           {"units", "table", "", "name = unit of a value of 'over', for axes: { gap = \"R\" }", any_number, "{}"},
           {"scene", "function", "", "function (at) that returns the scene at the values at.name"},
           {"samples",
            "string",
            "",
            "by_error: as many samples of every point as a wanted error of `of` takes, in rounds; the scene's "
            "function gets their running number as at.sample, from 1. The error is that of the samples: what a finer "
            "lattice or mesh would change is not in it",
            any_number,
            "",
            true,
            {"by_error"}},
           {"standard_error", "number", "", "with samples: wanted of the mean at every point", positive, "", true},
           {"relative_error", "number", "", "the same, over the mean", positive, "", true},
           {"of", "string", "", "with samples: the outcome that it is about", any_number, "e"},
           {"most", "integer", "", "with samples: of a point, at most", {8, 1e6}, "10000"},
           {"pilot",
            "integer",
            "",
            "with samples: of every point in the first round; of 8, intervals of few units are short, of 16 not",
            {8, 1e6},
            "8"},
           {"mirrored", "boolean", "", "with samples: strike lattices from both sides; where that pays, unless given",
            any_number, "", true}},
      .returns = "sweep",
      .example =
          "ricochet.sweep { name = \"angles\", over = { psi1 = {0, 1} }, scene = function(at) return "
          "scene_at(at.psi1) end }"};
}

// lua/ricochet/find.lua
Function find_function() {
  return {
      .name = "find",
      .doc =
          "At which value of one parameter the mean of a column is `value`, by bisection: the same lattices are struck "
          "at every value that is tried, so that the mean goes one way where it does so at all; one that turns back is "
          "refused, and so is a range in which the value does not lie. Prints the result, and leaves all impacts as "
          "the results of a sweep. Returns a table: `at`, by a straight line between the last two values tried "
          "(`bracket`); `se`, the standard error of the mean over its `slope` there, which is taken between the "
          "nearest values whose means differ by 4 standard errors; `low` and `high`, between which it is with 95 % by "
          "Student's t; `count`, of the lattices whose impacts all finished; `places`, of values tried; `rows`. "
          "Without an error (nan), `reason` says why.",
      .fields = {{"name", "string", "", "names the folder of the impacts", any_number, "find"},
                 {"scene", "function", "",
                  "function (at) that returns the scene at the value at.NAME, on the lattice of at.sample, from 1"},
                 {"column", "string", "", "the outcome"},
                 {"value", "number", "", "wanted of its mean"},
                 {"over", "table", "", "{ NAME = { low, high } }: one name, and where to look"},
                 {"units", "table", "", "as those of a sweep", any_number, "{}"},
                 {"samples", "integer", "", "lattices", {1, 1e6}},
                 {"tolerance", "number", "", "how far apart the last two values may be", positive}},
      .returns = "table",
      .example =
          "local found = ricochet.find { column = \"e\", value = 0.9, over = { speed = { 0.02, 0.4 } }, "
          "samples = 16, tolerance = 1e-3,\n  scene = function(at) return scene_at(at.speed, at.sample) end }",
      .is_adaptive = true};
}

// lua/ricochet/rows.lua
std::vector<Function> rows_functions() {
  return {
      {.name = "rows:summary",
       .doc = "Mean, standard deviation, standard error and count of columns of finished rows, grouped. `:print()` "
              "prints it as a table, and says what else varied.",
       .fields = {{"by", "string or strings", "", "column to group by, or several: a line each combination"},
                  {"of", "strings", "", "columns to average; undefined values are left out"}},
       .returns = "summary",
       .example = "rows:summary { by = \"psi1\", of = { \"e\", \"mu\" } }:print()"},
      {.name = "rows:power_law",
       .doc =
           "The exponent of a power law y = factor x^exponent by least squares of the logarithms of finished "
           "rows: a table of `exponent`, `factor`, `count`, the exponent's standard error `se` and its `freedom`, and "
           "`low` and `high`, between which it is with 95 % by Student's t. Impacts of one lattice are not "
           "independent: the error is that of a jackknife over the values of `unit`. Rows of one unit, or a fit that "
           "hangs on one, leave it undefined (nan), and `reason` says why.",
       .fields = {{"x", "string", "", "column of numbers above 0"},
                  {"y", "string", "", "column of numbers above 0; rows where it is undefined are left out"},
                  {"unit", "string", "",
                   "column whose equal values share a lattice; sample if the rows have it, else seed", any_number, "",
                   true}},
       .returns = "table",
       .example = "local law = rows:power_law { x = \"speed\", y = \"e\" }"},
      {.name = "rows:paired",
       .doc = "By how much a column changes between two values of another, over the lattices that both have, whose own "
              "scatter falls out: a table of `change`, its standard error `se`, `low` and `high` (95 %, Student's t), "
              "`is_seen`, `units` and `gain`: how many times more independent lattices would be needed.",
       .fields = {{"by", "string", "", "column of the two values"},
                  {"of", "string", "", "column to compare"},
                  {"at", "numbers", "", "the two values"},
                  {"unit", "string", "", "as in rows:power_law", any_number, "", true}},
       .returns = "table",
       .example = "rows:paired { by = \"psi1\", of = \"e\", at = { 0, 1 } }"},
      {.name = "rows:save",
       .doc = "Writes columns of the rows into the run's folder, as NAME.csv and NAME.h5, with their units.",
       .fields = {{"name", "string", "", "file name without extension"},
                  {"columns", "strings", "", "in this order, those that the script added among them"}},
       .returns = "nothing",
       .example = "rows:where { psi1 = 1 }:save { name = \"grazing\", columns = { \"sample\", \"e\" } }"},
      {.name = "rows:where",
       .doc = "The rows whose columns have the given values.",
       .returns = "rows",
       .example = "rows:where { psi1 = 1 }:summary { by = \"sample\", of = { \"e\" } }:print()"}};
}

Function range_function() {
  return {.name = "range",
          .doc = "The list first, first + step ... last; range(n) is 1 ... n.",
          .returns = "table",
          .example = "ricochet.range(3) -- {1, 2, 3}",
          .arguments = {{"first", "number"},
                        {"last", "number", "", "", any_number, "", true},
                        {"step", "number", "", "", any_number, "", true}}};
}

// lua/ricochet/designs.lua
std::vector<Function> design_functions() {
  return {
      {.name = "logspace",
       .doc = "The list of `count` values from first to last, each the same number of times the one before.",
       .returns = "table",
       .example = "ricochet.logspace(0.01, 1, 3) -- {0.01, 0.1, 1}",
       .arguments = {{"first", "number"}, {"last", "number"}, {"count", "integer"}}},
      {.name = "zip",
       .doc = "Values of several names that go together by their places in lists of equal length, instead of each "
              "with every other: for `over`, alone or beside names.",
       .returns = "table",
       .example = "local over = { sample = ricochet.range(4), ricochet.zip { speed = { 0.1, 0.2 }, psi1 = { 0, 2 } } }",
       .arguments = {{"lists", "table"}}},
      {.name = "latin_hypercube",
       .doc = "As many points spread at random, for `over`, so that each n-th of every range holds one. The same "
              "seed gives the same points everywhere.",
       .fields = {{"n", "integer", "", "points", {1, 1e6}},
                  {"ranges", "table", "", "name = { low, high }"},
                  {"seed", "integer", "", "of the random numbers", any_number, "1"}},
       .returns = "table",
       .example =
           "local over = ricochet.latin_hypercube { n = 100, ranges = { speed = { 0.01, 0.3 }, psi1 = { 0, 3 } } }"}};
}

}  // namespace

std::vector<Function> sweep_descriptions() {
  return std::vector<Function>{sweep_function(), find_function()} + rows_functions() +
         std::vector<Function>{range_function()} + design_functions();
}

}  // namespace ricochet
