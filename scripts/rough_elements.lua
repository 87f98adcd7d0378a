-- Is e > 1 of an oblique impact a matter of the lattice, or of the roughness? The paper's rough hard disk on a soft
-- wall (scripts/soft_wall.lua) with finite elements in the springs' place: nu = 0.1, 0.33 and 0.45, rough and smooth,
-- beside the lattice of springs. Young's modulus and density are the lattice's. `samples`: impacts a point;
-- `full=true`: 50 a point at ten angles, 12 minutes on two cores.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters {
  psi1      = { { 0, 1, 2, 4, 6, 8 }, min = 0, doc = "tangents of the incident angle, rising" },
  samples   = { 6, int = true, min = 1, doc = "impacts a point; 50 with full=true" },
  nodes     = { 800, int = true, min = 40, doc = "of the disk; the wall has five times as many" },
  speed     = { 0.1, unit = "c", min = 1e-6, doc = "impact speed" },
  roughness = { 0.03, unit = "R", min = 0, max = 0.2, doc = "standard deviation of the rims" },
  ratio     = { 1 / 100, min = 1e-6, doc = "wall stiffness over disk stiffness" },
  full      = { false, doc = "the figure in full" },
}
local samples = p.full and 50 or p.samples
local angles = p.full and { 0, 0.5, 1, 2, 3, 4, 5, 6, 7, 8 } or p.psi1

local stiffness = 1e4
local E = 1.132 * stiffness  -- of a lattice of springs between Poisson disks: scripts/README.md, elasticity

-- Those of the disk and the wall, whose nodes weigh m0 in the paper.
local disk_density, width, depth = p.nodes / math.pi, 8, 2
local wall_density = 5 * p.nodes / (width * depth)

local bodies = {
  { name = "springs, rough", springs = true, roughness = p.roughness },
  { name = "ν = 0.10, rough", nu = 0.1, roughness = p.roughness },
  { name = "ν = 0.33, rough", nu = 0.33, roughness = p.roughness },
  { name = "ν = 0.45, rough", nu = 0.45, roughness = p.roughness },
  { name = "ν = 0.33, smooth", nu = 0.33, roughness = 0 },
}

local function interior(body, share, density)
  if body.springs then return { stiffness = stiffness * share, mass = 1 } end  -- the paper's nodes weigh alike
  return { interior = "elements", E = E * share, nu = body.nu, density = density }
end

local rows = ricochet.sweep {
  name = "rough_elements",
  over = { sample = ricochet.range(samples), kind = ricochet.range(#bodies), psi1 = angles },
  scene = function(at)
    local body = bodies[at.kind]
    local disk, wall = interior(body, 1, disk_density), interior(body, p.ratio, wall_density)
    disk.nodes, wall.nodes, wall.width, wall.depth = p.nodes, 5 * p.nodes, width, depth
    for _, t in ipairs { disk, wall } do t.roughness, t.seed = body.roughness, at.sample end
    return ricochet.scene { projectile = ricochet.disk(disk), target = ricochet.wall(wall),
      launch = { speed = p.speed, psi1 = at.psi1 }, contact = figures.contact, accuracy = 1e-3 }
  end,
}:run()

for _, row in ipairs(rows) do
  row.of = bodies[row.kind].name
  row.share = row.e == row.e and (row.e > 1 and 1 or 0) or 0 / 0
end
for _, body in ipairs(bodies) do
  print(body.name)
  rows:where { of = body.name }:summary { by = "psi1", of = { "e", "share", "mu" } }:print()
end

ricochet.plot {
  rows = rows, x = "psi1", y = { "e", "share", "mu" }, by = "of", name = "rough_elements",
  ylabel = { share = "share of impacts with e > 1" },
  title = ("Hard disk on a soft wall (ratio %g), %g c: springs and finite elements"):format(p.ratio, p.speed),
  caption = ("Roughness %g R, %d + %d nodes, %d impacts a point."):format(p.roughness, p.nodes, 5 * p.nodes, samples),
}
