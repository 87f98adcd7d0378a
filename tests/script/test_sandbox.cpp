// Scripts that mean harm: each is refused or bounded, and nothing outside the run's folder changes.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <set>

#include "core/rng.hpp"
#include "script/pattern.hpp"
#include "script/program.hpp"
#include "script/state.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

const char* const budget = "used up its budget of 10000000 instructions";

struct Hostile {
  const char* name;
  bool module;  ///< begins by requiring ricochet
  const char* script;
  int status;
  const char* words;  ///< of the error; none if the script is harmless here
};

const std::vector<Hostile>& hostile_scripts() {
  static const std::vector<Hostile> list{
      {"loop", false, R"lua(while true do end)lua", 1, budget},
      {"loop pcall", false, R"lua(while true do pcall(function() while true do end end) end)lua", 1, budget},
      {"loop coroutine", false, R"lua(local function f() while true do end end
while true do pcall(coroutine.wrap(f)) end)lua",
       1, budget},
      {"coroutines", false, R"lua(local function f() return coroutine.wrap(f)() end f())lua", 1, "C stack overflow"},
      {"coroutine bomb", false, R"lua(local t = {} while true do t[#t+1] = coroutine.create(function() end) end)lua", 1,
       budget},
      {"recursion", false, R"lua(local function f() return 1 + f() end f())lua", 1, budget},
      {"recursion pcall", false, R"lua(local function f() return pcall(f) end print(f()))lua", 0, ""},
      {"metatable recursion", false,
       R"lua(local t = setmetatable({}, {}) getmetatable(t).__index = function(_, k) return t[k] end print(t.x))lua", 1,
       "C stack overflow"},
      {"tostring recursion", false,
       R"lua(local t = setmetatable({}, {__tostring = function(t) return tostring(t) end}) print(t))lua", 1,
       "C stack overflow"},
      {"string bomb", false, R"lua(local s = "x" while true do s = s .. s end)lua", 1, budget},
      {"table bomb", false, R"lua(local t = {} for i = 1, 1e12 do t[i] = {} end)lua", 1, budget},
      {"rep", false, R"lua(local s = ("x"):rep(1e10))lua", 1, "resulting string too large"},
      {"rep empty", false, R"lua(local s = (""):rep(1e18))lua", 0, ""},
      {"rep sep", false, R"lua(local s = (""):rep(1e18, ""))lua", 0, ""},
      {"pattern", false, R"lua(print(("a"):rep(3000):find((".-"):rep(20) .. "b")))lua", 1, budget},
      {"pattern star", false, R"lua(print(("a"):rep(100000):find(("a*"):rep(10) .. "b")))lua", 1, budget},
      {"pattern gsub", false, R"lua(print((("a"):rep(20000):gsub(".-.-.-b", ""))))lua", 1, budget},
      {"pattern gmatch", false, R"lua(for w in ("a"):rep(20000):gmatch(".-.-.-b") do print(w) end)lua", 1, budget},
      {"pattern float", false, R"lua(print(("c" .. ("a"):rep(3000)):find("a*a*a*a*a*a*a*c", 2.0)))lua", 1, budget},
      {"pattern text", false, R"lua(print(("b" .. ("a"):rep(5000)):match("a*a*a*a*a*a*b", "2")))lua", 1, budget},
      {"pattern zero", false, R"lua(print(("a"):rep(3000):find(("%Z*"):rep(8) .. "b")))lua", 1, budget},
      {"pattern set", false, R"lua(print(("a"):rep(3000):find(("[^b-%]]*"):rep(8) .. "c")))lua", 1, budget},
      {"sort by C", false,
       R"lua(table.sort(setmetatable({}, {__len = function() return 2 ^ 31 - 2 | 0 end, __index = rawlen, __newindex = rawlen}), math.ult))lua",
       1, "a length of its own"},
      {"concat float", false, R"lua(while true do pcall(table.concat, {}, "", -1e9, 5) end)lua", 1, budget},
      {"close wrapped", false,
       R"lua(coroutine.wrap(function() local x <close> = setmetatable({}, {__close = function() while true do end end}) while true do end end)())lua",
       1, budget},
      {"close coroutine", false,
       R"lua(local co = coroutine.create(function() local x <close> = setmetatable({}, {__close = function() while true do end end}) while true do end end)
coroutine.resume(co) coroutine.close(co))lua",
       1, budget},
      {"load spaces", false, R"lua(local s = (" "):rep(5e6) while true do load(s) end)lua", 1, budget},
      {"lying list", true,
       R"lua(local l = setmetatable({}, {__len = function() return 2 ^ 53 | 0 end, __index = rawlen}) ricochet.theory.fit_walton { psi1 = l, psi2 = l, e = l })lua",
       1, "must not be empty"},
      {"list of itself", true,
       R"lua(local n, t = 0 t = setmetatable({}, {__len = function() return 1 end, __index = function() n = n + 1 return n == 1 and 5 or t end}) ricochet.parameters { x = { t } })lua",
       0, ""},
      {"elasticity", true,
       R"lua(local b = ricochet.body { outline = { {0, 0}, {1, 0}, {1, 4}, {0, 4} }, nodes = 20000 } while true do ricochet.elasticity { body = b } end)lua",
       1, budget},
      {"lammps many", true,
       R"lua(local s = ricochet.scene { projectile = ricochet.disk { nodes = 100 }, target = ricochet.wall { nodes = 200 } } while true do ricochet.lammps { scene = s } end)lua",
       1, budget},
      {"long names", true,
       R"lua(local s = ("x"):rep(1e6) for _, t in ipairs { _G, string, ricochet } do pcall(function() return t[s] end) end ricochet.disk { [s] = 1 })lua",
       1, "unknown field"},
      {"too many arguments", false, R"lua(print(xpcall(select, print, "#", table.unpack({}, 1, 900000))))lua", 1,
       "too many arguments"},
      {"own concat in a plot", true, R"lua(table.concat = function() return "system 'touch ../../ESCAPED'\nplot x" end
ricochet.plot { x = "x", y = { "y" }, theory = { y = function(x) return x end }, xrange = { 0, 1 }, name = "p" })lua",
       0, ""},
      {"own gsub in a plot", true, R"lua(string.gsub = function(s) return s end
ricochet.plot { x = "x", y = { "y" }, theory = { y = function(x) return x end }, xrange = { 0, 1 }, name = "p", title = "x'\nsystem 'touch ../../ESCAPED'\nset title 'y" })lua",
       0, ""},
      {"label of its own", true,
       R"lua(local l = setmetatable({}, {__concat = function() return "'\nsystem 'touch ../../ESCAPED'\nset title '" end}) l.gsub = function() return l end
ricochet.plot { x = "x", y = { "y" }, theory = { y = function(x) return x end }, xrange = { 0, 1 }, name = "p", ylabel = { y = l } })lua",
       1, "takes texts for names and labels"},
      {"core by a forged name", true,
       R"lua(local c = load("return require 'ricochet.core'", "@" .. [[)lua" RICOCHET_SOURCE
       R"lua(]] .. "/lua/ricochet/evil.lua")() c.gnuplot("p", "system 'touch ../../ESCAPED'\n"))lua",
       1, "is for the library alone"},
      {"core by a longer name", true,
       R"lua(require("ricochet.core\0x").gnuplot("p", "system 'touch ../../ESCAPED'\n"))lua", 1, "is no module name"},
      {"own require", true,
       R"lua(rawset(_G, "require", function() return { gnuplot = print } end) print(require("ricochet.plot")))lua", 0,
       ""},
      {"pattern none", false, R"lua(print((")"):rep(1e6):find((")"):rep(5e5) .. "b")))lua", 0, ""},
      {"pattern malformed", false, R"lua(print((("a"):rep(20000):gsub(".-.-.-b[", ""))))lua", 1, budget},
      {"pattern balance", false, R"lua(print(("("):rep(1e6):find("%b()")))lua", 1, budget},
      {"pattern backref", false, R"lua(print(("a"):rep(5000):find("(.*)(.*)%1%2b")))lua", 1, budget},
      {"table insert len", false,
       R"lua(table.insert(setmetatable({}, {__len = function() return 1 << 60 end}), 1, 1))lua", 1,
       "a length of its own"},
      {"table remove len", false, R"lua(table.remove(setmetatable({}, {__len = function() return 1 << 60 end}), 1))lua",
       1, "a length of its own"},
      {"table remove far", false,
       R"lua(local t = {} for k = 0, 60 do t[1 << k], t[(1 << k) + 1] = 1, 1 end table.remove(t, 1))lua", 1,
       "cannot be shifted"},
      {"table move", false, R"lua(local t = {} table.move(t, 1, 1e15, 1))lua", 1, "more than 50000000 elements"},
      {"table move2", false, R"lua(local t = {} table.move(t, 1, 1e15, 2))lua", 1, "more than 50000000 elements"},
      {"table concat", false,
       R"lua(table.concat(setmetatable({}, {__len = function() return 1 << 60 end, __index = function() return "" end})))lua",
       1, "a length of its own"},
      {"table sort", false,
       R"lua(local t = {} for i = 1, 1e5 do t[i] = i % 7 end table.sort(t, function(a, b) return true end))lua", 1,
       "invalid order function"},
      {"table unpack", false, R"lua(print(table.unpack({}, 1, 1e8)))lua", 1, "too many results"},
      {"bytecode", false, R"lua(load("\27Lua")())lua", 1, "attempt to call a nil value"},
      {"bytecode mode", false, R"lua(print(load("return 1", "x", "b")))lua", 1, "only text is accepted"},
      {"gc", false, R"lua(setmetatable({}, {__gc = function() while true do end end}))lua", 1,
       "__gc is not for scripts"},
      {"close", false,
       R"lua(local x <close> = setmetatable({}, {__close = function() while true do end end}) error("x"))lua", 1,
       budget},
      {"string metatable", false, R"lua(getmetatable("").__index = function() end)lua", 1,
       "attempt to index a boolean value"},
      {"string metatable2", false, R"lua(string.format = nil; local s = ("x"):format() print(string.format))lua", 1,
       "string has no 'format'"},
      {"globals", false, R"lua(_G.print = nil; _ENV = nil; print(1))lua", 1, "upvalue '_ENV'"},
      {"read dots", true, R"lua(print(ricochet.file.read("../../secret.txt")))lua", 1,
       "is no name below the run's folder"},
      {"read absolute", true, R"lua(print(ricochet.file.read("/etc/passwd")))lua", 1,
       "is no name below the run's folder"},
      {"read link", true, R"lua(print(ricochet.file.read("link.txt")))lua", 4, "leads out of the run's folder"},
      {"write dots", true, R"lua(ricochet.file.write("../../evil.txt", "x"))lua", 1,
       "is no name below the run's folder"},
      {"write link", true, R"lua(ricochet.file.write("link.txt", "x"))lua", 4, "leads out of the run's folder"},
      {"write many", true, R"lua(for i = 1, 1e6 do ricochet.file.write("f" .. i, "x") end)lua", 1, budget},
      {"write huge", true, R"lua(local s = ("x"):rep(1e9) for i = 1, 100 do ricochet.file.write("f" .. i, s) end)lua",
       1, budget},
      {"require dots", false, R"lua(require "..secret")lua", 1, "is no module name"},
      {"require slash", false, R"lua(require "/etc/passwd")lua", 1, "is no module name"},
      {"require link", false, R"lua(require "link")lua", 1, "a link that leads out of the script's folder"},
      {"require core", false, R"lua(require "ricochet.core".plot {})lua", 1, "for the library alone"},
      {"print flood", false, R"lua(local s = ("x"):rep(1e6) while true do print(s) end)lua", 1,
       "printed more than 64 MiB"},
      {"error flood", false, R"lua(local s = ("x"):rep(1e8) error(s))lua", 1, budget},
      {"error table", false, R"lua(error(setmetatable({}, {__tostring = function() while true do end end})))lua", 1,
       budget},
      {"sweep huge", true, R"lua(local r = ricochet.range(1e7)
ricochet.sweep { name = "s", over = { a = r, b = r, c = r }, scene = function() end }:run())lua",
       1, budget},
      {"sweep million", true,
       R"lua(ricochet.sweep { name = "s", over = { a = ricochet.range(1e6) }, scene = function(at) return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = at.a }, target = ricochet.wall { nodes = 150, width = 4 } } end }:run())lua",
       1, budget},
      {"parameters huge", true, R"lua(local t = {} for i = 1, 1e6 do t["p" .. i] = i end ricochet.parameters(t))lua", 1,
       budget},
      {"outline huge", true,
       R"lua(local o = {} for i = 1, 3e6 do o[i] = { math.cos(i / 3e6 * 6.28), math.sin(i / 3e6 * 6.28) } end ricochet.body { outline = o, nodes = 100 })lua",
       1, budget},
      {"nodes huge", true, R"lua(ricochet.disk { nodes = 1e9 })lua", 1, "must be between 4 and 1e+07"},
      {"nodes many", true, R"lua(ricochet.disk { nodes = 1e7 })lua", 1, budget},
      {"bodies many", true, R"lua(for i = 1, 1e6 do ricochet.disk { nodes = 100000, seed = i } end)lua", 1, budget},
      {"anchored loop", true,
       R"lua(ricochet.body { outline = {{0,0},{1,0},{0,1}}, nodes = 50, anchored = function() while true do end end })lua",
       1, budget},
      {"scene loop", true,
       R"lua(ricochet.sweep { name = "s", over = { a = {1} }, scene = function() while true do end end }:run())lua", 1,
       budget},
      {"name dots", true,
       R"lua(ricochet.sweep { name = "../../evil", over = { a = {1} }, scene = function() end }:run())lua", 1,
       "must be letters, digits"},
      {"deep text", false, R"lua(load(("("):rep(1e6))())lua", 1, "attempt to call a nil value"},
      {"deep table", false, R"lua(load("return " .. ("{"):rep(1e5) .. ("}"):rep(1e5))())lua", 1,
       "attempt to call a nil value"},
      {"os execute", false, R"lua(os.execute("touch evil"))lua", 1, "os has no 'execute'"},
      {"io open", false, R"lua(io.open("evil", "w"))lua", 1, "unknown name 'io'"},
      {"debug", false, R"lua(debug.sethook())lua", 1, "unknown name 'debug'"},
      {"randomseed", false, R"lua(for i = 1, 1e12 do math.random() end)lua", 1, budget},
      {"date", false, R"lua(print(os.date(("%c"):rep(1e5))))lua", 1, "longer than 1000 bytes"},
      {"utf8", false, R"lua(print(utf8.len(("x"):rep(1e9))))lua", 1, budget},
      {"xpcall handler", false, R"lua(xpcall(function() error("x") end, function() while true do end end))lua", 1,
       budget},
      {"concat chain", false, R"lua(local t = {} for i = 1, 1e5 do t[i] = ("x"):rep(1e5) end table.concat(t))lua", 1,
       budget},
      {"plain find", false,
       R"lua(local s = ("a"):rep(2e6) while true do s:find(("a"):rep(1e6) .. "b", 1, true) end)lua", 1, budget},
      {"utf8", false, R"lua(local s = ("a"):rep(1e6) while true do utf8.len(s) end)lua", 1, budget},
      {"packsize", false, R"lua(local s = ("i1"):rep(1e5) while true do string.packsize(s) end)lua", 1, budget},
      {"unpack", false, R"lua(local s = (" "):rep(1e6) while true do string.unpack(s, "") end)lua", 1, budget},
      {"tonumber", false, R"lua(local s = ("1"):rep(1e6) while true do tonumber(s, 10) end)lua", 1, budget},
      {"concat of nothing", false,
       R"lua(local t = {} for i = 1, 1e5 do t[i] = "" end while true do table.concat(t) end)lua", 1, budget},
      {"sort", false, R"lua(local t = {} for i = 1, 1e5 do t[i] = i end while true do table.sort(t) end)lua", 1,
       budget},
      {"equal strings", false,
       R"lua(local s = ("a"):rep(5e6) local a, b = s .. "b", s .. "b" while true do local c = a == b end)lua", 1,
       budget},
      {"ordered strings", false,
       R"lua(local s = ("a"):rep(5e6) local a, b = s .. "b", s .. "c" while true do local c = a < b end)lua", 1,
       budget},
      {"next of an emptied table", false,
       R"lua(local t = {} for i = 1, 1e5 do t[i] = i end for i = 1, 1e5 do t[i] = nil end while true do next(t) end)lua",
       1, budget},
      {"own results", true, R"lua(ricochet.file.write("results.h5", "oops"))lua", 1, "that runs leave themselves"},
      {"own log below", true, R"lua(ricochet.file.write("parts/x", "oops"))lua", 1, "that runs leave themselves"},
      {"name with nul", true, "ricochet.file.write('a\\0b', 'oops')", 1, "is no name below"},
      {"over slash", true,
       R"lua(ricochet.sweep { name = "s", over = { ["a/b"] = { 1 } }, scene = function(at) return at end })lua", 1,
       "cannot name a column"},
      {"over many", true,
       R"lua(local o = {} for i = 1, 12 do o["a" .. i] = ricochet.range(100) end ricochet.sweep { name = "s", over = o, scene = function(at) return at end })lua",
       1, "combinations"},
      {"theory without end", true,
       R"lua(while true do ricochet.theory.maw_integrated { psi1 = 1, mu = 1, e = 1, nu = 0, steps = 1e7 } end)lua", 1,
       budget},
      {"spline through 1e5 points", true,
       R"lua(local x = ricochet.range(100000) ricochet.theory.tilted_curve { psi1 = x, mu = x, e_alpha = x, offset = x, nu = 0, at = { 1 } })lua",
       1, budget},
      {"plot shell", true,
       R"lua(ricochet.plot { rows = {}, x = "`touch evil`", y = {"$(touch evil)"}, name = "p" })lua", 1,
       "'rows' must be rows"},
      {"animate huge", true,
       R"lua(local s = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } } ricochet.animate { scene = s, frames = 1e9, size = {1e5, 1e5} })lua",
       1, "'frames' must be between"},
      {"log of two faces", true,
       R"lua(local n, f = 0, { name = "p", x = "x", y = { "y" }, xrange = { 0, 1 }, theory = { y = function(x) return x end } }
ricochet.plot(setmetatable({}, { __index = function(_, k) if k == "log" then n = n + 1 return n == 1 and "none" or "x\n!touch ../../ESCAPED\n#" end return f[k] end })))lua",
       0, ""},
      {"column of two faces", true,
       R"lua(local s = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } }
local evil, n = "e'\n!touch ../../ESCAPED\n#", 0
ricochet.accuracy { scene = s, methods = { "verlet" }, steps = { 0.004, 0.003 }, of = setmetatable({ "e" }, { __index = function(t, i) n = n + 1 if i == 2 then rawset(t, 1, evil) end end }) })lua",
       0, ""},
      {"row's metatable", true,
       R"lua(local r = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } }:run() getmetatable(r).__gc = print)lua",
       1, "attempt to index a boolean value"},
      {"metatables", true,
       R"lua(local theory = ricochet.theory.tilted_surface { psi1 = 1, mu = 0.1, e_alpha = 1, offset = 0.1, nu = 0.3 }
local sweep = ricochet.sweep { name = "s", over = { a = { 1 } }, scene = function() return ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } } end }
local rows = sweep:run()
for i, t in ipairs { ricochet.parameters { a = 1 }, theory, sweep, rows, rows[1], rows:summary { by = "a", of = { "e" } }, ricochet.disk {}, ricochet.gravity { g = 1 }, ricochet.theory } do
  assert(getmetatable(t) == false and not pcall(setmetatable, t, {}), i)
