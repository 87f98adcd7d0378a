// What a person sees who makes a mistake: the exact first line, the exit status, and earlier results left whole.

#include <catch2/catch.hpp>
#include <vector>

#include "script/program.hpp"

using namespace ricochet::test;

namespace {

struct Mistake {
  const char* what;
  const char* script;  // after the line that requires the module, which is line 1
  const char* first_line;
  int status = 1;
  const char* arguments = "";
};

const char* bodies =
    "local d, w = ricochet.disk { nodes = 60 }, ricochet.wall { nodes = 150, width = 4 }\n";  // line 2 where it is used

const std::vector<Mistake> mistakes{
    {"misspelt field", "local d = ricochet.disk {\n  radus = 0.05,\n}",
     "error: s.lua:3: disk: unknown field 'radus' (did you mean 'radius'?)"},
    {"misspelt function", "local d = ricochet.dsik { }",
     "error: s.lua:2: the module has no 'dsik' (did you mean 'disk'?)"},
    {"misspelt global", "local d = ricohet.disk { }",
     "error: s.lua:2: unknown name 'ricohet' (did you mean 'ricochet'?)"},
    {"assignment to a global", "disk = 3", "error: s.lua:2: 'disk' is not declared; write: local disk = ..."},
    {"string for a number", "local d = ricochet.disk { radius = 'one' }",
     "error: s.lua:2: disk: 'radius' must be a number [R], is a string ('one')"},
    {"fraction for a count", "local d = ricochet.disk { nodes = 10.5 }",
     "error: s.lua:2: disk: 'nodes' must be a whole number, is 10.5"},
    {"zero nodes", "local d = ricochet.disk { nodes = 0 }",
     "error: s.lua:2: disk: 'nodes' must be between 4 and 1e+07, is 0"},
    {"negative stiffness", "local d = ricochet.disk { stiffness = -1 }",
     "error: s.lua:2: disk: 'stiffness' must be greater than 0 m0 c^2/R^2, is -1"},
    {"not a number", "local d = ricochet.disk { roughness = 0/0 }",
     "error: s.lua:2: disk: 'roughness' must be a finite number, is nan"},
    {"infinite", "local d = ricochet.disk { roughness = math.huge }",
     "error: s.lua:2: disk: 'roughness' must be a finite number, is inf"},
    {"misspelt choice", "local d = ricochet.disk { placement = 'poison_disk' }",
     "error: s.lua:2: disk: 'placement' must be one of uniform, poisson_disk, triangular, hull, is 'poison_disk' (did "
     "you mean 'poisson_disk'?)"},
    {"positional table", "local d = ricochet.disk { 5 }",
     "error: s.lua:2: disk: takes named fields only, has the value 5 without a name"},
    {"no table", "local d = ricochet.disk(5)",
     "error: s.lua:2: disk: takes one table of named fields, e.g. ricochet.disk { nodes = 800, roughness = 0.03, seed "
     "= 7 }"},
    {"missing outline", "local b = ricochet.body { nodes = 50 }",
     "error: s.lua:2: body: 'outline' is missing: corners { {x, y}, ... } in order along the boundary; the first may "
     "close it as the last; concave is fine, crossing itself is not"},
    {"outline of two points", "local b = ricochet.body { nodes = 50, outline = { {0, 0}, {1, 0} } }",
     "error: s.lua:2: body: 'outline': needs at least 3 points, has 2"},
    {"outline that crosses itself",
     "local b = ricochet.body { nodes = 50,\n outline = { {0, 0}, {1, 1}, {1, 0}, {0, 1} } }",
     "error: s.lua:3: body: 'outline': crosses or touches itself; give its points in order along the boundary"},
    {"outline with a point twice",
     "local b = ricochet.polygon { nodes = 50,\n outline = { {0, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 0} } }",
     "error: s.lua:3: polygon: 'outline': points 2 and 3 are both (1, 0); leave one out"},
    {"outline that comes back to a point",
     "local b = ricochet.polygon { outline = { {0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1} } }",
     "error: s.lua:2: polygon: 'outline': points 3 and 6 are both (1, 1); leave one out"},
    {"negative axis", "local b = ricochet.ellipse { a = -1 }",
     "error: s.lua:2: ellipse: 'a' must be greater than 0 R, is -1"},
    {"two sides", "local b = ricochet.regular_polygon { sides = 2 }",
     "error: s.lua:2: regular_polygon: 'sides' must be between 3 and 1000, is 2"},
    {"a hole that is no list of points", "local b = ricochet.disk { holes = { {0, 0}, {1, 0}, {0, 1} } }",
     "error: s.lua:2: disk: 'holes[1]' must hold points {x, y} of finite numbers; element 1 is 0"},
    {"a hole across the outline",
     "local b = ricochet.disk { nodes = 60,\n holes = { { {0.5, 0}, {1.5, 0}, {0.5, 0.5} } } }",
     "error: s.lua:3: disk: 'holes': hole 1 crosses or touches the outline or a hole before it; move it, or make one "
     "of both"},
    {"a hole beside the body",
     "local b = ricochet.disk { holes = { { {0, 0}, {.1, 0}, {0, .1} }, { {5, 0}, {6, 0}, {5, 1} } } }",
     "error: s.lua:2: disk: 'holes': hole 2 must lie inside the outline and outside of other holes; move it"},
    {"a hole in a hole",
     "local b = ricochet.disk { holes = { { {-.5, -.5}, {.5, -.5}, {0, .5} }, { {-.1, -.1}, {.1, -.1}, {0, .1} } } }",
     "error: s.lua:2: disk: 'holes': hole 2 must lie inside the outline and outside of other holes; move it"},
    {"a hole with a point twice", "local b = ricochet.disk { holes = { { {0, 0}, {.1, 0}, {.1, 0}, {0, .1} } } }",
     "error: s.lua:2: disk: 'holes': hole 1: points 2 and 3 are both (0.1, 0); leave one out"},
    {"nodes given beside their number", "local b = ricochet.disk { points = { {0, 0} },\n nodes = 50 }",
     "error: s.lua:3: disk: 'nodes': give points or nodes, not both"},
    {"a node outside", "local b = ricochet.disk { points = { {0, 0}, {0, 1.5} } }",
     "error: s.lua:2: disk: 'points': point 2 at (0, 1.5) lies outside of the body; leave it out, or move it"},
    {"a node twice", "local b = ricochet.disk { points = { {0, 0}, {0, .5}, {0, 0} } }",
     "error: s.lua:2: disk: 'points': point 3 at (0, 0) is point 1 again; leave one out"},
    {"a rim without a corner", "local b = ricochet.rectangle { points = { {0, 0}, {0, .5}, {0.5, 0.5} } }",
     "error: s.lua:2: rectangle: 'points': some lie on the outline, but none at its corner (-1, -0.5); give one there, "
     "or none on the outline"},
    {"a rim finer than the nodes", "local b = ricochet.disk {\n  rim_spacing = 1e-9 }",
     "error: s.lua:3: disk: 'rim_spacing': 1e-09 would take 6.283e+09 nodes on the rim; raise it, or nodes"},
    {"a rim of more nodes than there are", "local b = ricochet.disk { rim_spacing = 6e-3 }",
     "error: s.lua:2: disk: 'rim_spacing': 0.006 would take 1047 nodes on the rim; raise it, or nodes"},
    {"a rim too coarse for its outline", "local b = ricochet.disk { rim_spacing = 3 }",
     "error: s.lua:2: disk: 'rim_spacing': 3 is too long to follow an outline of length 6.283; lower it"},
    {"a needle", "local b = ricochet.ellipse { a = 1e-9, b = 1e9 }",
     "error: s.lua:2: ellipse: 'nodes': 800 nodes cannot cover this outline, which needs *"},
    {"a margin without room", "local b = ricochet.disk { nodes = 60, margin = 1.1, placement = 'poisson_disk' }",
     "error: s.lua:2: disk: 'margin': 1.1 leaves no room inside the rim; lower it"},
    {"a margin of a rigid body", "local b = ricochet.disk { interior = 'rigid', margin = 0.1 }",
     "error: s.lua:2: disk: 'margin': says nothing of a rigid body, inside which nothing moves; leave it out"},
    {"a wall that flies", "local b = ricochet.wall { nodes = 100,\n velocity = {0, 1} }",
     "error: s.lua:3: wall: 'velocity': an anchored body stays where it is; leave it out, or anchor nothing"},
    {"modes of a body of springs", "local b = ricochet.disk { modes = 30 }",
     "error: s.lua:2: disk: 'modes': is of a body of modes; give interior = \"modes\" too"},
    {"modes of a body of revolution",
     "local b = ricochet.disk { interior = 'modes', E = 1, nu = 0.3, state = 'axisymmetric' }",
     "error: s.lua:2: disk: 'interior': modes are of bodies in the plane, and this one is axisymmetric; take elements"},
    {"a rigid body that spins", "local b = ricochet.disk { interior = 'rigid', spin = 1 }",
     "error: s.lua:2: disk: 'spin': a rigid body stays where it is; leave it out, or take interior springs"},
    {"a velocity of three numbers", "local b = ricochet.disk { velocity = {0, 1, 2} }",
     "error: s.lua:2: disk: 'velocity': must be {vx, vy}, has 3 numbers"},
    {"a projectile with a velocity of its own",
     "local b = ricochet.disk { nodes = 60, velocity = {0, 1} }\nricochet.scene { projectile = b, target = b }",
     "error: s.lua:3: scene: 'projectile': has a velocity or spin of its own, which only a target has; say them in "
     "launch instead"},
    {"a turned plane", "local b = ricochet.rotated { body = ricochet.plane {},\n angle = 3 }",
     "error: s.lua:2: rotated: 'body': a plane cannot be turned; take a wide rectangle with interior = \"rigid\""},
    {"a turn of no body", "local b = ricochet.rotated { body = 3, angle = 3 }",
     "error: s.lua:2: rotated: 'body' must be a body (from ricochet.disk, ricochet.wall, ricochet.body or another "
     "shape), is 3"},
    {"nodes by hand made finer",
     "local b = ricochet.disk { points = { {0, 0}, {0.5, 0}, {0, 0.5} } }\nricochet.accuracy { methods = { 'verlet' }, "
     "lattices = { 2, 4 }, steps = { 1e-3 },\n  scene = ricochet.scene { projectile = b, target = ricochet.plane {} } "
     "}",
     "error: s.lua:3: nodes that were given one by one cannot be made finer; give other points"},
    {"rough rim that crosses itself", "local d = ricochet.disk { nodes = 400,\n  roughness = 1 }",
     "error: s.lua:3: disk: 'roughness': the rough rim crosses itself (roughness 1, seed 1); lower the roughness or "
     "take another seed, as crossing = \"pass_over\" does"},
    {"stiffness function without a value", "local d = ricochet.disk { nodes = 60, stiffness = function(x, y) end }",
     "error: s.lua:2: disk: 'stiffness': the function must return a positive number, gave nil at (1, 0)"},
    {"nu by place that no body has",
     "local function nu(x, y) return x > 0.99 and 0.5 or 0.3 end\nlocal d = ricochet.disk { nodes = 60,\n"
     "  interior = 'elements', E = 1, nu = nu }",
     "error: s.lua:4: disk: 'nu': the function must return a number between -1 and 0.5, without these, gave 0.5 at (1, "
     "0)"},
    {"everything anchored", "local d = ricochet.disk { nodes = 60, anchored = function(x, y) return true end }",
     "error: s.lua:2: disk: 'anchored': holds every node; nothing could move: give interior = \"rigid\" instead"},
    {"anchored projectile",
     "local w = ricochet.wall { nodes = 150 }\nlocal s = ricochet.scene { projectile = w, target = w }",
     "error: s.lua:3: scene: 'projectile': must be free, but this body has anchored nodes"},
    {"number for a body", "local s = ricochet.scene { projectile = 3, target = 4 }",
     "error: s.lua:2: scene: 'projectile' must be a body (from ricochet.disk, ricochet.wall, ricochet.body or "
     "another shape), is 3"},
    {"misspelt field of an inner table",
     "local s = ricochet.scene { projectile = d, target = w,\n launch = {\n  spede = 1 } }",
     "error: s.lua:5: scene: launch: unknown field 'spede' (did you mean 'speed'?)"},
    {"two ways to say the angle",
     "local s = ricochet.scene { projectile = d, target = w,\n launch = { psi1 = 1, angle = 3 } }",
     "error: s.lua:4: scene: 'angle': give psi1 or angle, not both"},
    {"misspelt method", "local s = ricochet.scene { projectile = d, target = w, method = 'verlett' }",
     "error: s.lua:3: scene: 'method' must be one of auto, pefrl, forest_ruth, verlet, takahashi_imada, chin_4a, "
     "mclachlan_sb3a4, blanes_moan_s6, blanes_moan_srkn6b, okunbor_skeel_13, blanes_moan_srkn11b, blanes_moan_srkn14a, "
     "multirate_2, multirate_3, multirate_5, multirate_8, rk4, dop853, is 'verlett' (did you mean 'verlet'?)"},
    {"overlapping bodies",
     "local s = ricochet.scene { projectile = d, target = w,\n  launch = { height = -0.5 } }\ns:run()",
     "error: s.lua:4: scene: 'height': the bodies overlap at the start (rims *"},
    {"unknown method of a scene", "local s = ricochet.scene { projectile = d, target = w }\ns:runn()",
     "error: s.lua:4: a scene has no 'runn' (did you mean 'run'?)"},
    {"sweep that returns no scene", "ricochet.sweep { name = 'x', over = { a = {1} }, scene = function(at) end }:run()",
     "error: s.lua:2: scene: the function returned nothing; it must return a scene (is a 'return' missing?)"},
    {"sweep over nothing", "ricochet.sweep { name = 'x', over = {}, scene = function(at) end }",
     "error: s.lua:2: sweep: 'over' is empty; give at least one name = list of values"},
    {"sweep over an outcome", "ricochet.sweep { name = 'x', over = { omega = {1} }, scene = function(at) end }",
     "error: s.lua:2: sweep: over.omega: 'omega' is a column of the outcome; take another name"},
    {"a reach beyond the smallest number",
     "ricochet.scene { projectile = d, target = w,\n  contact = { xi = 300, reach = 3 } }:run()",
     "error: s.lua:4: scene: 'contact': xi reach = 900 is beyond exp(-700), the smallest number there is; lower reach "
     "to 2.33333 R or less"},
    {"launch field beside launch", "local s = ricochet.scene { projectile = d, target = w,\n  speed = 0.2 }",
     "error: s.lua:4: scene: unknown field 'speed' (it belongs in launch = { speed = ... })"},
    {"scene field in launch",
     "local s = ricochet.scene { projectile = d, target = w, launch = {\n  method = 'verlet' } }",
     "error: s.lua:4: scene: launch: unknown field 'method' (it belongs in the scene itself, beside this table)"},
    {"colon for a dot", "ricochet:animate { scene = 1 }",
     "error: s.lua:2: animate: is called with a dot, not a colon: ricochet.animate { ... }"},
    {"dot for a colon", "ricochet.sweep { name = 'x', over = { a = {1} },\n  scene = function(at) end }.run()",
     "error: s.lua:2: run: is a method of a sweep: write sweep:run(), with a colon"},
    {"plot of a sweep that has not run",
     "ricochet.plot { x = 'psi1', y = {'e'}, name = 'p',\n  rows = ricochet.sweep { name = 'x', over = { a = {1} }, "
     "scene = function(at) end } }",
     "error: s.lua:3: plot: 'rows' must be rows (from sweep:run()), is a sweep; run it first"},
    {"over at its own line", "ricochet.sweep { name = 'x',\n  scene = function(at) end,\n  over = {\n    a = 3 } }",
     "error: s.lua:5: sweep: over.a must be a list of values that is not empty, is 3"},
    {"misspelt column of a row",
     "local s = ricochet.scene { projectile = d, target = w, time_limit = 0.1 }\nlocal row = "
     "s:run()\nprint(row.indentaton)",
     "error: s.lua:5: a row has no column 'indentaton' (did you mean 'indentation'?)"},
    {"caught and raised again", "local fine, message = pcall(ricochet.disk, { nodes = 0 })\nerror(message, 0)",
     "error: s.lua:2: disk: 'nodes' must be between 4 and 1e+07, is 0"},
    {"a default outside its own range", "local p = ricochet.parameters {\n  samples = { 0, int = true, min = 1 } }",
     "error: s.lua:3: parameters: 'samples': the default 0 is outside its own range, at least 1"},
    {"memory without end", "local t = {}\nfor i = 1, 1e9 do t[i] = {\n  ('x'):rep(1000000) .. i } end",
     "error: s.lua:4: the script needs more than 2 GiB of memory; look for a table or string that grows without end, "
     "or recursion without end"},
    {"more frames than steps",
     "ricochet.animate { scene = ricochet.scene { projectile = d, target = w },\n  frames = 100000 }",
     "error: s.lua:4: animate: 'frames': 100000 frames in *"},
    {"no time", "print(1)", "error: --max-seconds: 0 is no number of 0.001 to 1e+09; see ricochet --help", 2,
     "--max-seconds 0"},
    {"no folder", "print(1)", "error: --out needs a folder", 2, "--out ''"},
    {"a name outside the folder", "ricochet.file.write('../e.txt', 'x')",
     "error: s.lua:2: '../e.txt' is no name below the run's folder; give a relative name without '..'"},
    {"misspelt library function", "print(string.fromat('x'))",
     "error: s.lua:2: string has no 'fromat' (did you mean 'format'?)"},
    {"misspelt module", "local x = require 'richochet'",
     "error: s.lua:2: require: there is no module 'richochet' in the library or beside the script (did you mean "
     "'ricochet'?)"},
    {"text without quotes", "local d = ricochet.disk { placement = poisson_disk }",
     "error: s.lua:2: unknown name 'poisson_disk' (if the text is meant, write \"poisson_disk\")"},
    {"summary of a sweep that has not run",
     "local s = ricochet.sweep { name = 'x', over = { a = {1} }, scene = function(at) end }\ns:summary { by = 'a', of "
     "= {'e'} }",
     "error: s.lua:3: this sweep has not run: rows come from sweep:run()"},
    {"string for a list", "ricochet.plot { rows = {{}}, x = 'a', y = 'e', name = 'p' }",
     "error: s.lua:2: plot: 'y' must be a list of strings { \"...\", ... }, is a string ('e')"},
    {"values beside over", "ricochet.sweep { name = 'x', psi1 = {1}, scene = function(at) end }",
     "error: s.lua:2: sweep: unknown field 'psi1' (what varies belongs in over = { psi1 = { ... } })"},
    {"spaces around =", "print(1)", "error: '=': write name=value without spaces around '='", 2, "speed = 3"},
    {"dashes before a parameter", "print(1)",
     "error: The following argument was not expected: --samples=2 (a parameter of the script is written samples=2, "
     "without dashes); see ricochet --help",
     2, "--samples=2"},
    {"misspelt option", "print(1)",
     "error: The following argument was not expected: --thread (did you mean '--threads'?); see ricochet --help", 2,
     "--thread 2"},
    {"a parameter twice", "local p = ricochet.parameters { speed = 1 }", "error: parameter 'speed' is given twice", 2,
     "speed=1 speed=2"},
    {"misspelt parameter in the script",
     "local p = ricochet.parameters { nodes = 100 }\nlocal d = ricochet.disk { nodes = p.node }",
     "error: s.lua:3: the table of parameters has no 'node' (did you mean 'nodes'?)"},
    {"two sweeps of one name",
     "for i = 1, 2 do ricochet.sweep { name = 's', over = { a = {1} }, scene = function() return ricochet.scene { "
     "projectile = d, target = w } end }:run() end",
     "error: s.lua:3: run: a sweep called 's' has run already and its results would be replaced; give this one another "
     "name",
     1, "--quiet"},
    {"an immense outline", "local b = ricochet.body { nodes = 50, outline = { {0, 0}, {1e200, 0}, {0, 1e200} } }",
     "error: s.lua:2: body: 'outline': encloses an area of inf R^2; scale it to lie between 1e-100 and 1e100"},
    {"sweep over a number", "ricochet.sweep { name = 'x', over = { a = 3 }, scene = function(at) end }",
     "error: s.lua:2: sweep: over.a must be a list of values that is not empty, is 3"},
    {"misspelt value of a sweep",
     "ricochet.sweep { name = 'x', over = { psi1 = {1} }, scene = function(at) return at.psi end }:run()",
     "error: s.lua:2: 'over' has no 'psi' (did you mean 'psi1'?)"},
    {"syntax error", "local d = = 3", "error: s.lua:2: unexpected symbol near '='"},
    {"a step and a theta", "local s = ricochet.scene { projectile = d, target = w,\n  step = 0.001, theta = 1 }",
     "error: s.lua:4: scene: 'theta': give step or theta, not both"},
    {"a theta beyond the limit", "ricochet.scene { projectile = d, target = w,\n  theta = 3 }:run()",
     "error: s.lua:4: scene: 'theta': 3 is unstable: pefrl needs a theta below 2.989 here (node *"},
    {"misspelt keyword", "retrun ricochet",
     "error: s.lua:2: syntax error near 'ricochet' (did you mean 'return' for 'retrun'?)"},
    {"misspelt local", "loacl x = 3", "error: s.lua:2: syntax error near 'x' (did you mean 'local' for 'loacl'?)"},
    {"misspelt function", "local f = fucntion(x)\n  return x\nend",
     "error: s.lua:4: <eof> expected near 'end' (did you mean 'function' for 'fucntion' in line 2?)"},
    {"a comma left out", "local d = ricochet.disk {\n  nodes = 60\n  seed = 1\n}",
     "error: s.lua:4: '}' expected (to close '{' at line 2) near 'seed' (is a comma missing before it?)"},
    {"a bracket left out", "for i = 1, 2 do\n  local d = ricochet.disk {\n    nodes = 60\nend",
     "error: s.lua:5: '}' expected (to close '{' at line 3) near 'end' (is a bracket missing before it?)"},
    {"a quote left out", "local t = { \"e, \"mu\" }",
     "error: s.lua:2: '}' expected near 'mu' (is a quote missing in this line?)"},
    {"a list in square brackets", "local t = { psi1 = [ 0, 1 ] }",
     "error: s.lua:2: unexpected symbol near '[' (lists are written { ... })"},
    {"a long table in square brackets", "local t = { [0, 1] }",
     "error: s.lua:2: ']' expected near ',' (lists are written { ... })"},
    {"a bracket left open before end", "local f = function()\n  local d = ricochet.disk {\n    nodes = 60,\nend",
     "error: s.lua:5: unexpected symbol near 'end' (is the '{' of line 3 closed?)"},
    {"a point that is none", "local b = ricochet.body { nodes = 50, outline = { {0, 0}, {1, 0}, {1, 'h'} } }",
     "error: s.lua:2: body: 'outline' must hold points {x, y} of finite numbers; element 3 has y = a string ('h')"},
    {"a letter for a digit", "local x = 1O", "error: s.lua:2: malformed number near '1O'"},
    {"a letter for zero", "local x = { O, 1 }", "error: s.lua:2: unknown name 'O' (did you mean the digit 0?)"},
    {"misspelt modulus",
     "print(ricochet.elasticity { body = ricochet.body { nodes = 200, outline = { {0, 0}, {1, 0}, {1, 4}, {0, 4} } } "
     "}.Nu)",
     "error: s.lua:2: the table of moduli has no 'Nu' (did you mean 'nu'?)"},
    {"misspelt effect", "local g = ricochet.gravty { g = 1 }",
     "error: s.lua:2: the module has no 'gravty' (did you mean 'gravity'?)"},
    {"misspelt field of an effect", "local g = ricochet.gravity { G = 1, on = 'projectile' }",
     "error: s.lua:2: gravity: unknown field 'G' (did you mean 'g'?)"},
    {"an effect without its list",
     "ricochet.scene { projectile = d, target = w,\n  effects = ricochet.gravity { g = 1 } }",
     "error: s.lua:4: scene: 'effects' must be a list of effects, e.g. { ricochet.gravity { g = 1e-4 } }, is an "
     "effect"},
    {"a number among effects", "ricochet.scene { projectile = d, target = w,\n  effects = { gravity = 1 } }",
     "error: s.lua:4: scene: 'effects' must be a list of effects, e.g. { ricochet.gravity { g = 1e-4 } }, holds "
     "gravity = 1"},
    {"nothing among effects",
     "ricochet.scene { projectile = d, target = w,\n  effects = { ricochet.drag { rate = 1 }, nil, ricochet.gravity { "
     "g = 1 } } }",
     "error: s.lua:4: scene: 'effects' has nothing (nil) at place 2; leave that place out"},
    {"anchors damped and moved",
     "ricochet.scene { projectile = d, target = w,\n  effects = { ricochet.absorbing { width = 1, rate = 1 }, "
     "ricochet.moving_anchor { amplitude = 1, omega = 1 } } }",
     "error: s.lua:4: scene: 'effects': absorbing damps against a wall at rest, and moving_anchor moves it; name one "
     "of them"},
    {"prestress beyond the yield",
     "ricochet.scene { projectile = ricochet.disk { nodes = 60, prestress = 0.02 }, target = ricochet.wall { nodes = "
     "150 },\n  effects = { ricochet.plastic { yield = 1e-3 } } }:run()",
     "error: s.lua:3: scene: 'effects': plastic: prestress strains a spring of the projectile by *"},
    {"accuracy of a method that an effect lowers",
     "ricochet.accuracy { scene = ricochet.scene { projectile = d, target = w, effects = { ricochet.drag { rate = 1 } "
     "} },\n  methods = { 'pefrl' } }",
     "error: s.lua:4: accuracy: 'methods': pefrl of order 4 would fall to order 2 beside drag; give verlet or leave "
     "method out"},
    {"a high order beside damping",
     "ricochet.scene { projectile = d, target = w,\n  method = 'pefrl', effects = { ricochet.damping { time = 1e-3 } } "
     "}",
     "error: s.lua:4: scene: 'method': pefrl of order 4 would fall to order 2 beside damping; give verlet or leave "
     "method out"},
    {"an effect twice",
     "ricochet.scene { projectile = d, target = w,\n  effects = { ricochet.drag { rate = 1 }, ricochet.drag { rate = "
     "2, on = 'both' } } }",
     "error: s.lua:4: scene: 'effects': drag is named twice for the same body; name it once, or once for each body"},
    {"two laws of springs",
     "ricochet.scene { projectile = d, target = w,\n  effects = { ricochet.plastic { yield = 1 }, ricochet.breaking { "
     "strain = 1 } } }",
     "error: s.lua:4: scene: 'effects': plastic and breaking are both laws of a body's springs; name one of them for a "
     "body"},
    {"moving anchors of a free body",
     "ricochet.scene { projectile = d, target = d,\n  effects = { ricochet.moving_anchor { amplitude = 1, omega = 1 } "
     "} }:run()",
     "error: s.lua:4: scene: 'effects': moving_anchor needs a target with anchored nodes, and this one is free"},
    {"adhesion beyond the reach",
     "ricochet.scene { projectile = d, target = w,\n  effects = { ricochet.adhesion { strength = 1, xi = 100 } } "
     "}:run()",
     "error: s.lua:4: scene: 'effects': adhesion: xi reach = 10 cuts the attraction at more than exp(-20); raise "
     "contact.reach to 0.2 or more"},
    {"adhesion stronger than repulsion",
     "ricochet.scene { projectile = d, target = w,\n  effects = { ricochet.adhesion { strength = 1, xi = 400 } } "
     "}:run()",
     "error: s.lua:4: scene: 'effects': adhesion: xi = 400 must be below the contact's, 300, or the rims would be "
     "drawn into one another"},
    {"a field of an effect", "ricochet.plastic {\n  yeild = 1 }",
     "error: s.lua:3: plastic: unknown field 'yeild' (did you mean 'yield'?)"},
    {"an effect's body", "ricochet.plastic {\n  yield = 1, on = 'wall' }",
     "error: s.lua:3: plastic: 'on' must be one of projectile, target, both, is 'wall'"},
    {"another language's comparison", "if 1 != 2 then end",
     "error: s.lua:2: 'then' expected near '!' (Lua writes ~= for 'differs from', and not for the negation)"},
    {"another language's sum", "local x = 1\nx += 1",
     "error: s.lua:3: syntax error near '+' (Lua has no +=; write x = x + ...)"},
    {"misspelt local name", "local wall = 3\nprint(wal)", "error: s.lua:3: unknown name 'wal' (did you mean 'wall'?)"},
    {"misspelt truth", "local x = ture", "error: s.lua:2: unknown name 'ture' (did you mean 'true'?)"},
    {"two names equally near", "print(math.tann(1))",
     "error: s.lua:2: math has no 'tann' (did you mean 'tan' or 'tanh'?)"},
    {"a method no summary has",
     "local rows = ricochet.sweep { name = 's', over = { a = {1} }, scene = function() return ricochet.scene { "
     "projectile = d, target = w } end }:run()\nrows:summary { by = 'a', of = { 'e' } }:pritn()",
     "error: s.lua:4: a summary has no 'pritn' (did you mean 'print'?)", 1, "--quiet"},
    {"Lua's own error", "local x = nil\nprint(x.y)", "error: s.lua:3: attempt to index a nil value (local 'x')"},
    {"missing module", "require 'no_such'",
     "error: s.lua:2: require: there is no module 'no_such' in the library or beside the script"},
    {"module outside", "require '../x'",
     "error: s.lua:2: require: '../x' is no module name; give letters, digits, _ and - with dots between them"},
    {"a loop without end", "while true do end", "error: script stopped: --max-seconds 1 reached at s.lua*", 1,
     "--max-seconds 1"},
    {"a finalizer, which no hook can end", "setmetatable({}, { __gc = function() while true do end end })",
     "error: s.lua:2: setmetatable: __gc is not for scripts (--unsafe lifts this)"},
    {"a shell command", "os.execute 'true'", "error: s.lua:2: os has no 'execute'"},
    {"io", "io.open 'x'",
     "error: s.lua:2: unknown name 'io' (files are below the run's folder, through ricochet.file)"},
    {"a file outside the run's folder", "ricochet.file.write('../x', 'y')",
     "error: s.lua:2: '../x' is no name below the run's folder; give a relative name without '..'"},
    {"unknown parameter", "local p = ricochet.parameters { speed = 0.1 }",
     "error: unknown parameter 'sped' (did you mean 'speed'?)", 1, "sped=0.2"},
    {"parameter out of range", "local p = ricochet.parameters { speed = { 0.1, min = 0, unit = 'c' } }",
     "error: parameter 'speed' must be a number [c], at least 0, is '-1'", 1, "speed=-1"},
    {"parameter of the wrong type", "local p = ricochet.parameters { n = { 3, int = true, doc = 'count' } }",
     "error: parameter 'n' must be a whole number, is 'many' (count)", 1, "n=many"},
    {"parameters nobody declared", "local x = 1", "error: s.lua declares no parameters, but was given 'n=3'", 1, "n=3"},
    {"an argument that is no parameter", "local x = 1",
     "error: 'fast' is neither an option nor name=value; see ricochet run --help", 2, "fast"},
    {"impossible picture",
     "ricochet.animate { scene = ricochet.scene { projectile = d, target = w },\n  size = { 0, 100 } }",
     "error: s.lua:4: animate: 'size': a picture has 16 x 16 to 7680 x 4320 pixels, not 0 x 100"},
    {"unknown column",
     "local rows = ricochet.sweep { name = 's', over = { a = {1} }, scene = function() return ricochet.scene { "
     "projectile = d, target = w } end }:run()\nrows:summary { by = 'a', of = { 'betta' } }",
     "error: s.lua:4: summary: the rows have no column 'betta' (did you mean 'beta'?)", 1, "--quiet"},
    {"unstable step", "ricochet.scene { projectile = d, target = w,\n  step = 1 }:run()",
     "error: s.lua:4: scene: 'step': 1 R/c is unstable: pefrl needs a step below *", 1},
};

}  // namespace

