-- The check of the model's size in Hayakawa & Kuninaka 2003, section V D: a disk of 400 nodes and a wall of 2000 beside
-- 800 and 4000, each with its own curve of the tilted surface (friction angle turned with it). Halving the nodes halves
-- one of two things, and both are drawn. With the mass of a node kept, as in the paper, the bodies have half the
-- density: R, springs and speed are the same, but waves run sqrt(2) times as fast, so that the impact is a slower one.
-- With the density kept, the bodies are the same, and their lattices coarser.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  standard_error = false,
  psi1  = { { 0, 1, 2, 3, 4, 6, 8 }, min = 0, doc = "tangents of the incident angle, rising" },
  ratio = { 1 / 100, min = 1e-6, doc = "wall stiffness over disk stiffness" },
})

local half = math.floor(p.nodes / 2)
local whole = ("%d nodes"):format(p.nodes)
local bodies = {
  { name = whole, nodes = p.nodes, mass = 1 },
  { name = ("%d, equal nodes"):format(half), nodes = half, mass = 1 },
  { name = ("%d, equal density"):format(half), nodes = half, mass = p.nodes / half },
}
local names, of_name = {}, {}
for i, body in ipairs(bodies) do names[i], of_name[body.name] = body.name, body end

local rows = ricochet.sweep {
  name = "half_size",
  over = { body = names, sample = ricochet.range(p.samples), psi1 = p.psi1 },
  scene = function(at)
    local body = of_name[at.body]
    return figures.scene(p, p.ratio, { sample = at.sample, nodes = body.nodes, mass = body.mass,
      launch = { speed = p.speed, psi1 = at.psi1 } })
  end,
}:run()

local theory = {}
for _, body in ipairs(bodies) do
  print(("disk of %s"):format(body.name))
  local some = rows:where { body = body.name }
  some:summary { by = "psi1", of = { "e", "mu" } }:print()
  local curve = figures.tilted(some, figures.material(p, body.nodes).nu_strain)
  if curve then
    theory[#theory + 1] = { name = ("tilted surface, %s"):format(body.name), points = curve.rotated }
    figures.compare(some, "psi1", "e", "tilted surface, as printed", curve.at.printed)
    figures.compare(some, "psi1", "e", "friction angle turned with it", curve.at.rotated)
  end
end
-- Both halves beside the whole at the same angles: how far apart, with the standard error of the difference.
local large = rows:where { body = whole }:summary { by = "psi1", of = { "e", "mu" } }
for _, body in ipairs(bodies) do
  local small = rows:where { body = body.name }:summary { by = "psi1", of = { "e", "mu" } }
  for i, line in ipairs(body.name == whole and {} or small) do
    local told = {}
    for _, column in ipairs { "e", "mu" } do
      local a, b = line[column], large[i][column]
      local se = p.samples > 1 and ("%.4f"):format(math.sqrt(a.se ^ 2 + b.se ^ 2)) or "unknown (one sample)"
      table.insert(told, ("%s %+.4f +- %s"):format(column, a.mean - b.mean, se))
    end
    print(("Psi1 = %g, %s less %s: %s"):format(line.psi1, body.name, whole, table.concat(told, ", ")))
  end
end
ricochet.plot {
  rows = rows, x = "psi1", y = { "e", "mu" }, by = "body", name = "half_size",
  theory = #theory > 0 and { e = theory } or {},
  title = ("Size of the model: disks of %d and %d nodes, walls of five times as many"):format(half, p.nodes),
  caption = ("Stiffness ratio %g, speed %g c, rims of %g R, %d lattices an angle and body. Lines with the friction " ..
    "angle turned."):format(p.ratio, p.speed, p.roughness, p.samples),
}