end)lua",
       0, ""},
      {"sweep renamed", true,
       R"lua(local s = ricochet.sweep { name = "s", over = { a = { 1 } }, scene = print } s.name = "../evil" s:run())lua",
       1, "takes no new fields"},
      {"sweep renamed past its metatable", true,
       R"lua(local s = ricochet.sweep { name = "s", over = { a = { 1, 2 } }, scene = function() return ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 } } end }
for name, value in pairs { name = "../evil", points = { { a = 1 }, { a = 2 }, { a = "x" } }, names = { "a/../b" }, at = print } do rawset(s, name, value) end s:run())lua",
       0, ""},
      {"forged sweep", true,
       R"lua(ricochet.plan { sweep = setmetatable({ names = { "sample" }, points = { { sample = 1 } }, at = function() return 5 end }, { __name = "sweep" }), standard_error = 0.1 })lua",
       1, "s.lua:2: plan: 'sweep' must be a sweep (from ricochet.sweep)"},
      {"forged method", true,
       R"lua(local s = ricochet.sweep { name = "s", over = { a = { 1 } }, scene = print } s.run({ name = "../evil" }))lua",
       1, "is a method of a sweep"},
      {"body of two faces", true,
       R"lua(local f = { outline = { { 0, 0 }, { 1, 0 }, { 0, 1 } }, nodes = 50, placement = "uniform" }
for _, name in ipairs { "outline", "placement" } do local n = {} ricochet.body(setmetatable({}, { __index = function(_, k) n[k] = (n[k] or 0) + 1 if k == name and n[k] > 1 then return { 1, 2, 3 } end return f[k] end })) end)lua",
       0, ""},
      {"tables in tables", true,
       R"lua(local t = {} for i = 1, 1e4 do t = { t } end ricochet.plot { x = "x", y = { "y" }, name = "p", theory = t })lua",
       1, "more than 100 deep"},
      {"table of itself", true,
       R"lua(local t = {} t.y = t ricochet.plot { x = "x", y = { "y" }, name = "p", theory = t })lua", 1,
       "has neither rows nor points"},
      {"coroutines in coroutines", false,
       R"lua(local function f(d) if d == 0 then return end for i = 1, 30 do coroutine.wrap(f)(d - 1) end end f(30))lua",
       1, budget},
      {"coroutines created", false,
       R"lua(local function f(d) if d == 0 then return end for i = 1, 30 do coroutine.resume(coroutine.create(f), d - 1) end end f(30))lua",
       1, budget},
      {"length of two faces", false,
       R"lua(local n = 0 table.insert(setmetatable({}, { __len = function() n = n + 1 return n == 1 and 1 or 1 << 60 end }), 1, 1))lua",
       1, "a length of its own"},
      {"sort long strings", false,
       R"lua(local a, t = ("\0"):rep(1e6), {} for i = 1, 2000 do t[i] = a end table.sort(t))lua", 1, budget},
      {"compare zeros", false,
       R"lua(local a = ("\0"):rep(3e6) local b, c = a .. "b", a .. "c" while true do local x = b < c end)lua", 1,
       budget},
      {"compare many zeros in coroutines", false,
       R"lua(while true do coroutine.wrap(function() local a = ("\0"):rep(2e7) local b, c = a .. "b", a .. "c" for i = 1, 100 do local x = b < c end end)() end)lua",
       1, budget},
      {"unknown name in the depth", false,
       R"lua(local function f(n) if n == 0 then return undefinedname end return 1 + f(n - 1) end print(pcall(f, 30000)))lua",
       0, ""},
      {"unknown name among many", false,
       R"lua(for i = 1, 5e4 do rawset(_G, "x" .. ("y"):rep(90) .. i, i) end while true do pcall(function() return _G["y" .. ("x"):rep(90)] end) end)lua",
       1, budget},
      {"coroutines closed and forgotten", false,
       R"lua(local rep, mt = string.rep, { __close = function() local s = 0 for i = 1, 3000 do s = s + i end end }
local function body() local x <close> = setmetatable({}, mt) coroutine.yield() end
local function once() local co = coroutine.create(body) coroutine.resume(co) coroutine.close(co) end
for k = 1, 3000 do
  for j = 1, 5 do once() end
  local n = 260000 + k
  local a = rep("a", n) a = rep("b", n) a = rep("c", n) a = rep("d", n) a = rep("e", n) a = rep("f", n) a = rep("g", n)
  a = rep("a", 1000) a = rep("b", 216)
  for _, m in ipairs { 200, 190, 180, 170, 215, 216, 210, 205, 195 } do a = rep("\255", m) end
  local b = rep("b", 1100000)
end)lua",
       1, budget},
      {"names among locals", false, R"lua(local names = {} for i = 1, 190 do names[i] = "v" .. i end
print(load(("local function f() local " .. table.concat(names, ",") .. " "):rep(180) .. ("a=a "):rep(4e5) .. ("end "):rep(180))))lua",
       1, budget},
      {"parameters that share choices", true,
       R"lua(local c, t = {}, {} for i = 1, 1e5 do c[i] = "c" .. i end for i = 1, 1000 do t["p" .. i] = { "c1", choices = c } end ricochet.parameters(t))lua",
       1, budget},
      {"parameters that share a list", true,
       R"lua(local c, t = {}, {} for i = 1, 1e5 do c[i] = i end for i = 1, 1000 do t["p" .. i] = { c } end ricochet.parameters(t))lua",
       1, budget},
      {"fields unknown", true,
       R"lua(local t = {} for i = 1, 2e4 do t[("x"):rep(90) .. i] = i end while true do pcall(ricochet.disk, t) end)lua",
       1, budget},
      {"plot as an option", true,
       R"lua(ricochet.plot { x = "x", y = { "y" }, name = "-p", xrange = { 0, 1 }, theory = { y = function(x) return x end } } assert(ricochet.file.read("-p.png"):find "PNG"))lua",
       0, ""},
      {"deep values", true,
       R"lua(local t = {} for i = 1, 150 do t = { t } end ricochet.sweep { name = "s", over = { a = { 1 } }, scene = print }:at { a = t })lua",
       1, "more than 100 deep"},
      {"range without end", true, R"lua(ricochet.range(1e17, 1e17 + 100, 1e-3))lua", 1, "lost in rounding"},
      {"own results in the making", true, R"lua(ricochet.file.write("results.h5.new/x", "oops"))lua", 1,
       "that runs leave themselves"},
      {"long pattern", false, R"lua(print(pcall(string.find, "a", ("a"):rep(1e6) .. "*")))lua", 0, ""},
  };
  return list;
}