TEST_CASE("every mistake is reported by its exact first line and exit status") {
  for (const Mistake& mistake : mistakes) {
    const Workplace here;
    const std::string text = mistake.script;
    const bool uses_bodies = text.find("projectile = d") != std::string::npos;
    const Ended ended =
        here.script(std::string("local ricochet = require \"ricochet\"\n") + (uses_bodies ? bodies : "") + text + "\n",
                    mistake.arguments);
    INFO(mistake.what << "\n" << ended.err);
    // A star ends a message whose numbers depend on the lattice.
    const std::string expected = mistake.first_line;
    if (expected.ends_with("*"))
      CHECK(ended.first_line().starts_with(expected.substr(0, expected.size() - 1)));
    else
      CHECK(ended.first_line() == expected);
    CHECK(ended.status == mistake.status);
  }
}

TEST_CASE("a lattice whose springs find no balance is reported at its scene, whoever builds it") {
  const std::string sweep =
      "ricochet.sweep { name = 'x', over = { psi1 = { 0, 1 } }, scene = function(at) return s end }:run()";
  for (const auto& [more, call, where] : {std::array<std::string, 3>{"", "s:run()", ""},
                                          {"", sweep, " (at psi1 = 0)"},
                                          {", accuracy = 1e-3", sweep, " (at psi1 = 0)"},
                                          {"", "ricochet.accuracy { scene = s }", ""},
                                          {"", "ricochet.animate { scene = s, frames = 2 }", ""}}) {
    const Workplace here;
    const Ended ended = here.script(
        "local ricochet = require \"ricochet\"\nlocal s = ricochet.scene { projectile = ricochet.disk { nodes = 200, "
        "placement = 'uniform', roughness = 0.02, prestress = 0.05 }, target = ricochet.wall { nodes = 150 }" +
        more + " }\n" + call);
    INFO(call << "\n" << ended.err);
    CHECK(ended.status == 1);
    CHECK(ended.first_line() ==
          "error: s.lua:2: scene: 'prestress': 0.05 is too much for this lattice (200 nodes, seed 1): the springs find "
          "no balance near their places; lower it or take another seed" +
              where);
  }
}

