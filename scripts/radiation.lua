-- 1 - e against v by radiation of elastic waves: Hayakawa & Kuninaka 2003, section II C. Their printed law has v^(1/5);
-- their own loss of energy, and Hunter, have v^(3/5). A steel sphere on steel by Miller & Pursey's theory with Rayleigh
-- waves, the printed law (in SI units, on which it depends), and Hunter's constant as Johnson quotes it.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  E     = { 2.1e11, unit = "Pa", min = 1, doc = "Young's modulus" },
  nu    = { 0.25, min = 0, max = 0.45, doc = "Poisson's ratio; the printed law is that of 1/4" },
  rho   = { 7800, unit = "kg/m^3", min = 1, doc = "density" },
  R     = { 0.01, unit = "m", min = 1e-9, doc = "radius of the sphere" },
  speed = { { 1e-3, 10 }, unit = "m/s", min = 1e-9, doc = "from and to" },
}

local theory, m, c0 = ricochet.theory, 4 / 3 * math.pi * p.R ^ 3 * p.rho, math.sqrt(p.E / p.rho)
local function radiated(v)
  return 1 - theory.radiation_loss { R = p.R, m = m, E = p.E, nu = p.nu, E2 = p.E, nu2 = p.nu, rho2 = p.rho, v = v }.e
end
local function printed(v)
  return theory.radiation_printed { R = p.R, m = m, E = p.E, E2 = p.E, nu2 = p.nu, rho = p.rho, v = v }
end
local function hunter(v) return 1 - math.sqrt(1 - 1.04 * (v / c0) ^ 0.6) end

local shares = theory.radiation_shares { nu = p.nu }
print(("nu = %g: P %.2f %%, S %.2f %%, Rayleigh %.2f %%; 1 - e^2 = %.4f (v/c0)^(3/5)"):format(p.nu, 100 * shares.P,
  100 * shares.S, 100 * shares.rayleigh, theory.hunter_coefficient { nu = p.nu }))
for _, v in ipairs(p.speed) do
  print(("v = %g m/s: 1 - e = %.3e, printed %.3e, its own loss of energy %.3e"):format(v, radiated(v),
    printed(v).one_minus_e, printed(v).one_minus_e_of_energy))
end

ricochet.plot {
  x = "v", y = { "loss" }, name = "radiation", log = "xy", xrange = p.speed, xlabel = "v [m/s]",
    ylabel = { loss = "1 − e" },
  theory = { loss = {
    { name = "waves, v^3/5", f = radiated },
    { name = "Hunter as quoted by Johnson", f = hunter },
    { name = "printed law, v^1/5", f = function(v) return printed(v).one_minus_e end },
    { name = "printed energy", f = function(v) return printed(v).one_minus_e_of_energy end },
  } },
  title = "Restitution lost to elastic waves: sphere on a half-space of the same material",
  caption = ("R = %g m, E = %g Pa, ν = %g, ρ = %g kg/m³. Theory only. " ..
    "The printed lines depend on the units (SI)."):format(p.R, p.E, p.nu, p.rho),
}
