-- What a standard error of e costs on the paper's soft wall: the errors of time step, lattice size and samples from a
-- pilot, the cheapest plan, its predicted and its real time, and e with the error that was wanted.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters {
  psi1 = { { 0, 1, 3, 6 }, min = 0, doc = "tangents of the incident angle" },
  standard_error = { 0.03, min = 1e-6, doc = "wanted at every angle" },
  nodes = { 800, int = true, min = 50, doc = "nodes of the disk; the wall has five times as many" },
  pilot = { 8, int = true, min = 2, doc = "samples of the pilot" },
  continuum = { false, doc = "count the lattice's size as an error too" },
}

local sweep = ricochet.sweep {
  name = "error_budget",
  over = { sample = ricochet.range(100), psi1 = p.psi1 },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = p.nodes, mass = 1, placement = "poisson_disk", roughness = 0.03,
        seed = at.sample },
      target = ricochet.wall { nodes = 5 * p.nodes, mass = 1, placement = "poisson_disk", stiffness = 100,
        roughness = 0.03,
        seed = at.sample },
      launch = { speed = 0.1, psi1 = at.psi1 },
      contact = figures.contact,
    }
  end,
}

local plan = ricochet.plan { sweep = sweep, standard_error = p.standard_error, pilot = p.pilot,
  continuum = p.continuum }
if plan and plan.samples then
  local rows = plan:run()
  rows:summary { by = "psi1", of = { "e", "mu" } }:print()
  ricochet.plot { rows = rows, x = "psi1", y = { "e", "mu" }, name = "error_budget" }
end