std::set<std::string> entries(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

}  // namespace

TEST_CASE("hostile scripts are refused or bounded, and touch nothing") {
  REQUIRE(hostile_scripts().size() >= 40);
  double slowest = 0;
  std::string name;
  int held = 0;
  for (const Hostile& h : hostile_scripts()) {
    const Workplace here;
    here.write("secret.txt", "hidden words");
    here.write("work/s.lua", (h.module ? "local ricochet = require \"ricochet\"\n" : "") + std::string(h.script));
    fs::create_directories(here.path / "work/out/s");
    for (const char* link : {"work/out/s/link.txt", "work/link.lua"})
      fs::create_symlink(here.path / "secret.txt", here.path / link);
    const auto before = entries(here.path);
    const auto began = std::chrono::steady_clock::now();
    const Ended ended =
        here.shell("cd work && timeout -s KILL 60 '" RICOCHET_PROGRAM "' run s.lua --budget 10000000 --resume");
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (seconds > slowest) {
      slowest = seconds;
      name = h.name;
    }
    INFO(h.name << ": " << ended.err.substr(0, 1000));
    const bool right = ended.status == h.status && ended.err.find(h.words) != std::string::npos &&
                       (h.status == 0 || ended.err.starts_with("error: "));
    CHECK(right);
    held += right;
    // Below its own folder a script may write; nowhere else.
    for (const std::string& entry : entries(here.path))
      if (!before.count(entry) && entry != "out.txt" && entry != "err.txt")
        CHECK_THAT(entry, Catch::Matchers::StartsWith("work/out/s/"));
    CHECK(here.read("secret.txt") == "hidden words");
    CHECK(ended.out.find("hidden words") == std::string::npos);
    CHECK(ended.err.find("hidden words") == std::string::npos);
  }
  fmt::print("{} of {} hostile scripts refused or bounded; the slowest took {:.1f} s ({})\n", held,
             hostile_scripts().size(), slowest, name);
}

