-- e, mu and beta against Psi1 for a hard disk on a soft wall: Hayakawa & Kuninaka 2003, section V, figures fig2 and fig4.
-- The paper places its nodes "at random". Independent uniform points leave voids that make the wall 15 % softer near the rim
-- than Poisson-disk points; only the latter give the paper's indentation of 0.17 R at Psi1 = 1, so they are the default.
-- The stiffness of the disk is 1e4 m0 c^2/R^2: the 1.0 the paper prints cannot be, the disk would fall through the wall.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  psi1      = { { 0, 0.5, 1, 2, 3, 4, 5, 6, 7, 8 }, min = 0, doc = "tangent of the incident angle" },
  samples   = { 100, int = true, min = 1, doc = "random lattices per angle" },
  ratio     = { 1 / 100, min = 1e-6, doc = "wall stiffness over disk stiffness" },
  speed     = { 0.1, unit = "c", min = 1e-6, doc = "impact speed" },
  roughness = { 0.03, unit = "R", min = 0, max = 0.2, doc = "standard deviation of the rims" },
  placement = { "poisson_disk", choices = { "poisson_disk", "uniform" }, doc = "how the nodes are placed" },
  method    = { "auto", choices = { "auto", "pefrl", "forest_ruth", "verlet" }, doc = "integrator; the paper's is forest_ruth" },
  step      = { 0, unit = "R/c", min = 0, doc = "time step; 0 chooses one from the lattice (the paper's is 0.001)" },
  accuracy  = { 0, min = 0, max = 0.1, doc = "wanted error of e from the time step, which chooses method and step; 0: none (1e-3 is fastest)" },
}

local sweep = ricochet.sweep {
  name = "soft_wall",
  over = { sample = ricochet.range(p.samples), psi1 = p.psi1 },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = 800, stiffness = 1e4, placement = p.placement, roughness = p.roughness, seed = at.sample },
      target = ricochet.wall { nodes = 4000, stiffness = 1e4 * p.ratio, placement = p.placement, roughness = p.roughness, seed = at.sample },
      launch = { speed = p.speed, psi1 = at.psi1 },
      method = p.method,
      step = p.step > 0 and p.step or nil,
      accuracy = p.accuracy > 0 and p.accuracy or nil,
    }
  end,
}

local rows = sweep:run()
rows:summary { by = "psi1", of = { "e", "mu", "beta", "indentation" } }:print()
ricochet.plot {
  rows = rows, x = "psi1", y = { "e", "mu", "beta" }, name = "soft_wall",
  title = ("Hard disk on a soft wall: stiffness ratio %g, speed %g c, roughness %g R"):format(p.ratio, p.speed, p.roughness),
}
