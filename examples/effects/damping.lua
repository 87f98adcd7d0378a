-- Two viscous disks. For spheres Kuwabara & Kono (1987) find that viscosity takes from e a part that grows as v^(1/5),
-- because a contact time falls as v^(-1/5). The contact time of disks falls as a logarithm of the speed: what does
-- viscosity take from them? The contact layer is made ten times thinner than the paper's, so that the slowest impact
-- still deforms the disks more than the layer.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed   = { { 0.01, 0.02, 0.04, 0.08, 0.16 }, unit = "c", min = 1e-4, doc = "impact speeds" },
  tau     = { 4e-3, unit = "R/c", min = 1e-9, doc = "retardation time of the material" },
  samples = { 4, int = true, min = 1, doc = "pairs of lattices" },
  nodes   = { 1500, int = true, min = 30, doc = "of each disk" },
}

local rows = ricochet.sweep {
  name = "damping",
  over = { sample = ricochet.range(p.samples), speed = p.speed, material = { "elastic", "viscous" } },
  scene = function(at)
    local function disk(seed) return ricochet.disk { nodes = p.nodes, placement = "poisson_disk", seed = seed } end
    return ricochet.scene {
      projectile = disk(2 * at.sample), target = disk(2 * at.sample + 1),
      launch = { speed = at.speed }, contact = { xi = 3000, reach = 0.01 }, method = "verlet",
      effects = at.material == "viscous" and { ricochet.damping { time = p.tau } } or {},
    }
  end,
}:run()

-- What viscosity takes from e, on the same lattices.
local elastic = {}
for _, row in ipairs(rows:where { material = "elastic" }) do elastic[row.sample .. " " .. row.speed] = row.e end
local viscous = rows:where { material = "viscous" }
for _, row in ipairs(viscous) do row.viscous_loss = elastic[row.sample .. " " .. row.speed] - row.e end
viscous:summary { by = "speed", of = { "e", "viscous_loss", "contact_time" } }:print()
local loss, contact = viscous:power_law { x = "speed", y = "viscous_loss" },
  viscous:power_law { x = "speed", y = "contact_time" }
print(("loss ~ v^(%.3f +- %.3f), contact time ~ v^(%.3f +- %.3f); spheres: 1/5 and -1/5"):format(loss.exponent,
  loss.se, contact.exponent, contact.se))
ricochet.plot {
  rows = viscous, x = "speed", y = { "viscous_loss", "contact_time" }, log = "xy", name = "damping",
    xlabel = "impact speed [c]",
  title = ("What viscosity takes from e of two disks (retardation time %g R/c)"):format(p.tau),
  theory = { viscous_loss = function(v)
    return loss.factor * v ^ loss.exponent
  end, contact_time = function(v) return contact.factor * v ^ contact.exponent end },
  theory_name = "fitted power law",
}
