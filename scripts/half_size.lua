-- The check of the model's size in Hayakawa & Kuninaka 2003, section V D: a disk of 400 nodes and a wall of 2000 beside
-- 800 and 4000, with each one's own curve of the tilted surface (friction angle turned with it).
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  psi1  = { { 0, 1, 2, 3, 4, 6, 8 }, min = 0, doc = "tangents of the incident angle, rising" },
  ratio = { 1 / 100, min = 1e-6, doc = "wall stiffness over disk stiffness" },
})

local half = math.floor(p.nodes / 2)
local rows = ricochet.sweep {
  name = "half_size",
  over = { disk = { p.nodes, half }, sample = ricochet.range(p.samples), psi1 = p.psi1 },
  scene = function(at)
    return figures.scene(p, p.ratio,
      { sample = at.sample, nodes = at.disk, launch = { speed = p.speed, psi1 = at.psi1 } })
  end,
}:run()

local theory = {}
for _, nodes in ipairs { half, p.nodes } do
  print(("disk of %d nodes"):format(nodes))
  local some = rows:where { disk = nodes }
  some:summary { by = "psi1", of = { "e", "mu" } }:print()
  local curve = figures.tilted(some, figures.material(p, nodes).nu_strain)
  if curve then
    theory[#theory + 1] = { name = ("tilted surface, %d"):format(nodes), points = curve.rotated }
    figures.compare(some, "psi1", "e", "tilted surface, as printed", curve.at.printed)
    figures.compare(some, "psi1", "e", "friction angle turned with it", curve.at.rotated)
  end
end
-- Both sizes on the same angles: how far apart, in standard errors of the difference.
local small, large = rows:where { disk = half }:summary { by = "psi1", of = { "e" } },
  rows:where { disk = p.nodes }:summary { by = "psi1", of = { "e" } }
for i = 1, #small do
  local a, b = small[i].e, large[i].e
  local se = p.samples > 1 and ("%.4f"):format(math.sqrt(a.se ^ 2 + b.se ^ 2)) or "unknown (one sample)"
  print(("Psi1 = %g: e of %d less e of %d nodes: %+.4f +- %s"):format(small[i].psi1, half, p.nodes, a.mean - b.mean,
    se))
end
ricochet.plot {
  rows = rows, x = "psi1", y = { "e", "mu" }, by = "disk", name = "half_size",
    theory = #theory > 0 and { e = theory } or {},
  title = ("Size of the model: disks of %d and %d nodes, walls of five times as many"):format(half, p.nodes),
  caption = ("Stiffness ratio %g, speed %g c, rims of %g R, %d lattices an angle and size. Lines with the friction " ..
    "angle turned."):format(p.ratio, p.speed, p.roughness, p.samples),
}
