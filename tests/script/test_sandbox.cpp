// Scripts that mean harm: each is refused or bounded, and nothing outside the run's folder changes.

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <set>

#include "impact/parallel.hpp"
#include "script/program.hpp"

using namespace ricochet;
using namespace ricochet::test;

namespace {

// With the line, or without.
const char* const stopped = "script stopped: --max-seconds 1 reached at s.lua";

struct Hostile {
  const char* name;
  bool module;  ///< begins by requiring ricochet
  const char* script;
  int status;
  const char* words;  ///< of the error; none if the script is harmless here
};

const std::vector<Hostile>& hostile_scripts() {
  static const std::vector<Hostile> list{
      {"loop", false, R"lua(while true do end)lua", 1, stopped},
      {"loop pcall", false, R"lua(while true do pcall(function() while true do end end) end)lua", 1, stopped},
      {"loop coroutine", false, R"lua(local function f() while true do end end
while true do pcall(coroutine.wrap(f)) end)lua",
       1, stopped},
      {"coroutines", false, R"lua(local function f() return coroutine.wrap(f)() end f())lua", 1, "C stack overflow"},
      {"coroutine bomb", false, R"lua(local t = {} while true do t[#t+1] = coroutine.create(function() end) end)lua", 1,
       stopped},
      {"recursion", false, R"lua(local function f() return 1 + f() end f())lua", 1, "stack overflow"},
      {"recursion pcall", false, R"lua(local function f() return pcall(f) end print(f()))lua", 0, ""},
      {"metatable recursion", false,
       R"lua(local t = setmetatable({}, {}) getmetatable(t).__index = function(_, k) return t[k] end print(t.x))lua", 1,
       "C stack overflow"},
      {"tostring recursion", false,
       R"lua(local t = setmetatable({}, {__tostring = function(t) return tostring(t) end}) print(t))lua", 1,
       "C stack overflow"},
      {"string bomb", false, R"lua(local s = "x" while true do s = s .. s end)lua", 1, stopped},
      {"table bomb", false, R"lua(local t = {} for i = 1, 1e12 do t[i] = {} end)lua", 1, stopped},
      {"rep", false, R"lua(local s = ("x"):rep(1e10))lua", 1, "resulting string too large"},
      {"rep empty", false, R"lua(local s = (""):rep(1e18))lua", 1, stopped},
      {"rep sep", false, R"lua(local s = (""):rep(1e18, ""))lua", 1, stopped},
      {"pattern", false, R"lua(print(("a"):rep(3000):find((".-"):rep(20) .. "b")))lua", 1, stopped},
      {"pattern star", false, R"lua(print(("a"):rep(100000):find(("a*"):rep(10) .. "b")))lua", 1, stopped},
      {"pattern gsub", false, R"lua(print((("a"):rep(20000):gsub(".-.-.-b", ""))))lua", 1, stopped},
      {"pattern gmatch", false, R"lua(for w in ("a"):rep(20000):gmatch(".-.-.-b") do print(w) end)lua", 1, stopped},
      {"pattern float", false, R"lua(print(("c" .. ("a"):rep(3000)):find("a*a*a*a*a*a*a*c", 2.0)))lua", 1, stopped},
      {"pattern text", false, R"lua(print(("b" .. ("a"):rep(5000)):match("a*a*a*a*a*a*b", "2")))lua", 1, stopped},
      {"pattern zero", false, R"lua(print(("a"):rep(3000):find(("%Z*"):rep(8) .. "b")))lua", 1, stopped},
      {"pattern set", false, R"lua(print(("a"):rep(3000):find(("[^b-%]]*"):rep(8) .. "c")))lua", 1, stopped},
      {"sort by C", false,
       R"lua(table.sort(setmetatable({}, {__len = function() return 2 ^ 31 - 2 | 0 end, __index = rawlen, __newindex = rawlen}), math.ult))lua",
       1, stopped},
      {"concat float", false, R"lua(while true do pcall(table.concat, {}, "", -1e9, 5) end)lua", 1, stopped},
      {"close wrapped", false,
       R"lua(coroutine.wrap(function() local x <close> = setmetatable({}, {__close = function() while true do end end}) while true do end end)())lua",
       1, stopped},
      {"close coroutine", false,
       R"lua(local co = coroutine.create(function() local x <close> = setmetatable({}, {__close = function() while true do end end}) while true do end end)
coroutine.resume(co) coroutine.close(co))lua",
       1, stopped},
      {"load spaces", false, R"lua(local s = (" "):rep(5e6) while true do load(s) end)lua", 1, stopped},
      {"lying list", true,
       R"lua(local l = setmetatable({}, {__len = function() return 2 ^ 53 | 0 end, __index = rawlen}) ricochet.theory.fit_walton { psi1 = l, psi2 = l, e = l })lua",
       1, "must not be empty"},
      {"list of itself", true,
       R"lua(local n, t = 0 t = setmetatable({}, {__len = function() return 1 end, __index = function() n = n + 1 return n == 1 and 5 or t end}) ricochet.parameters { x = { t } })lua",
       0, ""},
      {"elasticity", true,
       R"lua(local b = ricochet.body { outline = { {0, 0}, {1, 0}, {1, 4}, {0, 4} }, nodes = 20000 } while true do ricochet.elasticity { body = b } end)lua",
       1, stopped},
      {"lammps many", true,
       R"lua(local s = ricochet.scene { projectile = ricochet.disk { nodes = 100 }, target = ricochet.wall { nodes = 200 } } while true do ricochet.lammps { scene = s } end)lua",
       1, stopped},
      {"long names", true,
       R"lua(local s = ("x"):rep(1e6) for _, t in ipairs { _G, string, ricochet } do pcall(function() return t[s] end) end ricochet.disk { [s] = 1 })lua",
       1, "unknown field"},
      {"too many arguments", false, R"lua(print(xpcall(select, print, "#", table.unpack({}, 1, 900000))))lua", 0, ""},
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
      {"pattern none", false, R"lua(print((")"):rep(4e6):find((")"):rep(2e6) .. "b")))lua", 1, stopped},
      {"pattern malformed", false, R"lua(print((("a"):rep(20000):gsub(".-.-.-b[", ""))))lua", 1, stopped},
      {"pattern balance", false, R"lua(print(("("):rep(1e6):find("%b()")))lua", 1, stopped},
      {"pattern backref", false, R"lua(print(("a"):rep(5000):find("(.*)(.*)%1%2b")))lua", 1, stopped},
      {"table insert len", false,
       R"lua(table.insert(setmetatable({}, {__len = function() return 1 << 60 end}), 1, 1))lua", 1, stopped},
      {"table remove len", false, R"lua(table.remove(setmetatable({}, {__len = function() return 1 << 60 end}), 1))lua",
       1, stopped},
      {"table remove far", false,
       R"lua(local t = {} for k = 0, 60 do t[1 << k], t[(1 << k) + 1] = 1, 1 end table.remove(t, 1))lua", 1, stopped},
      {"table move", false, R"lua(local t = {} table.move(t, 1, 1e15, 1))lua", 1, stopped},
      {"table move2", false, R"lua(local t = {} table.move(t, 1, 1e15, 2))lua", 1, stopped},
      {"table concat", false,
       R"lua(table.concat(setmetatable({}, {__len = function() return 1 << 60 end, __index = function() return "" end})))lua",
       1, stopped},
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
       stopped},
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
      {"write many", true, R"lua(for i = 1, 1e6 do ricochet.file.write("f" .. i, "x") end)lua", 1, stopped},
      {"write huge", true, R"lua(local s = ("x"):rep(1e9) for i = 1, 100 do ricochet.file.write("f" .. i, s) end)lua",
       1, stopped},
      {"require dots", false, R"lua(require "..secret")lua", 1, "is no module name"},
      {"require slash", false, R"lua(require "/etc/passwd")lua", 1, "is no module name"},
      {"require link", false, R"lua(require "link")lua", 1, "a link that leads out of the script's folder"},
      {"require core", false, R"lua(require "ricochet.core".plot {})lua", 1, "for the library alone"},
      {"print flood", false, R"lua(local s = ("x"):rep(1e6) while true do print(s) end)lua", 1,
       "printed more than 64 MiB"},
      {"error flood", false, R"lua(local s = ("x"):rep(1e8) error(s))lua", 1, "s.lua:1"},
      {"error table", false, R"lua(error(setmetatable({}, {__tostring = function() while true do end end})))lua", 1,
       stopped},
      {"sweep huge", true, R"lua(local r = ricochet.range(1e7)
ricochet.sweep { name = "s", over = { a = r, b = r, c = r }, scene = function() end }:run())lua",
       1, stopped},
      {"sweep million", true,
       R"lua(ricochet.sweep { name = "s", over = { a = ricochet.range(1e6) }, scene = function(at) return ricochet.scene { projectile = ricochet.disk { nodes = 60, seed = at.a }, target = ricochet.wall { nodes = 150, width = 4 } } end }:run())lua",
       1, stopped},
      {"parameters huge", true, R"lua(local t = {} for i = 1, 1e6 do t["p" .. i] = i end ricochet.parameters(t))lua", 1,
       stopped},
      {"outline huge", true,
       R"lua(local o = {} for i = 1, 3e6 do o[i] = { math.cos(i / 3e6 * 6.28), math.sin(i / 3e6 * 6.28) } end ricochet.body { outline = o, nodes = 100 })lua",
       1, stopped},
      {"nodes huge", true, R"lua(ricochet.disk { nodes = 1e9 })lua", 1, "must be between 4 and 1e+07"},
      {"nodes many", true, R"lua(ricochet.disk { nodes = 1e7 })lua", 1, stopped},
      {"bodies many", true, R"lua(for i = 1, 1e6 do ricochet.disk { nodes = 100000, seed = i } end)lua", 1, stopped},
      {"anchored loop", true,
       R"lua(ricochet.body { outline = {{0,0},{1,0},{0,1}}, nodes = 50, anchored = function() while true do end end })lua",
       1, stopped},
      {"scene loop", true,
       R"lua(ricochet.sweep { name = "s", over = { a = {1} }, scene = function() while true do end end }:run())lua", 1,
       stopped},
      {"name dots", true,
       R"lua(ricochet.sweep { name = "../../evil", over = { a = {1} }, scene = function() end }:run())lua", 1,
       "must be letters, digits"},
      {"deep text", false, R"lua(load(("("):rep(1e6))())lua", 1, "attempt to call a nil value"},
      {"deep table", false, R"lua(load("return " .. ("{"):rep(1e5) .. ("}"):rep(1e5))())lua", 1,
       "attempt to call a nil value"},
      {"os execute", false, R"lua(os.execute("touch evil"))lua", 1, "os has no 'execute'"},
      {"io open", false, R"lua(io.open("evil", "w"))lua", 1, "unknown name 'io'"},
      {"debug", false, R"lua(debug.sethook())lua", 1, "unknown name 'debug'"},
      {"randomseed", false, R"lua(for i = 1, 1e12 do math.random() end)lua", 1, stopped},
      {"date", false, R"lua(print(os.date(("%c"):rep(1e5))))lua", 0, ""},
      {"utf8", false, R"lua(print(utf8.len(("x"):rep(1e9))))lua", 1, stopped},
      {"xpcall handler", false, R"lua(xpcall(function() error("x") end, function() while true do end end))lua", 1,
       stopped},
      {"concat chain", false, R"lua(local t = {} for i = 1, 1e5 do t[i] = ("x"):rep(1e5) end table.concat(t))lua", 1,
       stopped},
      {"plain find", false,
       R"lua(local s = ("a"):rep(2e6) while true do s:find(("a"):rep(1e6) .. "b", 1, true) end)lua", 1, stopped},
      {"utf8", false, R"lua(local s = ("a"):rep(1e6) while true do utf8.len(s) end)lua", 1, stopped},
      {"packsize", false, R"lua(local s = ("i1"):rep(1e5) while true do string.packsize(s) end)lua", 1, stopped},
      {"unpack", false, R"lua(local s = (" "):rep(1e6) while true do string.unpack(s, "") end)lua", 1, stopped},
      {"tonumber", false, R"lua(local s = ("1"):rep(1e6) while true do tonumber(s, 10) end)lua", 1, stopped},
      {"concat of nothing", false,
       R"lua(local t = {} for i = 1, 1e5 do t[i] = "" end while true do table.concat(t) end)lua", 1, stopped},
      {"sort", false, R"lua(local t = {} for i = 1, 1e5 do t[i] = i end while true do table.sort(t) end)lua", 1,
       stopped},
      {"equal strings", false,
       R"lua(local s = ("a"):rep(5e6) local a, b = s .. "b", s .. "b" while true do local c = a == b end)lua", 1,
       stopped},
      {"ordered strings", false,
       R"lua(local s = ("a"):rep(5e6) local a, b = s .. "b", s .. "c" while true do local c = a < b end)lua", 1,
       stopped},
      {"next of an emptied table", false,
       R"lua(local t = {} for i = 1, 1e5 do t[i] = i end for i = 1, 1e5 do t[i] = nil end while true do next(t) end)lua",
       1, stopped},
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
       stopped},
      {"spline through 1e5 points", true,
       R"lua(local x, c = ricochet.range(100000), {} for i in ipairs(x) do c[i] = 0.5 end
ricochet.theory.tilted_curve { psi1 = x, mu = c, e_alpha = c, offset = c, nu = 0, at = { 1 } })lua",
       0, ""},  // as many as one likes: a band of the spline's equations is solved
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
       1, stopped},
      {"coroutines created", false,
       R"lua(local function f(d) if d == 0 then return end for i = 1, 30 do coroutine.resume(coroutine.create(f), d - 1) end end f(30))lua",
       1, stopped},
      {"length of two faces", false,
       R"lua(local n = 0 table.insert(setmetatable({}, { __len = function() n = n + 1 return n == 1 and 1 or 1 << 60 end }), 1, 1))lua",
       0, ""},
      {"sort long strings", false,
       R"lua(local a, t = ("\0"):rep(1e6), {} for i = 1, 2000 do t[i] = a end table.sort(t))lua", 1, stopped},
      {"compare zeros", false,
       R"lua(local a = ("\0"):rep(3e6) local b, c = a .. "b", a .. "c" while true do local x = b < c end)lua", 1,
       stopped},
      {"compare many zeros in coroutines", false,
       R"lua(while true do coroutine.wrap(function() local a = ("\0"):rep(2e7) local b, c = a .. "b", a .. "c" for i = 1, 100 do local x = b < c end end)() end)lua",
       1, stopped},
      {"unknown name in the depth", false,
       R"lua(local function f(n) if n == 0 then return undefinedname end return 1 + f(n - 1) end print(pcall(f, 30000)))lua",
       0, ""},
      {"unknown name among many", false,
       R"lua(for i = 1, 5e4 do rawset(_G, "x" .. ("y"):rep(90) .. i, i) end while true do pcall(function() return _G["y" .. ("x"):rep(90)] end) end)lua",
       1, stopped},
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
       1, stopped},
      {"names among locals", false, R"lua(local names = {} for i = 1, 190 do names[i] = "v" .. i end
print(load(("local function f() local " .. table.concat(names, ",") .. " "):rep(180) .. ("a=a "):rep(4e5) .. ("end "):rep(180))))lua",
       1, stopped},
      {"parameters that share choices", true,
       R"lua(local c, t = {}, {} for i = 1, 1e5 do c[i] = "c" .. i end for i = 1, 1000 do t["p" .. i] = { "c1", choices = c } end ricochet.parameters(t))lua",
       1, stopped},
      {"parameters that share a list", true,
       R"lua(local c, t = {}, {} for i = 1, 1e5 do c[i] = i end for i = 1, 1000 do t["p" .. i] = { c } end ricochet.parameters(t))lua",
       1, stopped},
      {"fields unknown", true,
       R"lua(local t = {} for i = 1, 2e4 do t[("x"):rep(90) .. i] = i end while true do pcall(ricochet.disk, t) end)lua",
       1, stopped},
      {"plot as an option", true,
       R"lua(ricochet.plot { x = "x", y = { "y" }, name = "-p", xrange = { 0, 1 }, theory = { y = function(x) return x end } } assert(ricochet.file.read("-p.png"):find "PNG"))lua",
       0, ""},
      {"deep values", true,
       R"lua(local t = {} for i = 1, 150 do t = { t } end ricochet.sweep { name = "s", over = { a = { 1 } }, scene = print }:at { a = t })lua",
       1, "more than 100 deep"},
      {"range without end", true, R"lua(ricochet.range(1e17, 1e17 + 100, 1e-3))lua", 1, "lost in rounding"},
      {"own results in the making", true, R"lua(ricochet.file.write("results.h5.new/x", "oops"))lua", 1,
       "that runs leave themselves"},
      {"core by a forged name and an own gsub", true,
       R"lua(string.gsub = function(s) return s end rawset(_G, "type", function() return "string" end)
local c = load("return require 'ricochet.core'", "@" .. [[)lua" RICOCHET_SOURCE
       R"lua(]] .. "/lua/ricochet/evil.lua")() c.gnuplot("p", "system 'touch ../../ESCAPED'\n"))lua",
       1, "is for the library alone"},
      {"bytecode past an own find", false,
       R"lua(string.find = print rawset(_G, "type", function() return "string" end) rawset(_G, "error", print)
load("\27Lua", "x", "b"))lua",
       1, "only text is accepted"},
      {"coroutine that goes on after each stop", false,
       R"lua(local f = coroutine.wrap(function() while true do pcall(coroutine.yield) end end) while true do pcall(f) end)lua",
       1, stopped},
      {"coroutine that resumes itself", false,
       R"lua(coroutine.wrap(function() while true do pcall(coroutine.resume, coroutine.running()) end end)())lua", 1,
       stopped},
      {"coroutine that is closed without end", false,
       R"lua(local co = coroutine.create(function() local x <close> = setmetatable({}, { __close = function() while true do pcall(error) end end }) coroutine.yield() end)
coroutine.resume(co) while true do pcall(coroutine.close, co) end)lua",
       1, stopped},
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

