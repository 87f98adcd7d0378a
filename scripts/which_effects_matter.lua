-- "Gravity and dissipation do not matter at 0.1 c" (Hayakawa & Kuninaka 2003, section V): what each changes of e, beta and mu of the paper's scene
-- beside the sampling error, then the speed below which each would.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed   = { { 0.02, 0.05, 0.1, 0.2 }, unit = "c", min = 1e-3, doc = "impact speeds" },
  g       = { 1e-5, unit = "c^2/R", min = 0, doc = "acceleration; of a steel disk of 5 cm, 9.8 m/s^2 are about 5e-8" },
  tau     = { 1e-3, unit = "R/c", min = 0, doc = "retardation time of the material; of steel less" },
  wanted  = { 0.01, min = 1e-9, doc = "a change of e that matters" },
  samples = { 4, int = true, min = 2, doc = "lattices" },
  nodes   = { 400, int = true, min = 60, doc = "of the disk; the wall has five times as many" },
}

local function scene(speed)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", roughness = 0.03, seed = 1 },
    target = ricochet.wall { nodes = 5 * p.nodes, stiffness = 100, placement = "poisson_disk", roughness = 0.03, seed = 1 },
    launch = { speed = speed, psi1 = 1 },
  }
end

local changes, names = {}, {}  -- [effect]: list of { speed, change }; names in order
for _, speed in ipairs(p.speed) do
  print(("impact speed %g c"):format(speed))
  local found = ricochet.relevance {
    scene = scene(speed), samples = p.samples,
    effects = { ricochet.gravity { g = p.g }, ricochet.damping { time = p.tau }, ricochet.absorbing { width = 1, rate = 5 } },
  }
  for _, effect in ipairs(found or {}) do
    if not changes[effect.name] then changes[effect.name], names[#names + 1] = {}, effect.name end
    table.insert(changes[effect.name], { speed, math.abs(effect.e.change) })
  end
end

-- |change of e| = a v^b through the points, by least squares of the logarithms; below or above which speed it passes what is wanted.
for _, name in ipairs(names) do
  local points = changes[name]
  local n, x, y, xx, xy = #points, 0, 0, 0, 0
  for _, point in ipairs(points) do x, y = x + math.log(point[1]) / n, y + math.log(point[2]) / n end
  for _, point in ipairs(points) do xx, xy = xx + (math.log(point[1]) - x) ^ 2, xy + (math.log(point[1]) - x) * (math.log(point[2]) - y) end
  if n > 1 then
    local b = xy / xx
    local threshold = math.exp(x + (math.log(p.wanted) - y) / b)
    print(("%-10s |change of e| ~ v^%.2f; it is %g at %.2g c and grows %s that speed"):format(name, b, p.wanted, threshold, b < 0 and "below" or "above"))
  end
end