TEST_CASE("all mistakes of a table are reported together, each at its line, with carets and the valid fields") {
  const Workplace here;
  const Ended ended = here.script(
      "local ricochet = require \"ricochet\"\nlocal d = ricochet.disk {\n  radus = 0.05,\n  seed = -1,\n}\n");
  CHECK(
      ended.err ==
      "error: s.lua:3: disk: unknown field 'radus' (did you mean 'radius'?)\n    3 |   radus = 0.05,\n      |   ^^^^^\n"
      "error: s.lua:4: disk: 'seed' must be between 0 and 9.0072e+15, is -1\n    4 |   seed = -1,\n      |   ^^^^\n"
      "  valid fields: E, anchored, angle, crossing, density, fine_at, fine_within, grade, h_max, h_min, holes, "
      "interior, law, margin, mass, material, mesh, modes, modes_of, nodes, nu, placement, points, prestress, quartic, "
      "radius, rim_spacing, roughness, seed, spin, state, stiffness, thickness, triangulation, velocity\n");
}

TEST_CASE("a mistake in a sweep's scene names the values it was made with, caught errors do not") {
  const Workplace here;
  const Ended ended = here.script(
      "local ricochet = require \"ricochet\"\nlocal s = ricochet.sweep { name = 's', over = { nodes = {60, 0}, "
      "placement = {'uniform'} }, scene = function(at)\n"
      "  local d = ricochet.disk { nodes = at.nodes, placement = at.placement }\n  return ricochet.scene { projectile "
      "= d, target = ricochet.wall { nodes = 150, width = 4 } } end }\n"
      "pcall(s.run, s)\nlocal ok, told = pcall(error, 'x')\nassert(told == 'x')\ns:run()\n");
  CHECK(ended.err ==
        "error: s.lua:3: disk: 'nodes' must be between 4 and 1e+07, is 0\n    3 |   local d = ricochet.disk { nodes = "
        "at.nodes, placement = at.placement }\n      |                             ^^^^^\n"
        "  in the sweep at nodes = 0, placement = 'uniform'\n");
  const Ended own = here.script(
      "local ricochet = require \"ricochet\"\nricochet.sweep { name = 's', over = { a = {1} }, scene = function(at)\n  "
      "return nothing.x end }:run()\n");
  CHECK(own.err ==
        "error: s.lua:3: unknown name 'nothing'\n    3 |   return nothing.x end }:run()\n  in the sweep at a = 1\n");
}