// What came of one of them.
struct Verdict {
  const Hostile* script;
  double seconds = 0;
  Ended ended;
  std::set<std::string> elsewhere;  ///< entries made outside its own folder
  bool secret_kept = false;
};

void judge(Verdict& verdict) {
  const Hostile& h = *verdict.script;
  const Workplace here;
  here.write("secret.txt", "hidden words");
  here.write("work/s.lua", (h.module ? "local ricochet = require \"ricochet\"\n" : "") + std::string(h.script));
  fs::create_directories(here.path / "work/out/s");
  for (const char* link : {"work/out/s/link.txt", "work/link.lua"})
    fs::create_symlink(here.path / "secret.txt", here.path / link);
  const auto before = entries(here.path);
  const auto began = std::chrono::steady_clock::now();
  // What ends by itself may take longer beside the others.
  const char* limit = h.words == stopped ? "1" : "50";
  verdict.ended = here.shell(
      fmt::format("cd work && timeout -s KILL 60 '" RICOCHET_PROGRAM "' run s.lua --max-seconds {} --resume", limit));
  verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  for (const std::string& entry : entries(here.path))
    if (!before.count(entry) && entry != "out.txt" && entry != "err.txt" && !entry.starts_with("work/out/s/"))
      verdict.elsewhere.insert(entry);
  const auto silent = [](const std::string& text) { return text.find("hidden words") == std::string::npos; };
  verdict.secret_kept =
      here.read("secret.txt") == "hidden words" && silent(verdict.ended.out) && silent(verdict.ended.err);
}

}  // namespace