TEST_CASE("without a budget what runs in the libraries is bounded, and the repl lives on") {
  const Workplace here;
  here.write("in.txt",
             "(\"a\"):rep(3000):find((\".-\"):rep(20) .. \"b\")\n(\"\"):rep(1e18)\ntable.move({}, 1, 1e15, "
             "2)\nsetmetatable({}, {__gc = print})\n"
             "(function() local t = {} for k = 0, 60 do t[1 << k], t[(1 << k) + 1] = 1, 1 end table.remove(t, 1) "
             "end)()\n(function() local function f() return 1 + f() end return f() end)()\n1 + 1\n");
  const Ended ended = here.shell("timeout 60 '" RICOCHET_PROGRAM "' repl <in.txt");
  CHECK(ended.status == 0);
  for (const char* words :
       {"the pattern takes more than 100 million steps on this text of 3000 bytes", "more than 50000000 elements",
        "__gc is not for scripts", "cannot be shifted", "stack overflow"})
    CHECK_THAT(ended.err, Catch::Matchers::Contains(words));
  CHECK_THAT(ended.out, Catch::Matchers::Contains("> 2\n"));
}

TEST_CASE("a plain search finds what a search for the escaped words finds") {
  const Workplace here;
  here.write("s.lua", R"lua(
local state = 1
local function random(n) state = (state * 1103515245 + 12345) % 2147483648 return state // 65536 % n end
local function text(n) local t = {} for i = 1, random(n + 1) do t[i] = ({ "a", "b", ".", "%", "\0" })[random(5) + 1] end return table.concat(t) end
local found = 0
for trial = 1, 20000 do
  local where, words, from = text(12), text(3), random(30) - 15
  local a, b = where:find(words, from, true)
  local c, d = where:find(words:gsub("%W", "%%%0"), from)
  if a ~= c or b ~= d then error(("%q %q %d: %s %s, not %s %s"):format(where, words, from, a, b, c, d)) end
  if a then found = found + 1 end
end
print("found", found)
assert(found > 5000 and found < 19000)
assert(select("#", ("a"):find("b", 1, true)) == 1)
)lua");
  const Ended ended = here.run("s.lua");
  INFO(ended.err);
  CHECK(ended.status == 0);
}