TEST_CASE("mistakes outside the script name the file and the remedy") {
  const Workplace here;
  here.write("drop.lua", "print 'ran'");
  Ended ended = here.run("dorp.lua");
  CHECK(ended.first_line() == "error: there is no script dorp.lua (did you mean 'drop.lua'?)");
  CHECK(ended.status == 4);
  ended = here.run("");
  CHECK(ended.first_line() == "error: run needs a script: ricochet run SCRIPT [name=value ...]");
  CHECK(ended.status == 2);
  ended = here.shell("ricochet rnu drop.lua");
  CHECK_THAT(ended.first_line(), Catch::Matchers::Contains("(did you mean 'run'?)"));
  CHECK(ended.status == 2);
  ended = here.run("drop.lua --resume --force");
  CHECK(ended.status == 2);
  here.write("out/drop", "a file");
  ended = here.run("drop.lua");
  CHECK(ended.first_line() == "error: out/drop is a file; give another folder with --out");
  CHECK(ended.status == 4);
  here.write("broken.h5", "not HDF5");
  ended = here.shell("ricochet info broken.h5");
  CHECK(ended.first_line() ==
        "error: broken.h5 is no file of ricochet's (it begins without a seal), or its beginning is damaged; restore it "
        "from a copy, or remove it, or run the script that wrote it again with --force or another --out");
  CHECK(ended.status == 4);
  here.write("b.lua", std::string("\x1bLua", 4));
  CHECK(here.run("b.lua").first_line() == "error: b.lua: bytecode is not accepted; give the script's text");
}

