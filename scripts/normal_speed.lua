-- e and contact time against the speed of a smooth disk on a rigid plane, head on, beside the laws in two dimensions:
-- Hayakawa & Kuninaka 2003, section II B, eq. t_c, and Johnson's disk on a plane integrated. The plane repels each rim
-- node by V0 exp(-xi y); c is the sound speed sqrt(E/rho) of the disk's lattice, whose plane E is the theory's E*. A
-- row's contact_time_energy lasts while the repulsion holds 1e-6 of the energy. What its tail takes, before the
-- force on a node is what it is on average at the deepest point, is subtracted: a free flight over
-- ln(force/(1e-6 energy xi))/xi on either side.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  psi1 = false, roughness = false,
  speed   = { { 0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 0.6 }, unit = "c", min = 1e-4, max = 1.5, doc = "impact speeds" },
  samples = { 20, int = true, min = 1, doc = "random lattices per speed" },
  xi      = { 3000, unit = "1/R", min = 100, max = 7000,
    doc = "inverse range of the repulsion; a softer one adds to the contact" },
})

local function energy(speed) return p.nodes * speed ^ 2 / 2 end
local rows = ricochet.sweep {
  name = "normal_speed",
  over = { sample = ricochet.range(p.samples), speed = p.speed },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = p.nodes, mass = 1, stiffness = 1e4, placement = p.placement,
        seed = at.sample },
      target = ricochet.plane {},
      launch = { speed = at.speed },
      contact = { xi = p.xi, V0 = 2 * energy(at.speed), reach = 30 / p.xi, sides = "one" },
      method = p.method,
      step = p.step > 0 and p.step or nil,
      accuracy = p.step == 0 and p.accuracy > 0 and p.method == "auto" and p.accuracy or nil,
    }
  end,
}:run()

local material, theory = figures.material(p), ricochet.theory
local c = math.sqrt(material.E / material.rho)
local spacing = 2 * math.pi / math.ceil(math.sqrt(4 * math.pi * p.nodes))
for _, row in ipairs(rows) do
  local deepest = theory.disk_impact { R = 1, E = material.E, nu = 0, rho = material.rho, v = row.speed }
  local force = deepest.F / math.max(1, 2 * deepest.a / spacing)
  local tail = math.log(force / (1e-6 * energy(row.speed) * p.xi)) / p.xi
  row.v = row.speed / c
  row.t_c = (row.contact_time_energy - tail / row.speed * (1 + 1 / row.e)) * c
  row.tail = tail / row.speed * (1 + 1 / row.e) / row.contact_time_energy
end
rows:summary { by = "v", of = { "e", "t_c", "tail" } }:print()

local function log_law(v) return theory.disk_log_law { R = 1, E = 1, nu = 0, rho = 1, v = v }.t_c end
local function johnson(v) return theory.disk_impact { R = 1, E = 1, nu = 0, rho = 1, v = v }.t_c end
for _, line in ipairs(rows:summary { by = "v", of = { "t_c" } }) do
  print(("v = %.4f c: t_c c/R = %.3f, log law %.3f (%+.1f %%), Johnson integrated %.3f (%+.1f %%)"):format(line.v,
    line.t_c.mean, log_law(line.v), 100 * (log_law(line.v) / line.t_c.mean - 1),
    johnson(line.v), 100 * (johnson(line.v) / line.t_c.mean - 1)))
end
-- The dissipative law's tau0 by least squares of 1 - e = (pi/2) tau0 / sqrt(ln(4c/v)), below 0.05 c: at 0.09 c six
-- lattices of twenty lose far more (e < 0.95).
local xy, xx = 0, 0
for _, row in ipairs(rows) do
  local x = math.pi ^ 2 / 2 / log_law(row.v)
  if row.e == row.e and row.v < 0.05 then xy, xx = xy + x * (1 - row.e), xx + x * x end
end
local tau0 = math.max(0, xx > 0 and xy / xx or 0)
local function dissipative(v) return theory.disk_log_law { R = 1, E = 1, nu = 0, rho = 1, v = v, tau0 = tau0 }.e end
print(("dissipative law fitted: tau0 = %.4f R/c"):format(tau0))
figures.compare(rows, "v", "e", "dissipative law", dissipative)
ricochet.plot {
  rows = rows, x = "v", y = { "e", "t_c" }, name = "normal_speed", log = "x",
    xlabel = "v / c, c = sqrt(E / ρ) of the disk", ylabel = { t_c = "t_c c / R" },
  theory = { e = { { name = ("dissipative law, τ0 = %.3f R/c"):format(tau0), f = dissipative } },
             t_c = { { name = "eq. t_c", f = log_law }, { name = "Johnson's law integrated", f = johnson } } },
  title = "Smooth disk on a rigid plane, head on",
  caption = ("Disk of %d nodes (%s), E = %.3g m0c²/R², ξ = %g/R, %d lattices a speed. Contact times less the " ..
    "repulsion's tail."):format(p.nodes, p.placement, material.E, p.xi, p.samples),
}
