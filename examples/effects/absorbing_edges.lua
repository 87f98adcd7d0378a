-- A sphere on a block that stands for a half-space. Where the block is held, waves come back from its edges and give
-- some of their energy back; where its edges absorb, they leave as if the block went on. How large must it be?
local ricochet = require "ricochet"

local p = ricochet.parameters {
  extent = { { 2, 4, 8 }, unit = "R", min = 1, doc = "radius and depth of the block" },
  h_min  = { 0.04, unit = "R", min = 0.01, doc = "side of the smallest triangles" },
}

local E, nu, c0 = 1e4, 0.25, math.sqrt(1e4 / (800 / math.pi))
local speed = 0.01  -- [c0]

local rows = ricochet.sweep {
  name = "absorbing_edges",
  over = { extent = p.extent, edges = { "held", "absorbing" } },
  scene = function(at)
    local block = { E = E, nu = nu, h_min = p.h_min, h_max = 0.8, extent = at.extent, fine_within = 4 * p.h_min }
    local target = at.edges == "absorbing" and ricochet.half_space(block) or ricochet.cylinder {
      E = E, nu = nu, h_min = p.h_min, h_max = 0.8, fine_within = 4 * p.h_min, radius = at.extent,
      height = at.extent, fine_at = { 0, at.extent / 2 },
      anchored = function(x, y) return x == at.extent or y == -at.extent / 2 end }
    return ricochet.scene {
      projectile = ricochet.sphere { E = E, nu = nu, h_min = p.h_min, h_max = 0.2 },
      target = target, launch = { speed = speed * c0 },
      effects = at.edges == "absorbing" and { ricochet.absorbing_edges {} } or {},
    }
  end,
}:run()

for _, row in ipairs(rows) do
  row.lost = 1 - (row.after_projectile_translation + row.after_projectile_vibration) / row.before_total
end
for _, edges in ipairs { "held", "absorbing" } do
  print(edges)
  rows:where { edges = edges }:summary { by = "extent", of = { "e", "lost", "contact_time" } }:print()
end
local law = ricochet.theory.hunter_coefficient { nu = nu } * speed ^ 0.6
print(("a half-space takes %.4f of the energy by radiated waves (theory.hunter_coefficient)"):format(law))
ricochet.plot { rows = rows, x = "extent", y = { "lost" }, by = "edges", name = "absorbing_edges",
  title = "A sphere on a block with held and with absorbing edges", xlabel = "radius and depth of the block [R]",
  ylabel = { lost = "energy that left the sphere" },
  theory = { lost = { { name = "half-space, slow impacts", f = function() return law end } } } }
