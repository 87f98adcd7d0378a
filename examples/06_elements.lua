-- The same disk twice, head on onto a rigid plane: once of springs, once of finite elements. Springs have the
-- contraction nu = 1/3 of their lattice; elements may have any. Where nu is the same, so are the pressure inside and e.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed = { 0.05, min = 0.001, max = 0.1, doc = "of the fall, over the speed of pressure waves of the first disk" },
  nodes = { 800, int = true, min = 50, max = 20000, doc = "nodes of the disk of springs" },
  h_min = { 0.03, min = 0.005, max = 0.2, doc = "side of the smallest triangles of the disks of elements, in R" },
}

-- Springs of k in a triangular lattice have E = 2 k/sqrt(3) and nu = 1/3. 800 nodes of m0 weigh pi R^2 of density.
local stiffness, density = 1e4, 800 / math.pi
local E = 2 * stiffness / math.sqrt(3)
local function wave_speed(nu) return math.sqrt(E / (density * (1 - nu ^ 2))) end

local disks = {
  { name = "springs", nu = 1 / 3, ricochet.disk { nodes = p.nodes, placement = "triangular", stiffness = stiffness,
    quartic = 0 } },
}
for _, nu in ipairs { 1 / 3, 0.1, 0.45 } do
  disks[#disks + 1] = { name = ("elements, nu = %.2f"):format(nu), nu = nu,
    ricochet.disk { interior = "elements", E = E, nu = nu, h_min = p.h_min, h_max = 3 * p.h_min } }
end

local function scene(disk)
  return ricochet.scene { projectile = disk[1], target = ricochet.plane {}, contact = { xi = 1000 },
    launch = { speed = p.speed * wave_speed(disk.nu) } }
end

local mesh = ricochet.mesh { body = disks[2][1] }
print(("mesh: %d triangles, the worst of quality %.2f, %.2f %% of the mass missing"):format(mesh.triangles,
  mesh.quality, -100 * mesh.mass_error))
local rows = ricochet.sweep { name = "06_elements", over = { disk = ricochet.range(#disks) },
  scene = function(at) return scene(disks[at.disk]) end }:run()
for i, row in ipairs(rows) do
  print(("%-20s e = %.3f, in contact for %.2f R/c_P"):format(disks[i].name, row.e,
    row.contact_time * wave_speed(disks[i].nu)))
end
ricochet.still { scenes = { scene(disks[1]), scene(disks[2]) }, titles = { disks[1].name, disks[2].name },
  out = "tightest", size = { 800, 450 }, show = { material = "pressure", springs = "plain" } }
