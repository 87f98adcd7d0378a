-- What impacts cost on this machine: the paper's figure by the paper's method and step, by the default and for an
-- accuracy of e, each timed on a few impacts and multiplied up; and how the cost of a node and step grows with the
-- lattice. `./workbench bench` measures what lies below: the spring sweep against the processor's limit, and LAMMPS
-- beside it.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters {
  nodes   = { 800, int = true, min = 30, doc = "of the disk; the wall has five times as many" },
  samples = { 2, int = true, min = 1, doc = "random lattices" },
  psi1    = { { 0, 0.5, 1, 2, 3, 4, 5, 6, 7, 8 }, min = 0, doc = "tangents of the incident angle" },
  figure  = { 1000, int = true, min = 1, doc = "impacts of the whole figure" },
  growth  = { { 1000, 3000, 10000, 30000 }, min = 100, doc = "nodes of both bodies together in the second part" },
}

local function scene(nodes, sample, psi1, how)
  local given = {
    projectile = ricochet.disk { nodes = nodes // 6, mass = 1, roughness = 0.03, placement = "poisson_disk",
      seed = sample },
    target = ricochet.wall { nodes = nodes // 6 * 5, mass = 1, stiffness = 100, roughness = 0.03,
      placement = "poisson_disk",
      seed = sample },
    launch = { speed = 0.1, psi1 = psi1 },
    contact = figures.contact,
  }
  for field, value in pairs(how) do given[field] = value end
  return ricochet.scene(given)
end

-- Processor seconds an impact.
local function seconds_an_impact(rows)
  local sum = 0
  for _, row in ipairs(rows) do sum = sum + row.wall_seconds end
  return sum / #rows
end

local ways = {
  { name = "paper", how = { method = "forest_ruth", step = 1e-3 }, label = "the paper's forest_ruth, step 1e-3 R/c" },
  { name = "default", how = {}, label = "default (pefrl)" },
  { name = "accuracy", how = { accuracy = 1e-3 }, label = "accuracy = 1e-3" },
}
local lines = {}
for _, way in ipairs(ways) do
  local rows = ricochet.sweep {
    name = "benchmark_" .. way.name,
    over = { sample = ricochet.range(p.samples), psi1 = p.psi1 },
    scene = function(at) return scene(6 * p.nodes, at.sample, at.psi1, way.how) end,
  }:run()
  local seconds = seconds_an_impact(rows)
  lines[#lines + 1] = ("%-40s %8.3f s an impact %8.2f a second and core  %g impacts: %.1f core minutes"):format(
    way.label, seconds, 1 / seconds, p.figure, p.figure * seconds / 60)
end

local growth = ricochet.sweep {
  name = "benchmark_growth",
  over = { nodes = p.growth, psi1 = { 0, 1, 2, 3 } },
  scene = function(at) return scene(at.nodes, 1, at.psi1, { method = "verlet", theta = 1.6 }) end,
}:run()
local cost = "ns a node and step"
for _, row in ipairs(growth) do row[cost] = 1e9 * row.wall_seconds / (row.steps * row.nodes) end

print(table.concat(lines, "\n"))
growth:summary { by = "nodes", of = { cost, "steps" } }:print()
ricochet.plot {
  rows = growth, x = "nodes", y = { cost }, log = "x", name = "growth", xlabel = "nodes of disk and wall",
  title = "Cost of whole impacts, four in lanes, contact and launch included",
}
