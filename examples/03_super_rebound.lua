-- A disk leaves a soft rough wall faster along the normal than it came: e > 1. The ledger shows what pays for it, the
-- tangential motion. Of some random lattices the one with the greatest e is drawn (Hayakawa & Kuninaka 2003, section V:
-- single samples far above 1 at oblique incidence).
local ricochet = require "ricochet"

local p = ricochet.parameters {
  psi1    = { 6, min = 0, max = 20, doc = "tangent of the incident angle" },
  samples = { 24, int = true, min = 1, max = 10000, doc = "random lattices to choose from" },
  nodes   = { 800, int = true, min = 50, max = 20000, doc = "nodes of the disk; the wall has five times as many" },
  frames  = { 240, int = true, min = 2, max = 10000, doc = "pictures of the animation" },
}

local function scene(seed)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", roughness = 0.03, seed = seed },
    target = ricochet.wall { nodes = 5 * p.nodes, stiffness = 100, placement = "poisson_disk", roughness = 0.03,
      seed = seed },
    launch = { speed = 0.1, psi1 = p.psi1 },
    accuracy = 1e-3,
  }
end

local rows = ricochet.sweep { name = "03_super_rebound", over = { sample = ricochet.range(p.samples) },
  scene = function(at)
    return scene(at.sample)
  end }:run()
local best, above = nil, 0
for _, row in ipairs(rows) do
  if row.status == "finished" then
    if row.e > 1 then above = above + 1 end
    if not best or row.e > best.e then best = row end
  end
end
if not best then print "no impact finished" return end
local sum = function(row, when) return row[when .. "_projectile_translation"] end
print(("e > 1 in %d of %d lattices; the greatest: e = %.3f, lattice %d"):format(above, #rows, best.e, best.sample))
print(("there the translation keeps %.1f %% of its energy: no energy is made"):format(100 * sum(best,
  "after") / sum(best, "before")))
local show = { title = ("Super rebound: e = %.2f at Ψ1 = %g"):format(best.e, p.psi1), ledger = true, plot = "vn",
  trail = true, forces = true, velocity = true }
ricochet.animate { scene = scene(best.sample), frames = p.frames, slow_motion = 3, show = show }
ricochet.still { scene = scene(best.sample), show = show, out = "tightest", size = { 800, 450 } }
