-- "Gravity and dissipation do not matter at 0.1 c" (Hayakawa & Kuninaka 2003, section V): what each changes of e, beta
-- and mu of the paper's scene beside the sampling error, then the speeds at which each may.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"
local student = require "ricochet.student"

local p = ricochet.parameters {
  speed   = { { 0.005, 0.01, 0.02, 0.05, 0.1, 0.2 }, unit = "c", min = 1e-3, doc = "impact speeds" },
  g       = { 1e-5, unit = "c^2/R", min = 0, doc = "acceleration; of a steel disk of 5 cm, 9.8 m/s^2 are about 5e-8" },
  tau     = { 1e-3, unit = "R/c", min = 0, doc = "retardation time of the material; of steel less" },
  wanted  = { 0.01, min = 1e-9, doc = "a change of e that matters" },
  samples = { 8, int = true, min = 2, doc = "lattices" },
  nodes   = { 400, int = true, min = 60, doc = "of the disk; the wall has five times as many" },
}

local function scene(speed)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = p.nodes, mass = 1, placement = "poisson_disk", roughness = 0.03, seed = 1 },
    target = ricochet.wall { nodes = 5 * p.nodes, mass = 1, stiffness = 100, placement = "poisson_disk",
      roughness = 0.03,
      seed = 1 },
    launch = { speed = speed, psi1 = 1 },
    contact = figures.contact,
  }
end

local may, not_yet, names = {}, {}, {}  -- [effect]: speeds at which e may change as much, and may not; names in order
for _, speed in ipairs(p.speed) do
  print(("impact speed %g c"):format(speed))
  local found = ricochet.relevance {
    scene = scene(speed), samples = p.samples,
    effects = { ricochet.gravity { g = p.g }, ricochet.damping { time = p.tau },
      ricochet.absorbing { width = 1, rate = 5 } },
  }
  for _, effect in ipairs(found or {}) do
    if not may[effect.name] then may[effect.name], not_yet[effect.name], names[#names + 1] = {}, {}, effect.name end
    local half_width = student.quantile(effect.e.count - 1) * effect.e.se  -- of the 95 % interval
    local reached = not (math.abs(effect.e.change) + half_width < p.wanted)
    table.insert(reached and may[effect.name] or not_yet[effect.name], ("%g"):format(speed))
  end
end

local function list(speeds) return #speeds > 0 and table.concat(speeds, ", ") .. " c" or "none of these speeds" end
for _, name in ipairs(names) do
  print(("%-10s may change the mean e by %g or more at %s; stays below it, by its 95 %% interval, at %s"):format(name,
    p.wanted, list(may[name]), list(not_yet[name])))
end
