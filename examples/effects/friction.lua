-- Friction of a smooth disk on a smooth wall. Without friction or roughness no tangential impulse passes: beta = -1
-- (line at the bottom). With it beta leaves -1: where the disk slides all along, Walton's beta = -1 + mu (1 + e)
-- (1 + M R^2 / I) / psi1, with the disk's own moment of inertia I.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  psi1    = { { 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4, 6 }, min = 0.01, doc = "tangents of the incident angle" },
  mu      = { 0.3, min = 0, doc = "coefficient of friction" },
  samples = { 4, int = true, min = 1, doc = "lattices" },
  nodes   = { 400, int = true, min = 30, doc = "of the disk; the wall has four times as many" },
}

local rows = ricochet.sweep {
  name = "friction",
  over = { sample = ricochet.range(p.samples), psi1 = p.psi1, rims = { "frictionless", "with friction" } },
  scene = function(at)
    return ricochet.scene {
      projectile = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", seed = at.sample },
      target = ricochet.wall { width = 6, depth = 2, nodes = 4 * p.nodes, stiffness = 1e4, placement = "poisson_disk",
        seed = at.sample },
      launch = { normal_speed = 0.05, psi1 = at.psi1 }, method = "verlet",
      effects = at.rims == "with friction" and { ricochet.friction { mu = p.mu } } or {},
    }
  end,
}:run()

local rough = rows:where { rims = "with friction" }
rough:summary { by = "psi1", of = { "e", "beta", "mu", "friction_energy" } }:print()
local e, beta_x, count = 0, 0, 0
for _, row in ipairs(rough) do
  if row.status == "finished" then e, beta_x, count = e + row.e, beta_x + 1 + 1 / row.inertia, count + 1 end
end
e, beta_x = e / count, beta_x / count
ricochet.plot {
  rows = rows, x = "psi1", y = { "beta", "mu" }, by = "rims", name = "friction",
  title = ("A smooth disk on a smooth wall, friction coefficient %g"):format(p.mu),
  theory = { beta = function(psi1)
    return -1 + p.mu * (1 + e) * beta_x / psi1
  end, mu = function() return p.mu end }, theory_name = "sliding all along (Walton)",
}
