-- A sweep of very many points: tiny disks on a rigid plane, whose impacts end at once, so that what a sweep costs
-- beside its impacts shows. 10,000 points; a million with samples=1000.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples = { 10, int = true, min = 1, doc = "lattices" },
  angles  = { 100, int = true, min = 1, doc = "angles of impact" },
  time    = { 0.2, unit = "R/c", min = 1e-3, doc = "when an impact ends, since the surfaces came within reach" },
}

local psi1 = {}
for i = 1, p.angles do psi1[i] = 3 * i / p.angles end

local rows = ricochet.sweep {
  name = "many_points",
  over = { sample = ricochet.range(p.samples), psi1 = psi1, v = ricochet.range(0.01, 0.1, 0.01) },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = 12, seed = at.sample },
      target = ricochet.plane {},
      launch = { speed = at.v, psi1 = at.psi1 },
      ending = { at = "time", time = p.time },
    }
  end,
}:run()

local sum = 0
for _, row in ipairs(rows) do sum = sum + row.psi1 * row.time end
print(("%d rows, of which the sum of psi1 times time is %.10g"):format(#rows, sum))
