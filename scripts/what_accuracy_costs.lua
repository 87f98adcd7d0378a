-- What accuracy costs on the paper's soft wall: error of e against force evaluations and seconds, for every method,
-- beside the paper's own (Forest & Ruth at a step of 1e-3 R/c; Hayakawa & Kuninaka 2003, section V), and beside what
-- the size of the lattice changes.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters {
  psi1 = { 1, min = 0, doc = "tangent of the incident angle" },
  seed = { 1, int = true, min = 1, doc = "lattice" },
  nodes = { 800, int = true, min = 50, doc = "nodes of the disk; the wall has five times as many" },
  repeats = { 1, int = true, min = 1, doc = "runs of each step; the least wall time counts" },
  lattices = { 16, int = true, min = 2, doc = "lattices of each size" },
}

local scene = ricochet.scene {
  projectile = ricochet.disk { nodes = p.nodes, mass = 1, placement = "poisson_disk", roughness = 0.03, seed = p.seed },
  target = ricochet.wall { nodes = 5 * p.nodes, mass = 1, placement = "poisson_disk", stiffness = 100, roughness = 0.03,
    seed = p.seed },
  launch = { speed = 0.1, psi1 = p.psi1 },
  contact = figures.contact,
}

-- The picture for a first look, then every method.
local few = { "multirate_5", "verlet", "takahashi_imada", "forest_ruth" }
ricochet.accuracy { scene = scene, methods = few, repeats = p.repeats, lattices = { 0.25, 0.5, 1 },
  lattice_samples = p.lattices, name = "overview" }
local paper = ricochet.accuracy { scene = scene, methods = { "forest_ruth" }, steps = { 1e-3 }, repeats = p.repeats,
  name = "paper" }
local study = ricochet.accuracy { scene = scene, repeats = p.repeats, name = "accuracy" }
if not study then return end

local own = paper.rows[1]
print(("the paper's forest_ruth at 1e-3 R/c: %.0f force evaluations, %.2f s, error of e %.2g"):format(own.evaluations,
  own.wall_seconds, own.error.e))
print("force evaluations for an error of e, and how many times fewer than the paper's:")
local wanted = { 1e-3, 1e-4, 1e-6 }
print(("%-20s"):format("method") .. ("%20g"):rep(#wanted):format(table.unpack(wanted)))
for _, method in ipairs(study.methods) do
  local line = ("%-20s"):format(method)
  for _, error in ipairs(wanted) do
    local best = study.cheapest(error, "e", method)
    line = line .. (best and ("%12.0f (%4.1f x)"):format(best.evaluations, own.evaluations / best.evaluations)
      or ("%20s"):format("-"))
  end
  print(line)
end
for _, error in ipairs(wanted) do
  local best = study.cheapest(error)
  if best then
    print(("e to %g: %s at %.3g R/c, %.2f s: %.1f times faster"):format(error, best.method, best.step,
      best.wall_seconds, own.wall_seconds / best.wall_seconds))
  end
end
