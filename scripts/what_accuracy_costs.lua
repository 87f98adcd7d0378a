-- What accuracy costs on the paper's soft wall: error of e against force evaluations and seconds, for every method, beside the paper's
-- own (Forest & Ruth at a step of 1e-3 R/c; Hayakawa & Kuninaka 2003, section V).
local ricochet = require "ricochet"

local p = ricochet.parameters {
  psi1 = { 1, min = 0, doc = "tangent of the incident angle" },
  seed = { 1, int = true, min = 1, doc = "lattice" },
  nodes = { 800, int = true, min = 50, doc = "nodes of the disk; the wall has five times as many" },
  repeats = { 1, int = true, min = 1, doc = "runs of each step; the least wall time counts" },
}

local scene = ricochet.scene {
  projectile = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", roughness = 0.03, seed = p.seed },
  target = ricochet.wall { nodes = 5 * p.nodes, placement = "poisson_disk", stiffness = 100, roughness = 0.03, seed = p.seed },
  launch = { speed = 0.1, psi1 = p.psi1 },
}

local paper = ricochet.accuracy { scene = scene, methods = { "forest_ruth" }, steps = { 1e-3 }, repeats = p.repeats, name = "paper" }
local study = ricochet.accuracy { scene = scene, repeats = p.repeats, name = "accuracy" }
if paper then
  print(("the paper's forest_ruth at 1e-3 R/c: %.0f force evaluations, %.2f s, error of e %.2g"):format(paper.rows[1].evaluations, paper.rows[1].wall_seconds, paper.rows[1].error.e))
  for _, wanted in ipairs { 1e-3, 1e-4, 1e-6, 1e-8 } do
    local best = study.cheapest(wanted)
    print(best and ("e to %g: %s at %.3g R/c, %.0f force evaluations, %.2f s: %.1f times cheaper"):format(wanted, best.method, best.step, best.evaluations, best.wall_seconds,
      paper.rows[1].wall_seconds / best.wall_seconds) or ("e to %g: out of reach"):format(wanted))
  end
end
