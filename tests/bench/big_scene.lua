-- One impact of a million nodes, a few hundred steps of it. `./workbench bench threads` runs it on one thread, twice at
-- once on one each, and on two, and tells what the second thread is worth.
local ricochet = require "ricochet"

local given = ricochet.parameters { nodes = 1000000, steps = 400 }

local disk = ricochet.disk { nodes = given.nodes // 5, placement = "triangular", seed = 1 }
local wall = ricochet.wall { nodes = 4 * given.nodes // 5, placement = "triangular", seed = 1 }
local step = 0.005 * math.sqrt(800 / given.nodes)
local sweep = ricochet.sweep {
  name = "big",
  over = { sample = { 1 } },
  scene = function(at)
    return ricochet.scene {
      projectile = disk,
      target = wall,
      launch = { speed = 0.2 },
      ending = { at = "time", time = given.steps * step },
      method = "verlet",
      step = step,
    }
  end,
}
local row = sweep:run()[1]
local facts = { row.wall_seconds, row.steps, row.energy_drift, row.last_omega, row.after_contact }
print(string.format("%.2f %d %.17g %.17g %.17g", table.unpack(facts)))
