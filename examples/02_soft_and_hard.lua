-- The same disk strikes a soft and a hard wall, side by side on one clock: the soft one gives way for long, the hard
-- one throws the disk back at once.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  soft   = { 0.01, min = 1e-4, max = 1, doc = "stiffness of the soft wall over the disk's" },
  hard   = { 10, min = 1, max = 1e4, doc = "stiffness of the hard wall over the disk's" },
  psi1   = { 1, min = 0, max = 10, doc = "tangent of the incident angle" },
  nodes  = { 500, int = true, min = 50, max = 20000, doc = "nodes of the disk; each wall has five times as many" },
  frames = { 240, int = true, min = 2, max = 10000, doc = "pictures of the animation" },
  film   = { "", doc = "name of an .mp4 file to make as well, e.g. impact.mp4 (needs ffmpeg)" },
}

local function scene(ratio)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", roughness = 0.03, seed = 1 },
    target = ricochet.wall { width = 6, nodes = 5 * p.nodes, stiffness = 1e4 * ratio, placement = "poisson_disk",
      roughness = 0.03, seed = 1 },
    launch = { psi1 = p.psi1 },
    accuracy = 1e-3,
  }
end

local scenes, titles = { scene(p.soft), scene(p.hard) },
  { ("wall %g times as stiff"):format(p.soft), ("wall %g times as stiff"):format(p.hard) }
local show = { material = "speed", scale = "sqrt", velocity = true, trail = true, ledger = true,
  title = "One disk, two walls" }
local rows = ricochet.animate { scenes = scenes, titles = titles, frames = p.frames, duration = 14, show = show,
  out = "frames", film = p.film ~= "" and p.film or nil }
for i, row in ipairs(rows) do
  print(("%s: e = %.3f, in contact for %.2f R/c, %.3f R deep"):format(titles[i], row.e, row.contact_time,
    row.indentation))
end
ricochet.contact_sheet { scenes = scenes, titles = { "soft", "hard" }, moments = 3, out = "moments",
  size = { 800, 400 }, show = { material = "speed", scale = "sqrt" } }
