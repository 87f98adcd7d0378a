-- A disk that flies through a medium on to a wall and back. What drag takes depends on how long the impact lasts, and
-- that hardly depends on the speed.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed   = { { 0.01, 0.02, 0.05, 0.1 }, unit = "c", min = 1e-4, doc = "speed as the rims come within reach" },
  rate    = { { 0, 1e-3, 1e-2 }, unit = "c/R", min = 0, doc = "share of the velocity lost in a unit of time" },
  samples = { 4, int = true, min = 1, doc = "lattices" },
}

local rows = ricochet.sweep {
  name = "drag",
  over = { sample = ricochet.range(p.samples), speed = p.speed, rate = p.rate },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = 200, placement = "poisson_disk", seed = at.sample },
      target = ricochet.wall { nodes = 800, width = 6, depth = 2, stiffness = 1e4, placement = "poisson_disk",
        seed = at.sample },
      launch = { speed = at.speed }, effects = { ricochet.drag { rate = at.rate } },
    }
  end,
}:run()
rows:where { rate = p.rate[#p.rate] }:summary { by = "speed", of = { "e", "time", "drag_energy" } }:print()
ricochet.plot { rows = rows, x = "speed", y = { "e" }, by = "rate", log = "x", name = "drag", xlabel = "speed [c]",
  title = "A disk that hits a wall in a medium" }