TEST_CASE("existing results are neither overwritten nor lost by a mistake") {
  const Workplace here;
  REQUIRE(here.script(small_sweep, "samples=1 --quiet").status == 0);
  const std::string before = here.read("out/s/results.h5");
  Ended ended = here.script(small_sweep, "samples=1");
  CHECK(
      ended.first_line() ==
      "error: out/s already holds results; --resume continues them, --force replaces them, --new leaves them and goes "
      "to out/s-2");
  CHECK(ended.status == 4);
  CHECK_THAT(here.run("s.lua sampels=2").first_line(),
             Catch::Matchers::StartsWith("error: unknown parameter 'sampels' (did you mean 'samples'?)"));
  CHECK(here.script(std::string(small_sweep).replace(0, 5, "lcoal"), "samples=1 --force").status == 1);
  CHECK(here.run("s.lua samples=many --force").status == 1);
  CHECK(here.read("out/s/results.h5") == before);
  // Rows of another sweep would be lost by --resume: refused.
  std::string other = small_sweep;
  other.replace(other.find("{ 0, 1, 4 }"), 11, "{ 2 }");
  ended = here.script(other, "samples=1 --resume");
  CHECK_THAT(ended.first_line(),
             Catch::Matchers::Contains("rows of other scenes than this sweep's, which --resume would lose"));
  CHECK(ended.status == 4);
  CHECK(here.read("out/s/results.h5") == before);
  CHECK(here.script(small_sweep, "samples=1 --quiet --force").status == 0);
}

