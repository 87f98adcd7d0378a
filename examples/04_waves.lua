-- Elastic waves in a wall that a disk strikes: the speed of the nodes as colour. A pressure wave runs ahead, a shear
-- wave follows, and along the surface a Rayleigh wave; the absorbing layer at the held edges swallows them, as a
-- half-space would.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed  = { 0.05, unit = "c", min = 1e-3, max = 0.3, doc = "impact speed" },
  nodes  = { 9000, int = true, min = 200, max = 100000, doc = "nodes of the wall" },
  frames = { 240, int = true, min = 2, max = 10000, doc = "pictures of the animation" },
  absorb = { true, doc = "whether the edges absorb" },
}

local scene = ricochet.scene {
  projectile = ricochet.disk { nodes = 300, placement = "poisson_disk", stiffness = 1e4, seed = 1 },
  target = ricochet.wall { width = 12, depth = 5, nodes = p.nodes, stiffness = 1e3, placement = "poisson_disk",
    seed = 1 },
  launch = { speed = p.speed },
  effects = p.absorb and { ricochet.absorbing { width = 1.2, rate = 4 } } or nil,
}
local show = { title = "Elastic waves below an impact", material = "speed", springs = "none", scale = "sqrt",
  high = 0.4 * p.speed, plot = "force_n", fronts = true }
local row = ricochet.animate { scene = scene, frames = p.frames, duration = 9, show = show }
print(("e = %.3f: the rest of the energy left as waves and vibration"):format(row.e))
ricochet.contact_sheet { scene = scene, times = { 1.5, 2.5, 3.5, 4.5 }, columns = 2, out = "moments",
  size = { 800, 450 }, show = { material = "speed", springs = "none", scale = "sqrt", high = 0.4 * p.speed,
    fronts = true } }
