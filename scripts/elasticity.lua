-- Young's modulus and Poisson's ratio of the random lattice, from a stretched band: Hayakawa & Kuninaka 2003, section V
-- A, which gives E = (9.54 +- 0.23)e3 m0 c^2/R^2 and nu = 0.075 without saying how its lattice's rim was made.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  samples   = { 10, int = true, min = 1, doc = "random bands" },
  stiffness = { 1e4, unit = "m0 c^2/R^2", min = 1e-12, doc = "spring constant" },
  width     = { 2, unit = "R", min = 0.1, doc = "extent across the pull" },
  height    = { 6, unit = "R", min = 0.1, doc = "extent along the pull" },
  density   = { 250, unit = "1/R^2", min = 10, doc = "nodes per area" },
  placement = { "uniform", choices = { "uniform", "poisson_disk", "triangular" }, doc = "how the nodes are placed" },
}

local function mean_and_error(values)
  local mean, square = 0, 0
  for _, v in ipairs(values) do mean = mean + v / #values end
  for _, v in ipairs(values) do square = square + (v - mean) ^ 2 end
  return mean, #values > 1 and math.sqrt(square / (#values - 1) / #values) or 0 / 0
end

local E, nu = {}, {}
for sample = 1, p.samples do
  local w, h = p.width, p.height
  local band = ricochet.body {
    outline = { { 0, 0 }, { w, 0 }, { w, h }, { 0, h } },
    nodes = math.floor(p.density * w * h),
    placement = p.placement,
    stiffness = p.stiffness,
    seed = sample,
  }
  local moduli = ricochet.elasticity { body = band }
  E[sample], nu[sample] = moduli.E, moduli.nu
end

local E_mean, E_error = mean_and_error(E)
local nu_mean, nu_error = mean_and_error(nu)
local function pm(error) return error == error and (" +- %.2g"):format(error) or "" end
print(("%d bands of %g R x %g R, %s: E = %.4g%s m0 c^2/R^2 (E/k = %.4f), nu = %.4f%s"):format(
  p.samples, p.width, p.height, p.placement, E_mean, pm(E_error), E_mean / p.stiffness, nu_mean, pm(nu_error)))