TEST_CASE("a sweep of which nothing finishes exits with 3") {
  const Workplace here;
  std::string text = small_sweep;
  text.replace(text.find("launch ="), 0, "time_limit = 0.5, ");
  const Ended ended = here.script(text, "samples=1 --quiet");
  CHECK(ended.status == 3);
  CHECK_THAT(ended.first_line(), Catch::Matchers::Matches(
                                     "error: not one impact finished; the first ended out_of_time: the bodies had not "
                                     "parted after 0.[56][0-9]* R/c; raise time_limit, or end at the first parting.*"));
}

TEST_CASE("a scene that does not finish on its own exits with 3 as well") {
  const Workplace here;
  const Ended ended = here.script(
      "local ricochet = require 'ricochet'\nricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = "
      "ricochet.wall { nodes = 150, width = 4 }, time_limit = 0.1 }:run()");
  CHECK(ended.status == 3);
}

TEST_CASE("a control that is not symplectic runs, with one warning") {
  const Workplace here;
  const Ended ended = here.script(
      "local ricochet = require 'ricochet'\nfor i = 1, 2 do ricochet.scene { projectile = ricochet.disk { nodes = 60 "
      "}, target = ricochet.wall { nodes = 150, width = 4 }, method = 'rk4' }:run() end");
  CHECK(ended.err == "warning: rk4 is a control: it is not symplectic, so the energy of an impact drifts for good\n");
  CHECK(ended.status == 0);
}

