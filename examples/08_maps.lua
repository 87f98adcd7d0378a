-- How e is spread over random rims, and how its mean changes with speed and angle: a histogram for each angle, and a
-- heat map over both.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples = { 16, int = true, min = 1, max = 10000, doc = "random rims and lattices for each speed and angle" },
  nodes   = { 150, int = true, min = 50, max = 20000, doc = "nodes of the disk; the wall has four times as many" },
  psi1    = { { 0, 1, 2, 4 }, min = 0, max = 10, doc = "tangents of the incident angle" },
  speed   = { { 0.02, 0.04, 0.08, 0.16 }, unit = "c", min = 1e-3, max = 0.3, doc = "impact speeds" },
}

local rows = ricochet.sweep {
  name = "maps",
  over = { speed = p.speed, psi1 = p.psi1, sample = ricochet.range(p.samples) },
  units = { speed = "c" },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = p.nodes, roughness = 0.03, seed = at.sample },
      target = ricochet.wall { width = 5, depth = 2, nodes = 4 * p.nodes, stiffness = 1e4, roughness = 0.03,
        seed = at.sample },
      launch = { speed = at.speed, psi1 = at.psi1 },
      accuracy = 1e-2,
    }
  end,
}:run()
ricochet.heat_map { rows = rows, x = "speed", y = "psi1", of = "e", log = "x", name = "map",
  title = "Mean e of a rough disk on a rough wall" }
ricochet.histogram { rows = rows, of = "e", by = "psi1", name = "spread", title = "How e is spread, by angle" }