TEST_CASE("searches find what Lua's own do, so that their steps are those it would take") {
  lua_State* L = luaL_newstate();
  luaL_openlibs(L);
  Random random(7, 7);
  int found = 0, refused = 0, wrong = 0;
  for (int trial = 0; trial < 200000; ++trial) {
    const auto draw = [&](const char* letters, int most) {
      const std::string_view from = letters;
      std::string text;
      for (int n = static_cast<int>(random.uniform(0, most + 1)); n > 0; --n)
        text += from[static_cast<std::size_t>(random.uniform(0, static_cast<double>(from.size())))];
      return text;
    };
    const std::string text = draw("aab1( )x", 12);
    std::string pattern = random.uniform() < 0.2 ? "^" : "";
    for (int n = static_cast<int>(random.uniform(0, 6)); n >= 0; --n) {
      const char* parts[] = {"a", "b", ".",  "%a", "%d",   "%s",   "[ab]",   "[^a]",   "[%w(]", "[a-x]",
                             "(", ")", "()", "(a", "%1",   "%b()", "%f[%a]", "%f[^a]", "%(",    "$",
                             "x", "-", "]",  "%D", "[]a]", "[a-]", "%",      "["};
      pattern += parts[static_cast<std::size_t>(
          random.uniform(0, static_cast<double>(std::size(parts)) - (random.uniform() < 0.98 ? 2 : 0)))];
      pattern += draw("*+-?", 1);
    }
    const auto begin = static_cast<std::size_t>(random.uniform(0, 4));
    if (pattern.find_first_of("^$*+?.([%-") == std::string::npos) continue;  // string.find takes it as it stands
    lua_getglobal(L, "string");
    lua_getfield(L, -1, "find");
    lua_pushlstring(L, text.data(), text.size());
    lua_pushlstring(L, pattern.data(), pattern.size());
    lua_pushinteger(L, static_cast<lua_Integer>(begin) + 1);
    const bool fine = lua_pcall(L, 3, 2, 0) == LUA_OK;
    const PatternSearch search = search_pattern(text, pattern, begin, 1, true, 1e9);
    bool same = true;
    // Lua reads a pattern as it goes and may match, or fail, before it comes to what is wrong; so must we.
    if (!fine || search.refused) {
      same = !fine && search.refused;
      ++refused;
    } else if (lua_isnil(L, -2))
      same = !search.first;
    else {
      ++found;
      same = search.first && lua_tointeger(L, -2) == static_cast<lua_Integer>(search.first->begin) + 1 &&
             lua_tointeger(L, -1) == static_cast<lua_Integer>(search.first->end);
    }
    INFO("'" << text << "' '" << pattern << "' from " << begin);
    if (!same && wrong++ < 10) CHECK(same);
    lua_settop(L, 0);
  }
  lua_close(L);
  CHECK(wrong == 0);
  CHECK(found > 20000);
  CHECK(refused > 1000);
  CHECK(refused < 100000);
}

