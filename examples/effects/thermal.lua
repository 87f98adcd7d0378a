-- Two warm disks. Slow impacts of warm bodies may end faster than they began, e > 1, at the cost of their vibrations
-- (Kuninaka & Hayakawa 2009, Phys. Rev. E 79, 031309). The second law holds on average: impacts with more energy than a
-- temperature lose some, those with less gain, and impacts as they fall in equilibrium, with energies distributed as
-- exp(-E / T), gain nothing: they lose a little to tangential motion and spin, which start cold here.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  ratio       = { { 0.5, 1, 2, 4, 8 }, min = 0.01, doc = "impact speed over the thermal speed: that of a relative " ..
    "motion with the energy T" },
  temperature = { 1e-3, unit = "m0 c^2", min = 1e-12, doc = "of both disks" },
  samples     = { 200, int = true, min = 2, doc = "vibrations for each speed" },
  nodes       = { 40, int = true, min = 30, doc = "of each disk" },
  stiffness   = { 100, unit = "m0 c^2/R^2", min = 1e-6, doc = "of the springs" },
}
local thermal_speed = math.sqrt(4 * p.temperature / p.nodes)  -- two disks of mass M: M / 2 v^2 / 2 = T
local left = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", stiffness = p.stiffness, seed = 1 }
local right = ricochet.disk { nodes = p.nodes, placement = "poisson_disk", stiffness = p.stiffness, seed = 2 }

-- energy_gain: of the relative motion along the normal, in temperatures.
local function impacts(name, over, ratio_of)
  local rows = ricochet.sweep {
    name = name, over = over,
    scene = function(at)
      return ricochet.scene {
        projectile = left, target = right, launch = { speed = ratio_of(at) * thermal_speed },
        contact = { xi = 150, V0 = 1000 * p.temperature, reach = 0.2 },  -- too hard for the vibrations to cross
        effects = { ricochet.thermal { temperature = p.temperature, seed = at.sample } },
      }
    end,
  }:run()
  for _, row in ipairs(rows) do
    row.share_above_1 = row.e > 1 and 1 or 0
    row.energy_gain = (row.vn / thermal_speed) ^ 2 - ratio_of(row) ^ 2
  end
  return rows
end

local rows = impacts("thermal", { sample = ricochet.range(p.samples), ratio = p.ratio }, function(at)
  return at.ratio
end)
rows:summary { by = "ratio", of = { "e", "share_above_1", "energy_gain" } }:print()
-- Every share of the distribution once, each with a vibration of its own.
local count = 5 * p.samples
local equilibrium = impacts("thermal_equilibrium", { sample = ricochet.range(count), state = { "equilibrium" } },
  function(at)
    return math.sqrt(-math.log((at.sample - 0.5) / count))
  end)
equilibrium:summary { by = "state", of = { "e", "share_above_1", "energy_gain" } }:print()
ricochet.plot {
  rows = rows, x = "ratio", y = { "e", "share_above_1", "energy_gain" }, log = "x", name = "thermal",
    xlabel = "impact speed over thermal speed",
  title = ("Two warm disks of %d nodes, T = %g m0 c^2"):format(p.nodes, p.temperature),
}