TEST_CASE("scenes that are one and the same are not taken for independent samples in silence") {
  const Workplace here;
  std::string text = small_sweep;
  for (std::size_t at; (at = text.find("seed = at.sample")) != std::string::npos;) text.replace(at, 16, "seed = 1");
  const Ended ended = here.script(text, "--quiet");
  CHECK(ended.status == 0);
  CHECK(ended.first_line() ==
        "warning: s: 9 of 12 scenes repeat another one exactly, so they are no samples of their own; does every name "
        "of 'over' reach the scene, and at.sample as its seed?");
}

TEST_CASE("two runs do not write into one folder at a time") {
  const Workplace here;
  here.write("s.lua", small_sweep);
  const Ended both = here.shell(
      "ricochet run s.lua samples=40 --quiet >/dev/null 2>first.txt & while [ ! -d out/s ]; do sleep 0.01; done; sleep "
      "0.1; ricochet run s.lua samples=40 --quiet --resume; s=$?; wait; exit $s");
  CHECK(both.status == 4);
  CHECK(both.first_line() ==
        "error: another run is writing into out/s; wait for its end, or give another folder with --out");
  CHECK(here.read("first.txt").empty());
  CHECK(here.run("s.lua samples=40 --quiet --resume").status == 0);
}

TEST_CASE(
    "a shorter sequence leaves no frames of an earlier, longer one behind, and info knows a trajectory by its "
    "content") {
  const Workplace here;
  const std::string text =
      "local ricochet = require 'ricochet'\nlocal p = ricochet.parameters { frames = 6 }\n"
      "local scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, "
      "width = 4 } }\n"
      "ricochet.animate { scene = scene, frames = p.frames, size = {64, 48} }\nricochet.record { scene = scene, frames "
      "= 5, out = 'path' }\n";
  REQUIRE(here.script(text).status == 0);
  CHECK(fs::exists(here.path / "out/s/frames/000005.png"));
  REQUIRE(here.script(text, "frames=3 --resume").status == 0);
  CHECK(fs::exists(here.path / "out/s/frames/000002.png"));
  CHECK_FALSE(fs::exists(here.path / "out/s/frames/000003.png"));
  const Ended info = here.shell("ricochet info out/s/path.h5");
  CHECK(info.status == 0);
  CHECK_THAT(info.out, Catch::Matchers::Contains("a trajectory (H5MD)"));
}

