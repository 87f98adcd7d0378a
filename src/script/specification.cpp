#include "script/specification.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "force/catalogue.hpp"
#include "force/contact/exponential_repulsion.hpp"
#include "impact/outcome.hpp"
#include "impact/scene.hpp"
#include "lattice/lattice.hpp"
#include "render/show.hpp"
#include "theory/catalogue.hpp"

namespace ricochet {
namespace {

template <class Struct>
std::vector<Field> fields_of() {
  std::vector<Field> fields;
  for (const auto& member : Struct::fields()) fields.push_back(member.field);
  return fields;
}

std::vector<Field> operator+(std::vector<Field> a, const std::vector<Field>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Field changed(Field field, const std::string& initial) {
  field.initial = initial;
  return field;
}

// Numbers of a body, of which stiffness, roughness and anchors may depend on the place.
std::vector<Field> body_fields(const std::string& nodes, bool anchors) {
  std::vector<Field> fields = fields_of<BodyNumbers>();
  for (Field& field : fields) {
    if (field.name == "nodes") field = changed(field, nodes);
    if (field.name == "stiffness") {
      field.type = "number|function";
      field.doc += "; a function (x, y) gives that of a node, a spring takes the mean of its ends";
    }
  }
  if (anchors)
    fields.push_back(
        {"anchored", "function", "", "function (x, y) that is true where a node is held fixed", any_number, "", true});
  return fields;
}

std::vector<Function> make() {
  const Field scene{"scene", "scene", "", "what happens"};
  const Field frames{"frames", "integer", "", "how many", {1, 1e6}, "240"};
  const Field slow_motion{
      "slow_motion", "number", "", "so many times denser frames while the bodies touch; 1: equally spaced in time",
      {1, 1000},     "1"};
  const std::vector<Field> one_or_more{
      {"scene", "scene", "", "what happens", any_number, "", true},
      {"scenes", "scenes", "", "several instead, side by side, with common colours and times", any_number, "", true},
      {"titles", "strings", "", "above each scene", any_number, "", true}};
  const std::vector<Field> look{
      {"size", "numbers", "pixels", "width and height of the picture", any_number, "{1280, 720}"},
      {"show", "show", "", "what the picture shows, and how", any_number, "{}"}};
  const Field duration{"duration", "number", "R/c", "time covered, from `from` on; the whole impact unless given",
                       positive,   "",       true};
  const Field from{"from", "number", "R/c", "first time; before 0 the projectile is in free flight", {-1e6, 0}, "-1"};
  std::vector<Function> list;
  list.push_back({"parameters",
                  "Declares what a user may set on the command line as `name=value` and reads it. Each parameter is a "
                  "default, or a table with the default "
                  "first and any of unit, doc, min, max, int, choices. Returns the values.",
                  {},
                  "table",
                  "local p = ricochet.parameters { speed = { 0.1, unit = \"c\", min = 0, doc = \"impact speed\" } }"});
  list.push_back(
      {"body", "A random mass-spring lattice in a closed outline.",
       std::vector<Field>{
           {"outline", "points", "R",
            "corners { {x, y}, ... } in order along the boundary; concave is fine, crossing itself is not"}} +
           body_fields("800", true),
       "body", "ricochet.body { outline = { {0, 0}, {2, 0}, {1, 2} }, nodes = 300 }"});
  list.push_back({"disk", "A disk around the origin.",
                  std::vector<Field>{{"radius", "number", "R", "radius", positive, "1"}} + body_fields("800", true),
                  "body", "ricochet.disk { nodes = 800, roughness = 0.03, seed = 7 }"});
  list.push_back({"wall", "A rectangular block whose top is y = 0, held at both sides and at the bottom.",
                  std::vector<Field>{{"width", "number", "R", "extent along x, centred", positive, "8"},
                                     {"depth", "number", "R", "extent below y = 0", positive, "2"}} +
                      body_fields("4000", false),
                  "body", "ricochet.wall { nodes = 4000, stiffness = 100, roughness = 0.03, seed = 7 }"});
  list.push_back(
      {"scene",
       "One impact: a free projectile falls on a target along -y and moves along +x. It is placed upstream so that its "
       "smooth outline would touch the "
       "target's at x = launch.at. `scene:run()` runs it and returns a row; `scene:text()` is its canonical text, "
       "`scene:hash()` that text's hash.",
       std::vector<Field>{
           {"projectile", "body", "", "the body that flies in; free"},
           {"target", "body", "", "the body that is hit; free or anchored"},
           {"launch", "launch", "", "how the projectile comes in", any_number, "{}"},
           {"contact", "contact", "", "how the bodies repel each other", any_number, "{}"},
           {"effects", "effects", "",
            "list of what else acts, e.g. { ricochet.gravity { g = 1e-4 } }; what is not named is not computed",
            any_number, "{}"}} +
           fields_of<Integration>(),
       "scene",
       "ricochet.scene { projectile = ricochet.disk {}, target = ricochet.wall { stiffness = 100 }, launch = { psi1 = "
       "3 } }"});
  list.push_back({"launch", "The `launch` table of a scene.", fields_of<Launch>(), "", ""});
  list.push_back(
      {"contact",
       "The `contact` table of a scene: V0 exp(-xi d), summed over the rim segments within reach of each rim node.",
       fields_of<ExponentialRepulsion>(), "", ""});
  each_effect_kind([&]<class E>(const E&) {
    list.push_back(
        {E::name,
         std::string("An effect, for the `effects` of a scene. ") + E::doc +
             (is_split(E{}) ? fmt::format(" Goes with verlet only: outcomes converge at order {}.", order_beside(E{}))
                            : std::string()),
         fields_of<E>(), "effect", E::example});
  });
  list.push_back({"sweep",
                  "Scenes over every combination of some values. `sweep:run()` runs them on all cores, leaves "
                  "results.h5 and results.csv in the run's folder and "
                  "returns the rows. A sample that did not finish is counted and never averaged in.",
                  {{"name", "string", "", "names the folder of its results"},
                   {"over", "table", "", "name = list of values, each a number, string or boolean"},
                   {"scene", "function", "", "function (at) that returns the scene at the values at.name"}},
                  "sweep",
                  "ricochet.sweep { name = \"angles\", over = { psi1 = {0, 1} }, scene = function(at) return "
                  "scene_at(at.psi1) end }"});
  list.push_back({"rows:summary",
                  "Mean, standard deviation, standard error and count of columns of finished rows, grouped. `:print()` "
                  "prints it as a table.",
                  {{"by", "string", "", "column to group by"},
                   {"of", "strings", "", "columns to average; undefined values are left out"}},
                  "summary",
                  "rows:summary { by = \"psi1\", of = { \"e\", \"mu\" } }:print()"});
  list.push_back({"rows:power_law",
                  "The exponent of a power law y = factor x^exponent by least squares of the logarithms of finished "
                  "rows: a table of exponent, its standard error se, factor and count.",
                  {{"x", "string", "", "column of numbers above 0"}, {"y", "string", "", "column of numbers above 0"}},
                  "table",
                  "local law = rows:power_law { x = \"speed\", y = \"e\" }"});
  list.push_back({"rows:where",
                  "The rows whose columns have the given values.",
                  {},
                  "rows",
                  "rows:where { psi1 = 1 }:summary { by = \"sample\", of = { \"e\" } }:print()"});
  list.push_back(
      {"plot",
       "Draws the mean and standard error of columns against a column, lines of theory and published points, as "
       "NAME.svg and NAME.png, and leaves the gnuplot script NAME.gp beside them.",
       {{"rows", "rows", "", "rows of a sweep; none for a picture of theory alone", any_number, "", true},
        {"x", "string", "", "column along x; rows are grouped by it"},
        {"y", "strings", "", "columns along y, one panel each"},
        {"by", "string", "", "column whose values are drawn as a line each", any_number, "", true},
        {"log", "string", "", "axes with a logarithmic scale", any_number, "none", false, {"none", "x", "y", "xy"}},
        {"theory", "table", "",
         "column = function (x), points { {x, y}, ... }, or a list of { name =, f = } and { name =, points = }: drawn "
         "dashed beside that column",
         any_number, "{}"},
        {"theory_name", "string", "", "in the key, of a line that has no name of its own", any_number, "theory"},
        {"published", "table", "",
         "column = points { {x, y}, ... } or a list of { name =, points = }: drawn as open marks", any_number, "{}"},
        {"name", "string", "", "file name without extension"},
        {"title", "string", "", "above the plot", any_number, "", true},
        {"caption", "string", "", "below the title: parameters; how many impacts finished and failed is added",
         any_number, "", true},
        {"xlabel", "string", "", "instead of the column's name and unit", any_number, "", true},
        {"ylabel", "table", "", "column = text instead of its name and unit", any_number, "{}"},
        {"xrange", "numbers", "", "{ from, to } along x; all rows and points unless given", any_number, "", true},
        {"yrange", "table", "", "column = { from, to }", any_number, "{}"}},
       "nothing",
       "ricochet.plot { rows = rows, x = \"psi1\", y = { \"e\", \"mu\" }, name = \"angles\" }"});
  list.push_back({"animate",
                  "Draws an impact as a sequence of PNG files, and as a film, without a display, while it runs. "
                  "Colours and scales are those of the whole sequence. "
                  "Stopped and run again with --resume it goes on. Returns the impact's row, or a list of rows if "
                  "`scenes` was given.",
                  one_or_more + std::vector<Field>{frames, from, duration, slow_motion} + look +
                      std::vector<Field>{
                          {"out", "string", "",
                           "folder of the frames, below the run's folder; \"frames\" unless only a film is asked for",
                           any_number, "", true},
                          {"film", "string", "", "name of an .mp4 file, below the run's folder; needs ffmpeg",
                           any_number, "", true},
                          {"rate", "number", "1/s", "frames a second of the film", {1, 240}, "30"},
                          {"columns",
                           "integer",
                           "",
                           "scenes in a row; up to three unless given, more in a square",
                           {1, 100},
                           "",
                           true}},
                  "table",
                  "ricochet.animate { scene = scene, frames = 120, size = {960, 540}, show = { material = \"speed\", "
                  "ledger = true } }"});
  list.push_back({"show",
                  "The `show` table of animate, still and contact_sheet: layers by name. What is not switched on is "
                  "not computed. `ricochet render FILE.h5 name=value` takes the same.",
                  fields_of<render::Show>(), "", ""});
  list.push_back(
      {"still",
       "Draws one moment of an impact as OUT.png. Colours and scales are those of the whole impact. Returns the row, "
       "or a list of rows if `scenes` was given.",
       one_or_more +
           std::vector<Field>{{"at",
                               "number",
                               "R/c",
                               "when, since the rims came within reach; when contact holds most energy unless given",
                               {-1e6, 1e6},
                               "",
                               true}} +
           look +
           std::vector<Field>{
               {"out", "string", "", "file name without extension, below the run's folder", any_number, "still"}},
       "table", "ricochet.still { scene = scene, at = 3, show = { camera = \"contact\" } }"});
  list.push_back(
      {"contact_sheet",
       "Draws a grid of moments of one or several impacts as OUT.png: a row for each scene. Returns the row, or a list "
       "of rows if `scenes` was given.",
       one_or_more +
           std::vector<Field>{
               {"moments", "integer", "", "how many of each impact, from its touch to its parting", {1, 100}, "4"},
               {"times", "numbers", "R/c", "the moments, instead", any_number, "", true},
               {"columns",
                "integer",
                "",
                "pictures in a row of the grid; all moments of a scene unless given, one scene alone in a square",
                {1, 100},
                "",
                true}} +
           look +
           std::vector<Field>{{"out", "string", "", "file name without extension, below the run's folder", any_number,
                               "contact_sheet"}},
       "table", "ricochet.contact_sheet { scenes = { soft, hard }, titles = { \"soft\", \"hard\" }, moments = 3 }"});
  list.push_back(
      {"record",
       "Stores an impact as H5MD (OUT.h5, for MDAnalysis and `ricochet render`) and OUT.xdmf (for ParaView). Returns "
       "the impact's row.",
       {scene,
        changed(frames, "120"),
        changed(from, "0"),
        duration,
        slow_motion,
        {"out", "string", "", "file name without extension, below the run's folder", any_number, "trajectory"}},
       "table",
       "ricochet.record { scene = scene, frames = 200 }"});
  list.push_back(
      {"lammps",
       "Exports a scene without effects for LAMMPS: OUT.data and the input script OUT.in, with every spring as a bond "
       "of bond_style class2, which carries the quartic term. "
       "LAMMPS repels node from node, not from segment.",
       {scene, {"out", "string", "", "file name without extension, below the run's folder", any_number, "impact"}},
       "nothing",
       "ricochet.lammps { scene = scene }"});
  list.push_back(
      {"accuracy",
       "What accuracy costs: runs a scene by many methods and steps against two runs of order 6 at short steps, prints "
       "errors, force evaluations, wall times, "
       "energy drifts and fitted orders, and leaves NAME.csv and work-precision plots NAME.png, NAME.svg. With "
       "`lattices` it also shows what the size of the lattice "
       "changes, in a panel of its own. Returns a table with the rows (each with its "
       "`error` by column), the `reference`, its `floor`, and `cheapest(wanted)`: the row with the fewest force "
       "evaluations within that error.",
       {scene,
        {"methods", "strings", "", "integrators; all unless given", any_number, "", true},
        {"steps", "numbers", "R/c", "time steps of every method; six from 0.9 of its stability limit down unless given",
         any_number, "", true},
        {"of", "strings", "", "outcomes whose errors are taken; the first is printed and drawn", any_number, "{\"e\"}"},
        {"lattices", "numbers", "",
         "factors of the number of nodes, to show the lattice's own error by; none unless given", any_number, "", true},
        {"lattice_samples", "integer", "", "lattices of each size", {2, 10000}, "16"},
        {"repeats", "integer", "", "runs of each step; the least wall time counts", {1, 1000}, "3"},
        {"name", "string", "", "file name without extension", any_number, "accuracy"}},
       "table",
       "ricochet.accuracy { scene = scene, methods = { \"verlet\", \"pefrl\" }, of = { \"e\", \"beta\" } }"});
  list.push_back({"relevance",
                  "Which effects a scene calls for: runs it with and without each on the same lattices, prints the "
                  "change of outcomes with its standard error beside "
                  "that of their mean over the samples, and the cost in time. All by verlet. Returns a list of tables: "
                  "name, cost, and by outcome change, se, sampling.",
                  {scene,
                   {"effects", "effects", "", "those that may matter"},
                   {"of", "strings", "", "outcomes to compare", any_number, "{\"e\", \"beta\", \"mu\"}"},
                   {"samples", "integer", "", "lattices: the scene's own and others of its kind", {2, 100000}, "8"}},
                  "table",
                  "ricochet.relevance { scene = scene, effects = { ricochet.gravity { g = 1e-4 } } }"});
  list.push_back(
      {"plan",
       "The error budget of a sweep (time step, lattice size, samples: which one dominates), from a pilot, and the "
       "cheapest method, step, nodes and samples "
       "that bring a wanted standard error, with the time it will take. `plan:run()` runs that sweep, into the sweep's "
       "folder, and says how long it took. "
       "The lattice's error is extrapolated in the spacing of its nodes, and what the pilot leaves unknown of it "
       "counts as error too; the samples are planned with a "
       "deviation that nine pilots of ten do not underrate.",
       {{"sweep", "sweep", "", "with one name in `over` that counts samples"},
        {"standard_error", "number", "", "wanted at every point: root of the sum of the squares of the three errors",
         positive},
        {"of", "string", "", "the outcome it is about", any_number, "e"},
        {"samples", "string", "", "the name in `over` that counts samples", any_number, "sample"},
        {"pilot", "integer", "", "samples of the pilot at every point and size", {2, 100000}, "8"},
        {"sizes", "numbers", "", "factors of the number of nodes that the pilot tries", any_number, "{0.25, 0.5, 1}"},
        {"continuum", "boolean", "",
         "count as error what an infinitely fine lattice would change; else only what other lattices than the scene's "
         "own change",
         any_number, "false"}},
       "plan",
       "ricochet.plan { sweep = sweep, standard_error = 0.01 }:run()"});
  list.push_back(
      {"elasticity",
       "Young's modulus E and Poisson's ratio nu of a band, stretched along y by a small strain and solved statically.",
       {{"body", "body", "", "a band longer along y than along x, nowhere anchored"}},
       "table",
       "ricochet.elasticity { body = band }.E"});
  list.push_back({"file.write",
                  "Writes text into a file below the run's folder: ricochet.file.write(name, text).",
                  {},
                  "nothing",
                  "ricochet.file.write(\"note.txt\", \"done\")"});
  list.push_back({"file.read",
                  "Reads a file below the run's folder: ricochet.file.read(name).",
                  {},
                  "string",
                  "ricochet.file.read(\"note.txt\")"});
  list.push_back({"range",
                  "The list first, first + step ... last; range(n) is 1 ... n.",
                  {},
                  "table",
                  "ricochet.range(3) -- {1, 2, 3}"});
  for (const theory::Theory& t : theory::theories()) {
    Function f{"theory." + t.name,
               fmt::format("{} Valid: {}. Source: {}. Units in any consistent system of mass M, length L and time T.",
                           t.says, t.valid, t.source),
               t.arguments, "table", t.example};
    if (t.results.size() > 1)
      f.results = t.results;
    else
      f.returns = t.results[0].type;
    list.push_back(f);
  }
  return list;
}

std::string lua_type(const std::string& type) {
  if (type == "points") return "number[][]";
  if (type == "strings") return "string[]";
  if (type == "numbers") return "number[]";
  if (type == "number|function") return "number|fun(x: number, y: number): number";
  if (type == "function") return "function";
  if (type == "effects") return "ricochet.effect[]";
  if (type == "body" || type == "effect" || type == "scene" || type == "sweep" || type == "rows" || type == "summary" ||
      type == "plan")
    return "ricochet." + type;
  if (type == "scenes") return "ricochet.scene[]";
  if (type == "launch" || type == "contact" || type == "show") return "ricochet." + type + "_fields";
  return type;
}

std::string number_text(double value) { return fmt::format("{:.10g}", value); }

std::string range_text(const Range& range) {
  const bool low = range.min > any_number.min, high = range.max < any_number.max;
  std::string text;
  if (low) text = std::string(range.min_open ? "> " : ">= ") + number_text(range.min);
  if (high) text += std::string(low ? ", " : "") + (range.max_open ? "< " : "<= ") + number_text(range.max);
  return text;
}

std::string class_name(const Function& f, const std::string& of = "_fields") {
  std::string name = f.name;
  for (char& c : name)
    if (c == '.' || c == ':') c = '_';
  return "ricochet." + name + of;
}

}  // namespace

std::span<const Function> functions() {
  static const std::vector<Function> list = make();
  return list;
}

const Function& function_named(const std::string& name) {
  for (const Function& f : functions())
    if (f.name == name) return f;
  throw std::logic_error("no function is called " + name);
}

std::string editor_stubs() {
  std::string text =
      "---@meta ricochet\n-- Generated by `ricochet reference --stubs`; do not edit. For the Lua language server: "
      "names, types and meaning.\n\n"
      "---@class ricochet.body\n\n---@class ricochet.effect\n\n---@class ricochet.scene\n---@field run fun(self: "
      "ricochet.scene): table\n---@field text fun(self: ricochet.scene): string\n"
      "---@field hash fun(self: ricochet.scene): string\n\n---@class ricochet.sweep\n---@field run fun(self: "
      "ricochet.sweep): ricochet.rows\n\n"
      "---@class ricochet.plan\n---@field run fun(self: ricochet.plan): ricochet.rows\n\n"
      "---@class ricochet.summary\n---@field print fun(self: ricochet.summary)\n\n---@class ricochet.rows\n"
      "---@field summary fun(self: ricochet.rows, t: ricochet.rows_summary_fields): ricochet.summary\n---@field "
      "power_law fun(self: ricochet.rows, t: ricochet.rows_power_law_fields): table\n---@field where fun(self: "
      "ricochet.rows, columns: table): ricochet.rows\n\n"
      "local ricochet = { file = {}, theory = {} }\n\n";
  for (const Function& f : functions()) {
    if (!f.fields.empty()) {
      text += "---@class " + class_name(f) + "\n";
      for (const Field& field : f.fields) {
        const bool optional = field.optional || !field.initial.empty();
        text += "---@field " + field.name + (optional ? "? " : " ");
        if (field.choices.empty()) text += lua_type(field.type);
        for (std::size_t i = 0; i < field.choices.size(); ++i) text += (i ? "|\"" : "\"") + field.choices[i] + "\"";
        text += " " + field.doc + (field.unit.empty() ? "" : " [" + field.unit + "]") +
                (field.initial.empty() ? "" : " (default " + field.initial + ")") + "\n";
      }
    }
    if (f.example.empty() || f.name.find(':') != std::string::npos) {
      text += "\n";
      continue;
    }
    if (!f.results.empty()) text += "---@class " + class_name(f, "_result") + "\n";
    for (const Field& field : f.results)
      text += "---@field " + field.name + (field.optional ? "? " : " ") + lua_type(field.type) + " " + field.doc +
              (field.unit.empty() ? "" : " [" + field.unit + "]") + "\n";
    text += "--- " + f.doc + "\n";
    if (!f.fields.empty()) text += "---@param t " + class_name(f) + "\n";
    if (f.name == "parameters") text += "---@param t table\n";
    if (f.name == "range") text += "---@param first number\n---@param last? number\n---@param step? number\n";
    if (f.name.starts_with("file.")) text += "---@param name string\n";
    if (f.name == "file.write") text += "---@param text string\n";
    if (f.returns != "nothing")
      text += "---@return " + (f.results.empty() ? lua_type(f.returns) : class_name(f, "_result")) + "\n";
    const char* arguments = f.name == "range"        ? "first, last, step"
                            : f.name == "file.write" ? "name, text"
                            : f.name == "file.read"  ? "name"
                                                     : "t";
    text += "function ricochet." + f.name + "(" + arguments + ") end\n\n";
  }
  return text + "return ricochet\n";
}

std::string reference_page() {
  std::string text =
      "# Reference of the Lua module\n\nGenerated by `ricochet reference`; do not edit. Units: R (disk radius), m0 "
      "(mass of a node), c (reference speed); "
      "times in R/c. A field without a default must be given unless it says optional.\n\n"
      "Scripts run in a sandbox: Lua's libraries without `io`, `debug` and what of `os` is not the time; text, no "
      "bytecode; files below the run's folder, by `ricochet.file`; 2 GiB of memory; undeclared names are errors. "
      "`ricochet run SCRIPT --max-seconds S` ends the run after S seconds, impacts included, and says where it was; "
      "what its sweeps have stored stays, and `--resume` goes on. Without it a script may take as long as it likes. "
      "`--unsafe` lifts the walls.\n";
  for (const Function& f : functions()) {
    text += "\n## " + f.name + "\n\n" + f.doc + "\n";
    if (!f.example.empty()) text += "\n```lua\n" + f.example + "\n```\n";
    if (f.fields.empty()) continue;
    text += "\n| field | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
    for (const Field& field : f.fields) {
      std::string accepted = range_text(field.range);
      for (const std::string& choice : field.choices) accepted += (accepted.empty() ? "" : ", ") + choice;
      std::string type = field.type;
      for (std::size_t at = 0; (at = type.find('|', at)) != std::string::npos; at += 2) type.replace(at, 1, "\\|");
      std::string doc = field.doc;
      for (std::size_t at = 0; (at = doc.find('|', at)) != std::string::npos; at += 2) doc.replace(at, 1, "\\|");
      text += "| `" + field.name + "` | " + type + " | " + field.unit + " | " + accepted + " | " +
              (field.initial.empty() && field.optional ? "optional" : field.initial) + " | " + doc + " |\n";
    }
    if (f.results.empty()) continue;
    text += "\n| result | unit | meaning |\n|---|---|---|\n";
    for (const Field& field : f.results) {
      std::string doc = field.doc;
      for (std::size_t at = 0; (at = doc.find('|', at)) != std::string::npos; at += 2) doc.replace(at, 1, "\\|");
      text += "| `" + field.name + "` | " + field.unit + " | " + doc + (field.optional ? " (optional)" : "") + " |\n";
    }
  }
  text +=
      "\n## Integrators\n\nThe values of `method`. The limit is that of h omega for a harmonic oscillator; steps are "
      "held against it by a bound of omega. All are symplectic "
      "but the last two, controls whose energy drifts. The tests measure orders, limits and counts.\n\n"
      "| method | order | of outcomes | evaluations a step | limit | limit an evaluation | default theta | source "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const Method& m : methods())
    text += fmt::format("| `{}` | {} | {} | {} | {:.3f} | {:.3f} | {:g} | {} |\n", m.name, m.order, m.outcome_order,
                        m.evaluations(), m.stability_limit, m.stability_limit / m.evaluations(), m.usual, m.source);
  text +=
      "\n## Columns of a row\n\nBeside the sweep's own parameters, `status`, `reason`, `scene_hash`, `seed` (of the "
      "projectile) and `wall_seconds`:\n\n| column | unit | meaning |\n|---|---|---|\n";
  for (const auto& [field, value] : Outcome::fields()) {
    std::string doc = field.doc;
    for (std::size_t at = 0; (at = doc.find('|', at)) != std::string::npos; at += 2) doc.replace(at, 1, "\\|");
    text += "| `" + field.name + "` | " + field.unit + " | " + doc + " |\n";
  }
  return text;
}

}  // namespace ricochet
