-- Spheres: Hertz's impact beside Chung & Ooi's tests 1 and 2, and the theories of Walton and of Maw, Barber & Fawcett
-- beside finite elements (their test 5). No simulation. (An experiment beside both: kharaz.lua.)
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local theory = ricochet.theory
for _, test in ipairs(figures.benchmarks) do
  local impact = { R = test.R, E = test.E, nu = test.nu, m = 4 / 3 * math.pi * test.R ^ 3 * test.rho, v = test.v }
  if test.pair then impact.R2, impact.E2, impact.nu2, impact.m2 = impact.R, impact.E, impact.nu, impact.m end
  local hertz = theory.hertz(impact)
  print(("%-36s F %8.1f N (%g), overlap %7.2f um (%g), time %7.2f us (%g)"):format(test.name, hertz.F, test.F,
    hertz.h0 * 1e6, test.h0 * 1e6, hertz.t_c * 1e6, test.t_c * 1e6))
end

-- Finite elements: in units of mu v_n. Walton's beta0 is fitted to those that stick, his mu is theirs.
local mu, sphere = 0.3, 3.5
local psi1, psi2, e = {}, {}, {}
for i, point in ipairs(figures.finite_elements) do psi1[i], psi2[i], e[i] = mu * point[1], mu * point[2], 1 end
local fit = theory.fit_walton { psi1 = psi1, psi2 = psi2, e = e, beta_x = sphere }
print(("finite elements: Walton's mu = %.3f +- %.3f (0.3), beta0 = %.2f +- %.2f"):format(fit.mu, fit.mu_se, fit.beta0,
  fit.beta0_se))
local function maw(x) return theory.maw { psi1 = mu * x, mu = mu, e = 1, nu = 0.3, beta_x = sphere }.psi2 / mu end
local function hertzian(x)
  return theory.maw_hertz { psi1 = mu * x, mu = mu, e = 1, nu = 0.3 }.psi2 / mu
end
local function walton(x)
  return theory.walton { psi1 = mu * x, mu = mu, e = 1, beta0 = fit.beta0, beta_x = sphere }.psi2 / mu
end
for _, point in ipairs(figures.finite_elements) do
  print(("x = %5.3f: finite elements %6.3f, Maw %6.3f, with springs %6.3f, Walton %6.3f"):format(point[1], point[2],
    hertzian(point[1]), maw(point[1]), walton(point[1])))
end
ricochet.plot {
  x = "x", y = { "y" }, name = "finite_elements", xrange = { 0, 10 }, xlabel = "v_ct / (μ v_n)",
    ylabel = { y = "v_ct' / (μ v_n)" },
  theory = { y = { { name = "Maw, Barber & Fawcett", f = hertzian },
    { name = "with springs for Hertz's contact", f = maw }, { name = "Walton", f = walton } } },
  published = { y = { { name = "finite elements, Chung & Ooi 2011", points = figures.finite_elements } } },
  title = "Oblique impact of a sphere on a plane", caption =
    ("μ = 0.3, ν = 0.3, e = 1; Walton's β0 = %.2f fitted. No simulation."):format(fit.beta0),
}