TEST_CASE("gnuplot starts no programs, and writes through no link") {
  const Workplace here;
  const std::string plot =
      "local ricochet = require 'ricochet' ricochet.plot { x = 'x', y = { 'y' }, theory = { y = function(x) return x "
      "end }, xrange = { 0, 1 }, name = 'p' }";
  here.write("s.lua", plot);
  // In gnuplot's place one that starts another program, as gnuplot's `system` and backquotes do.
  here.write("bin/gnuplot", "#!/bin/sh\n: >started\ntouch escaped\n: >went_on\n");
  fs::permissions(here.path / "bin/gnuplot", fs::perms::owner_all);
  const std::string with_it = "PATH='" + (here.path / "bin").string() + "':\"$PATH\" ricochet run s.lua ";
  here.shell(with_it + "--out confined");
  CHECK(fs::exists(here.path / "confined/s/started"));
  CHECK_FALSE(fs::exists(here.path / "confined/s/escaped"));
  here.shell(with_it + "--out free --unsafe");
  CHECK(fs::exists(here.path / "free/s/escaped"));

  const Ended absent = here.shell("PATH=/nowhere ricochet run s.lua --out absent");
  CHECK(absent.status == 4);
  CHECK_THAT(absent.err, Catch::Matchers::Contains("gnuplot is not installed"));

  here.write("mine.png", "mine");
  fs::create_directories(here.path / "out/s");
  for (const char* link : {"out/s/p.png", "out/s/p.svg"}) fs::create_symlink(here.path / "mine.png", here.path / link);
  CHECK(here.run("s.lua --resume").status == 0);
  CHECK(here.read("mine.png") == "mine");
  CHECK(here.read("out/s/p.png").substr(1, 3) == "PNG");
}