TEST_CASE("hostile scripts are refused or bounded, and touch nothing") {
  constexpr int at_once = 6;  // most of them wait for their time to be up, some with 2 GiB
  std::vector<Verdict> verdicts;
  for (const Hostile& h : hostile_scripts()) verdicts.push_back({&h});
  REQUIRE(verdicts.size() >= 140);
  in_parallel(verdicts, at_once, judge);
  int held = 0;
  for (const auto& [script, seconds, ended, elsewhere, secret_kept] : verdicts) {
    INFO(script->name << " (" << seconds << " s, status " << ended.status << "): " << ended.err.substr(0, 1000));
    const bool right = ended.status == script->status && ended.err.find(script->words) != std::string::npos &&
                       (script->status == 0 || ended.err.starts_with("error: "));
    CHECK(right);
    held += right;
    CHECK(elsewhere == std::set<std::string>{});
    CHECK(secret_kept);
  }
  const auto slowest = std::max_element(verdicts.begin(), verdicts.end(),
                                        [](const Verdict& a, const Verdict& b) { return a.seconds < b.seconds; });
  fmt::print("{} of {} hostile scripts refused or bounded; the slowest took {:.1f} s ({})\n", held, verdicts.size(),
             slowest->seconds, slowest->script->name);
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
  CHECK_THAT(here.run("s.lua --resume").first_line(), Catch::Matchers::Contains("out/s/p.png is in the way"));
  here.write("out/s/run.files", "p.png\np.svg\n");  // as if a run had made them
  CHECK(here.run("s.lua --resume").status == 0);
  CHECK(here.read("mine.png") == "mine");
  CHECK(here.read("out/s/p.png").substr(1, 3) == "PNG");
}
