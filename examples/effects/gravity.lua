-- A disk falls on a soft wall under gravity. e is that of the velocity at the first touch, so that the fall before it
-- is left out: what is left is the weight that acts in the impact, and it is nothing beside the force of the impact.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed   = { { 0.01, 0.02, 0.04, 0.08 }, unit = "c", min = 1e-4, doc = "speed as the rims come within reach" },
  g       = { 1e-5, unit = "c^2/R", min = 0, doc = "acceleration" },
  samples = { 4, int = true, min = 1, doc = "lattices" },
  nodes   = { 200, int = true, min = 30, doc = "of the disk; the wall has four times as many" },
}

local rows = ricochet.sweep {
  name = "gravity",
  over = { sample = ricochet.range(p.samples), speed = p.speed, weight = { "without", "with" } },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", seed = at.sample },
      target = ricochet.wall { nodes = 4 * p.nodes, width = 6, depth = 2, stiffness = 1000, placement = "poisson_disk",
        seed = at.sample },
      launch = { speed = at.speed }, method = "pefrl",
      effects = at.weight == "with" and { ricochet.gravity { g = p.g } } or {},
    }
  end,
}:run()

local without = {}
for _, row in ipairs(rows:where { weight = "without" }) do without[row.sample .. " " .. row.speed] = row.e end
local heavy = rows:where { weight = "with" }
for _, row in ipairs(heavy) do row.change = math.abs(row.e - without[row.sample .. " " .. row.speed]) end
heavy:summary { by = "speed", of = { "e", "change", "contact_time" } }:print()
local law = heavy:power_law { x = "speed", y = "change" }
print(("change of e ~ v^(%.2f +- %.2f)"):format(law.exponent, law.se))
ricochet.plot { rows = heavy, x = "speed", y = { "change", "contact_time" }, log = "xy", name = "gravity",
  xlabel = "speed [c]", title = ("What gravity, g = %g c²/R, changes of e"):format(p.g) }
