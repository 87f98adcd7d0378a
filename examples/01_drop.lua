-- A small hard disk drops on a soft block and bounces: frames to look at, and how e depends on the speed.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed  = { 0.1, unit = "c", min = 0.001, max = 0.5, doc = "impact speed of the animation" },
  psi1   = { 1, min = 0, max = 10, doc = "tangent of its incident angle" },
  nodes  = { 200, int = true, min = 50, max = 5000, doc = "nodes of the disk; the block has five times as many" },
  frames = { 60, int = true, min = 2, max = 10000, doc = "pictures of the animation" },
}

local disk = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", roughness = 0.02, seed = 1 }
local block = ricochet.wall { width = 8, depth = 2, nodes = 5 * p.nodes, stiffness = 100, placement = "poisson_disk",
  roughness = 0.02, seed = 1 }

local function scene(speed)
  return ricochet.scene { projectile = disk, target = block, launch = { speed = speed, psi1 = p.psi1 } }
end

local row = ricochet.animate { scene = scene(p.speed), frames = p.frames, size = { 960, 540 } }
print(("bounced with e = %.3f after a contact of %.1f R/c, %.2f R deep"):format(row.e, row.contact_time,
  row.indentation))

local rows = ricochet.sweep {
  name = "01_drop",
  over = { speed = { 0.02, 0.05, 0.1, 0.15, 0.2 } },
  scene = function(at) return scene(at.speed) end,
}:run()
ricochet.plot { rows = rows, x = "speed", y = { "e", "contact_time" }, name = "drop",
  title = "A disk dropped on a soft block", xlabel = "speed [c]" }
