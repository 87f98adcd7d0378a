-- A sticky, viscous disk on a hard wall: attraction takes from slow impacts what they need to part, and below some
-- speed the disk stays.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed    = { { 0.003, 0.005, 0.01, 0.02, 0.05, 0.1 }, unit = "c", min = 1e-4, doc = "impact speed" },
  strength = { { 0, 3, 6 }, unit = "m0 c^2", min = 0, doc = "of the attraction at distance 0" },
  samples  = { 4, int = true, min = 1, doc = "lattices" },
}

local viscous = ricochet.damping { time = 5e-3, on = "projectile" }
local rows = ricochet.sweep {
  name = "adhesion",
  over = { sample = ricochet.range(p.samples), speed = p.speed, strength = p.strength },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = 200, placement = "poisson_disk", seed = at.sample },
      target = ricochet.wall { nodes = 600, width = 4, depth = 1.5, stiffness = 1e4, placement = "poisson_disk",
        seed = at.sample },
      launch = { speed = at.speed }, contact = { xi = 300, V0 = 150, reach = 0.15 }, time_limit = 100,
      effects = at.strength > 0 and { ricochet.adhesion { strength = at.strength, xi = 150 }, viscous } or { viscous },
    }
  end,
}:run()
-- What has not parted after 100 R/c sticks: out_of_time.
for _, row in ipairs(rows) do row.stuck = row.status == "out_of_time" and 1 or 0 end
for _, strength in ipairs(p.strength) do
  local of_it = rows:where { strength = strength }
  local stuck = 0
  for _, row in ipairs(of_it) do stuck = stuck + row.stuck end
  print(("strength %g: %d of %d stick"):format(strength, stuck, #of_it))
  of_it:summary { by = "speed", of = { "e", "contact_time" } }:print()
end
ricochet.plot { rows = rows, x = "speed", y = { "e" }, by = "strength", log = "x", name = "adhesion",
  xlabel = "impact speed [c]", title = "A sticky disk on a hard wall" }
