-- A shaken wall: what an impact gives or takes depends on the phase at which the disk meets it. Dashed: a rigid wall
-- that moves with the velocity it has when the rims come within reach, e = e0 + (1 + e0) u / v.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  phase     = { ricochet.range(0, 360, 30), unit = "degrees", doc = "of the wall when the rims come within reach" },
  amplitude = { 0.1, unit = "R", min = 1e-6, doc = "of the wall" },
  omega     = { 0.1, unit = "c/R", min = 1e-6, doc = "its angular frequency" },
  speed     = { 0.1, unit = "c", min = 1e-4, doc = "impact speed" },
  samples   = { 4, int = true, min = 1, doc = "lattices" },
}

local function scene(sample, effects)
  return ricochet.scene {
    projectile = ricochet.disk { nodes = 200, placement = "poisson_disk", seed = sample },
    target = ricochet.wall { nodes = 600, width = 4, depth = 1.5, stiffness = 1e4, placement = "poisson_disk",
      seed = sample },
    launch = { speed = p.speed }, effects = effects, method = "verlet",
  }
end
local rows = ricochet.sweep {
  name = "moving_anchor",
  over = { sample = ricochet.range(p.samples), phase = p.phase },
  scene = function(at)
    return scene(at.sample, { ricochet.moving_anchor { amplitude = p.amplitude, omega = p.omega, phase = at.phase } })
  end,
}:run()
local still = scene(1, {}):run().e
rows:summary { by = "phase", of = { "e", "moving_anchor_energy" } }:print()
ricochet.plot {
  rows = rows, x = "phase", y = { "e", "moving_anchor_energy" }, name = "moving_anchor", xlabel = "phase [degrees]",
  title = ("A disk on a wall shaken by %g R sin(%g t)"):format(p.amplitude, p.omega),
  theory = { e = function(phase)
    return still + (1 + still) * p.amplitude * p.omega * math.cos(math.rad(phase)) / p.speed
  end }, theory_name = "rigid wall at that phase",
}
