-- A disk whose springs yield, on a hard wall: e falls with the speed. Spheres that deform plastically have e ~ v^(-1/4)
-- (Johnson, Contact Mechanics, 1985, section 11.5). The same argument for disks: a constant pressure over a width ~
-- sqrt(depth) gives a depth ~ v^(4/3), a force ~ v^(2/3), and from an elastic energy ~ force^2 that pushes back e ~
-- v^(-1/3). But springs that yield at a constant tension are crushed: a network of springs does not keep its area, and
-- e falls faster. Hardening stands for the rest.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed     = { { 0.01, 0.02, 0.04, 0.08, 0.16 }, unit = "c", min = 1e-4, doc = "impact speeds" },
  yield     = { 2e-3, min = 1e-9, doc = "stretch over rest length at which a spring yields" },
  hardening = { { 0, 0.1, 0.3 }, min = 0, doc = "growth of the yield stretch with the plastic stretch" },
  samples   = { 4, int = true, min = 1, doc = "lattices" },
  nodes     = { 800, int = true, min = 30, doc = "of the disk; the wall has twice as many" },
}

local rows = ricochet.sweep {
  name = "plastic",
  over = { sample = ricochet.range(p.samples), speed = p.speed, hardening = p.hardening },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", seed = at.sample },
      target = ricochet.wall { width = 4, depth = 1.5, nodes = 2 * p.nodes, stiffness = 1e5,
        placement = "poisson_disk", seed = at.sample },
      launch = { speed = at.speed }, contact = { xi = 3000, reach = 0.01 },
      effects = { ricochet.plastic { yield = p.yield, hardening = at.hardening } },
    }
  end,
}:run()

for _, hardening in ipairs(p.hardening) do
  local of_it = rows:where { hardening = hardening }
  print(("hardening %g"):format(hardening))
  of_it:summary { by = "speed", of = { "e", "plastic_springs", "plastic_energy" } }:print()
  local law = of_it:power_law { x = "speed", y = "e" }
  print(("e ~ v^(%.3f +- %.3f); plastic spheres -1/4, plastic disks -1/3"):format(law.exponent, law.se))
end
ricochet.plot {
  rows = rows, x = "speed", y = { "e" }, by = "hardening", log = "xy", name = "plastic", xlabel = "impact speed [c]",
  title = ("A disk whose springs yield at a strain of %g, on a hard wall"):format(p.yield),
  theory = { e = function(v) return 0.3 * (v / 0.04) ^ -0.25 end }, theory_name = "slope -1/4",
}