TEST_CASE("the sandbox holds") {
  const Workplace here;
  const Ended ended = here.script(R"(local ricochet = require "ricochet"
print(pcall(function() return string.dump(print) end))
print(load("\27Lua"))
print(getmetatable(""), getmetatable(_G))
print(pcall(function() local s = "x" while true do s = s .. s end end))
print(math.random(1000))
print((select(2, xpcall(function(a, b) return a + b end, print, 1, 2))), (select(2, xpcall(error, function(m) return m .. "!" end, "x"))))
print(dofile == nil and "" or "dofile")
)");
  INFO(ended.out << ended.err);
  CHECK_THAT(ended.out, Catch::Matchers::Contains("string has no 'dump'"));
  CHECK_THAT(ended.out, Catch::Matchers::Contains("attempt to load a binary chunk"));
  CHECK_THAT(ended.out, Catch::Matchers::Contains("false\tfalse"));
  CHECK_THAT(ended.out, Catch::Matchers::Contains("not enough memory"));
  CHECK(ended.first_line() == "error: s.lua:8: unknown name 'dofile'");
  CHECK_THAT(ended.out, Catch::Matchers::Contains("3\tx!"));
  CHECK(here.run("s.lua").out == ended.out);  // the same random number too
}

TEST_CASE("no text of a plot reaches a shell, and the module's native part stays with the library") {
  const Workplace here;
  const Ended ended = here.script(std::string(small_sweep) + R"(
ricochet.plot { rows = rows, x = "psi1", y = { "e" }, name = "p", title = "`touch a`", xlabel = "$(touch b) `touch c` 'it'" }
print(pcall(require, "ricochet.core"))
)",
                                  "samples=2 --quiet");
  INFO(ended.err);
  CHECK(ended.status == 0);
  for (const char* name : {"a", "b", "c"})
    CHECK_FALSE((fs::exists(here.path / name) || fs::exists(here.path / "out/s" / name)));
  CHECK_THAT(ended.out,
             Catch::Matchers::Contains("false\ts.lua:17: require: 'ricochet.core' is for the library alone"));
}

TEST_CASE("a full disk and an unwritable folder are file errors that say how to go on") {
  const Workplace here;
  // A tmpfs of 64 kB: too small for the parts of 12 rows. Needs root, as in CI.
  if (geteuid() != 0 || here.shell("mkdir out && mount -t tmpfs -o size=64k none out").status != 0) {
    WARN("no right to mount a tmpfs here");
    return;
  }
  const Ended full = here.script(small_sweep, "--quiet");
  here.shell("umount out");
  INFO(full.err);
  CHECK(full.status == 4);
  CHECK_THAT(full.err,
             Catch::Matchers::Contains(
                 "No space left on device; free some space or give another folder with --out, then --resume"));
  here.shell("mount -t tmpfs -o ro none out");
  const Ended locked = here.script(small_sweep, "--quiet");
  here.shell("umount out");
  CHECK(locked.status == 4);
  CHECK(locked.first_line() ==
        "error: cannot make folder out/s: Read-only file system; give a writable folder with --out");
}
