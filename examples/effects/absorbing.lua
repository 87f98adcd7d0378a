-- A wall that ends against one that does not: waves that come back from held edges give some of their energy to the
-- disk. Absorbing edges make a half-space of the wall; how much of e was due to the edges?
local ricochet = require "ricochet"

local p = ricochet.parameters {
  depth   = { { 1.5, 2, 3 }, unit = "R", min = 1, doc = "of the wall, which is four times as wide" },
  rate    = { 5, unit = "c/R", min = 0, doc = "of the absorbing layer, half as wide as the wall is deep" },
  samples = { 8, int = true, min = 1, doc = "lattices" },
  density = { 125, min = 10, doc = "nodes per R^2" },
}

local rows = ricochet.sweep {
  name = "absorbing",
  over = { sample = ricochet.range(p.samples), depth = p.depth, edges = { "held", "absorbing" } },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = math.floor(math.pi * p.density), placement = "poisson_disk",
        roughness = 0.03, seed = at.sample },
      target = ricochet.wall { width = 4 * at.depth, depth = at.depth,
        nodes = math.floor(4 * at.depth ^ 2 * p.density), stiffness = 100,
                               placement = "poisson_disk", roughness = 0.03, seed = at.sample },
      launch = { speed = 0.1, psi1 = 1 }, method = "verlet",
      effects = at.edges == "absorbing" and { ricochet.absorbing { width = at.depth / 2, rate = p.rate } } or {},
    }
  end,
}:run()
for _, edges in ipairs { "held", "absorbing" } do
  print(edges)
  rows:where { edges = edges }:summary { by = "depth", of = { "e", "mu", "contact_time" } }:print()
end
ricochet.plot { rows = rows, x = "depth", y = { "e", "mu" }, by = "edges", name = "absorbing",
  title = "A disk on a soft wall with held and with absorbing edges", xlabel = "depth of the wall [R]" }
