-- A ball falls onto a wall three times: each time some of its energy stays behind as waves in the wall and as vibration
-- of the ball, so that it rises less high. The animated picture is that of the README. Some seconds.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed  = { 0.1, unit = "c", min = 1e-3, max = 0.3, doc = "speed of the first impact" },
  g      = { 1.6e-3, unit = "c^2/R", min = 1e-6, max = 0.1, doc = "acceleration" },
  frames = { 150, int = true, min = 2, max = 10000, doc = "pictures of the animation" },
  until_ = { 290, unit = "R/c", min = 1, max = 1e5, doc = "when it ends" },
  film   = { "bounces.gif", doc = "a .gif, .apng or .mp4 file (needs ffmpeg); none: pictures" },
}

local scene = ricochet.scene {
  projectile = ricochet.disk { nodes = 200, placement = "poisson_disk", seed = 1 },
  target = ricochet.wall { width = 9, depth = 3, nodes = 2000, stiffness = 100, placement = "poisson_disk", seed = 1 },
  launch = { speed = p.speed },
  effects = { ricochet.gravity { g = p.g }, ricochet.absorbing { width = 1.5, rate = 4 } },
  time_limit = 2 * p.until_,
}
local row = ricochet.animate { scene = scene, frames = p.frames, duration = p.until_, rate = 15, size = { 480, 400 },
  film = p.film ~= "none" and p.film or nil,
  show = { material = "energy_density", springs = "none", plot = "height", high = 0.15,
    title = "A ball bounces, and its waves run into the wall" } }
print(("e of the first impact: %.3f"):format(row.e))
