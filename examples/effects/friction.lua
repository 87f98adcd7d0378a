-- Friction of a smooth disk on a smooth wall. Without friction or roughness no tangential impulse passes: beta = -1
-- (line at the bottom). With it beta leaves -1. Where the disk slides all along, by the theory of Maw, Barber &
-- Fawcett (beyond psi1 = 1.48 here; close to that some nodes still stick for a moment), it is Walton's
-- beta = -1 + mu (1 + e) (1 + M R^2 / I) / psi1, with the disk's own e and moment of inertia I.
-- The law is that of small contacts: the impact is slow, and 0.01 R deep. A node slides once its tangential spring
-- pulls mu times the load; springs as hard as the contact is let it do so at once, and a contact this soft keeps the
-- nodes from bouncing off it.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters {
  psi1    = { { 0.25, 0.5, 0.75, 1, 1.25, 1.75, 2, 3, 4, 6 }, min = 0.01,
              doc = "tangents of the incident angle, rising" },
  mu      = { 0.3, min = 0, doc = "coefficient of friction" },
  samples = { 4, int = true, min = 1, doc = "lattices" },
  nodes   = { 1600, int = true, min = 30, doc = "of the disk; the wall has four times as many" },
}

local rows = ricochet.sweep {
  name = "friction",
  over = { sample = ricochet.range(p.samples), psi1 = p.psi1, rims = { "frictionless", "with friction" } },
  scene = function(at)
    local disk = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", seed = at.sample }
    return ricochet.scene {
      projectile = ricochet.rotated { body = disk, angle = 137.508 * at.sample },  -- no two meet with the same nodes
      target = ricochet.wall { width = 6, depth = 2, nodes = 4 * p.nodes, stiffness = 1e4, placement = "poisson_disk",
        seed = at.sample },
      launch = { normal_speed = 0.02, psi1 = at.psi1 }, contact = { xi = 4000 }, method = "verlet", theta = 0.2,
      effects = at.rims == "with friction" and { ricochet.friction { mu = p.mu, stiffness = 10 } } or {},
    }
  end,
}:run()

local rough = rows:where { rims = "with friction" }
local summary = rough:summary { by = "psi1", of = { "e", "beta", "mu", "friction_energy" } }
summary:print()
if rows[1].status == "not_run" then return end  -- --check

local beta_x, e_of = figures.beta_x(rough), {}
for _, line in ipairs(summary) do e_of[line.psi1] = line.e.mean end
local function sliding(psi1, e) return -1 + p.mu * (1 + e) * beta_x / psi1 end
-- In the plane a contact is as stiff along the surface as across it, whatever Poisson's ratio: nu = 0 of spheres.
local function slides(psi1, e)
  return ricochet.theory.maw { psi1 = psi1, mu = p.mu, e = e, nu = 0, beta_x = beta_x }.regime == 3
end
figures.compare(rough, "psi1", "beta", "Walton, sliding all along,", function(psi1)
  return e_of[psi1] == e_of[psi1] and slides(psi1, e_of[psi1]) and sliding(psi1, e_of[psi1]) or nil
end)
for _, line in ipairs(summary) do
  local beta, line_at = line.beta, sliding(line.psi1, line.e.mean)
  if beta.count > 1 and slides(line.psi1, line.e.mean) then
    print(("psi1 = %g: beta %+.4f, line %+.4f: %+.1f standard errors"):format(line.psi1, beta.mean, line_at,
      (beta.mean - line_at) / beta.se))
  end
end

local e, points = 0, {}
for _, line in ipairs(summary) do e = e + line.e.mean / #summary end
for k = 0, 100 do
  local psi1 = p.psi1[1] + (p.psi1[#p.psi1] - p.psi1[1]) * k / 100
  if slides(psi1, e) then points[#points + 1] = { psi1, sliding(psi1, e) } end
end
ricochet.plot {
  rows = rows, x = "psi1", y = { "beta", "mu" }, by = "rims", name = "friction",
  title = ("A smooth disk on a smooth wall, friction coefficient %g"):format(p.mu),
  theory = { beta = #points > 0 and { { name = "sliding all along (Walton)", points = points } } or {},
             mu = { { name = "coefficient of friction", f = function() return p.mu end } } },
}
