-- A brittle disk on a hard wall: springs break when drawn out too far, and what they held is lost. Pictures of one
-- impact, then e against speed.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed   = { { 0.05, 0.075, 0.1, 0.15, 0.2 }, unit = "c", min = 1e-4, doc = "impact speed" },
  strain  = { 0.02, min = 1e-6, doc = "stretch over rest length beyond which a spring breaks" },
  samples = { 8, int = true, min = 1, doc = "lattices" },
  nodes   = { 300, int = true, min = 30, doc = "of the disk; the wall has twice as many" },
  frames  = { 40, int = true, min = 2, doc = "pictures of the fastest impact" },
}

local function scene(speed, sample)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", seed = sample },
    target = ricochet.wall { nodes = 2 * p.nodes, width = 4, depth = 1.5, stiffness = 1e5, placement = "poisson_disk",
      seed = sample },
    launch = { speed = speed }, contact = { sides = "two" }, effects = { ricochet.breaking { strain = p.strain } },
  }
end
local rows = ricochet.sweep {
  name = "breaking",
  over = { sample = ricochet.range(p.samples), speed = p.speed },
  scene = function(at) return scene(at.speed, at.sample) end,
}:run()
rows:summary { by = "speed", of = { "e", "breaking_springs", "breaking_energy" } }:print()
ricochet.plot { rows = rows, x = "speed", y = { "e", "breaking_springs" }, log = "x", name = "breaking",
  xlabel = "impact speed [c]", title = ("A disk whose springs break at a strain of %g"):format(p.strain) }
ricochet.animate { scene = scene(p.speed[#p.speed], 1), frames = p.frames, duration = 6, size = { 640, 480 } }
