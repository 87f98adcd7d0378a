-- One smooth disk by the paper's three approaches, head on to a rigid plane: a lattice of springs (triangular, Poisson
-- disks, uniformly random points), finite elements (of small strain and of any), and vibrations (those of a mesh, and
-- the disk's own in closed form). What do they agree on, and what does an impact cost? Speeds are over c_P =
-- sqrt(E / (rho (1 - nu^2))) of each body, contact 1/xi = R/1000 for all. `samples`: lattices of random points a speed.
-- `full=true`: finer meshes, twice the speeds and 12 lattices, a minute on two cores.
local ricochet = require "ricochet"
local moduli = require "ricochet.moduli"
local rows_of = require("ricochet.rows").rows_of
local statistics = require "ricochet.statistics"

local p = ricochet.parameters {
  speed   = { { 0.003, 0.01, 0.02, 0.05, 0.1, 0.2 }, unit = "c_P", min = 1e-3, max = 0.3, doc = "rising" },
  samples = { 4, int = true, min = 1, doc = "lattices of random points a speed" },
  nodes   = { 800, int = true, min = 100, doc = "of lattices and of the body of modes" },
  h_min   = { 0.02, unit = "R", min = 0.005, max = 0.1, doc = "side of the smallest elements; half with full=true" },
  xi      = { 1000, unit = "1/R", min = 50, doc = "hardness of the contact, for all" },
  full    = { false, doc = "the figure in full" },
}
local speeds, samples, h_min, omega_most = p.speed, p.samples, p.h_min, 60
if p.full then
  speeds, samples, h_min, omega_most = { 0.003, 0.005, 0.01, 0.015, 0.02, 0.03, 0.05, 0.07, 0.1, 0.14, 0.2 }, 12,
    p.h_min / 2, 80
end

local k, density = 1e4, 800 / math.pi

-- Every kind of body, with its moduli; elements and modes take those of triangles of equal springs, nu = 1/3.
local E = 2 / math.sqrt(3) * k
local kinds, order = {}, {}
local function kind(name, fields, E, nu)
  kinds[name] = { fields = fields, E = E, nu = nu, c_P = math.sqrt(E / (density * (1 - nu ^ 2))) }
  order[#order + 1] = name
end
for _, placement in ipairs { "triangular", "poisson_disk", "uniform" } do
  local lattice = { placement = placement, nodes = p.nodes, stiffness = k, quartic = 0 }
  local stuff = { interior = "springs", placement = placement, stiffness = k, quartic = 0 }
  kind("lattice, " .. placement, lattice, moduli.of(stuff, p.nodes / math.pi))
end
for _, law in ipairs { "linear", "polynomial" } do
  kind("elements, " .. law, { interior = "elements", E = E, nu = 1 / 3, law = law, h_min = h_min }, E, 1 / 3)
end
kind("modes", { interior = "modes", E = E, nu = 1 / 3, nodes = p.nodes }, E, 1 / 3)

local function scene(name, v, sample)
  local fields = { density = density, seed = sample }
  for field, value in pairs(kinds[name].fields) do fields[field] = value end
  local disk = ricochet.disk(fields)
  if fields.placement == "triangular" then disk = ricochet.rotated { body = disk, angle = 137.508 * sample } end
  return ricochet.scene { projectile = disk, target = ricochet.plane {}, contact = { xi = p.xi },
    launch = { speed = v * kinds[name].c_P } }
end

local lattices, smooth = { table.unpack(order, 1, 3) }, { table.unpack(order, 4) }
local rows = ricochet.sweep {
  name = "lattices", over = { sample = ricochet.range(samples), kind = lattices, v = speeds },
  scene = function(at) return scene(at.kind, at.v, at.sample) end,
}:run()
local of_smooth = ricochet.sweep {
  name = "smooth", over = { kind = smooth, v = speeds }, scene = function(at) return scene(at.kind, at.v, 1) end,
}:run()

local exact = {}
local function by_modes(nu, v)
  local key = ("%.6f %g"):format(nu, v)
  exact[key] = exact[key] or ricochet.theory.modal_disk { nu = nu, speed = v, alpha = p.xi, omega_most = omega_most }
  return exact[key]
end

local all = rows_of {}
for _, list in ipairs { rows, of_smooth } do
  for _, row in ipairs(list) do
    local of = kinds[row.kind]
    row.t_c, row.seconds = row.contact_time_energy * of.c_P, row.wall_seconds
    row.off = math.abs(row.e - by_modes(of.nu, row.v).e)
    all[#all + 1] = row
  end
end

print(("%-22s %10s %7s %7s"):format("", "E", "nu", "c_P"))
for _, name in ipairs(order) do
  print(("%-22s %10.0f %7.4f %7.4f"):format(name, kinds[name].E, kinds[name].nu, kinds[name].c_P))
end
print(("%-22s %8s %9s %8s %9s %9s %9s %9s"):format("", "v / c_P", "e", "+-", "- exact", "t_c", "- exact %", "inverted"))
for _, name in ipairs(order) do
  for _, v in ipairs(speeds) do
    local here = {}
    for _, row in ipairs(all) do
      if row.kind == name and row.v == v then here[#here + 1] = row end
    end
    local e, t_c = statistics.of_finished(here, "e"), statistics.of_finished(here, "t_c")
    local modes = by_modes(kinds[name].nu, v)
    local error = e.count > 1 and ("%.5f"):format(e.se) or "-"
    print(("%-22s %8.3g %9.5f %8s %+9.5f %9.4f %+9.2f %9.4f"):format(name, v, e.mean, error, e.mean - modes.e,
      t_c.mean, 100 * (t_c.mean / modes.contact_time - 1), statistics.of_finished(here, "inverted").mean))
  end
end

local e_line = { name = "modes in closed form, ν = 1/3", points = {} }
local t_line = { name = e_line.name, points = {} }
for i, v in ipairs(speeds) do
  local modes = by_modes(1 / 3, v)
  e_line.points[i], t_line.points[i] = { v, modes.e }, { v, modes.contact_time }
end
ricochet.plot {
  rows = all, x = "v", y = { "e", "t_c" }, by = "kind", name = "three_approaches", log = "x", xlabel = "v / c_P",
  ylabel = { t_c = "t_c c_P / R, by the share of energy" },
  theory = { e = e_line, t_c = { t_line, { name = "log law, eq. t_c", f = function(v)
    return ricochet.theory.disk_log_law { R = 1, E = 1, nu = 0, rho = 1, v = v }.t_c
  end } } },
  title = "One smooth disk by three approaches, head on to a rigid plane",
  caption = ("Lattices of %d nodes, elements from %g R on, contact exp(−%g y/R)."):format(p.nodes, h_min, p.xi),
}
ricochet.plot {
  rows = all, x = "v", y = { "off", "seconds" }, by = "kind", name = "three_approaches_cost", log = "xy",
  xlabel = "v / c_P", ylabel = { off = "|e − e of the modes at the same ν|", seconds = "seconds of a core, an impact" },
  title = "What each approach is off by, and what it costs",
  caption = "Making lattices and meshes and finding modes takes its time once, beside these.",
}
ricochet.compare { scene = scene(order[1], 0.02, 1), elements = { h_min = h_min, law = "linear" },
  omega_most = omega_most, name = "three_approaches_at_0_02" }
