-- e and contact time against the speed of a smooth disk on a rigid plane, head on, beside the laws in two dimensions:
-- Hayakawa & Kuninaka 2003, section II B, eq. t_c, and Johnson's disk on a plane integrated. c is the sound speed
-- sqrt(E/rho) of the disk's lattice, whose plane E is the theory's E*. The lattices are triangular, each turned by an
-- angle of its own: random ones fold at the fastest speed (`placement=poisson_disk` shows it), and what folds loses
-- energy that no elastic disk would. The contact is the program's own, as hard as each speed needs.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  psi1 = false, standard_error = false, seeds = false, roughness = false, accuracy = false, step = false,
  method = false,
  speed     = { { 0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 0.6 }, unit = "c", min = 1e-4, max = 1.5, doc = "impact speeds" },
  samples   = { 20, int = true, min = 1, doc = "lattices per speed" },
  nodes     = { 1600, int = true, min = 40, doc = "of the disk" },
  placement = { "triangular", choices = { "triangular", "poisson_disk", "uniform" }, doc = "how the nodes are placed" },
})

local stiffness, density = 1e4, 800 / math.pi  -- of springs [m0 c^2/R^2], and the disk's [m0/R^2]

local rows = ricochet.sweep {
  name = "normal_speed",
  over = { sample = ricochet.range(p.samples), speed = p.speed },
  scene = function(at)
    local disk = ricochet.disk { nodes = p.nodes, density = density, stiffness = stiffness, placement = p.placement,
      seed = at.sample }
    return ricochet.scene {
      projectile = ricochet.rotated { body = disk, angle = 137.508 * at.sample },  -- no two alike
      target = ricochet.plane {},
      launch = { speed = at.speed },
    }
  end,
}:run()

local E = figures.material(p, p.nodes, stiffness).E
local c = math.sqrt(E / density)
for _, row in ipairs(rows) do
  row.v, row.t_c = row.speed / c, row.contact_time * c
end
rows:summary { by = "v", of = { "e", "t_c", "folded", "inverted" } }:print()

local theory = ricochet.theory
local function log_law(v) return theory.disk_log_law { R = 1, E = 1, nu = 0, rho = 1, v = v }.t_c end
local function johnson(v) return theory.disk_impact { R = 1, E = 1, nu = 0, rho = 1, v = v }.t_c end
for _, line in ipairs(rows:summary { by = "v", of = { "t_c", "error_contact_time", "contact_length" } }) do
  print(("v = %.4f c: t_c c/R = %.3f, log law %.3f (%+.1f %%), Johnson integrated %.3f (%+.1f %%); a hard contact " ..
    "would be up to %.1f %% shorter"):format(line.v, line.t_c.mean, log_law(line.v),
    100 * (log_law(line.v) / line.t_c.mean - 1), johnson(line.v), 100 * (johnson(line.v) / line.t_c.mean - 1),
    100 * line.error_contact_time.mean * c / line.t_c.mean))
end
-- The dissipative law's tau0 by least squares of 1 - e = (pi/2) tau0 / sqrt(ln(4c/v)).
local xy, xx = 0, 0
for _, row in ipairs(rows) do
  local x = math.pi ^ 2 / 2 / log_law(row.v)
  if row.e == row.e then xy, xx = xy + x * (1 - row.e), xx + x * x end
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
  caption = ("Disk of %d nodes (%s), E = %.3g m0c²/R², %d lattices a speed."):format(p.nodes, p.placement, E,
    p.samples),
}
