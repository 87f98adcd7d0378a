-- Spheres: Hertz's impact beside Chung & Ooi's tests 1 and 2, and the theories of Walton and of Maw, Barber & Fawcett
-- beside finite elements (their test 5) and the experiment of Kharaz, Gorham & Salman 2001 (5 mm Al2O3 on glass, 3.9
-- m/s). No simulation.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters {
  mu_glass = { 0.092, min = 0, doc = "friction of Al2O3 on glass" },
  e_glass  = { 0.98, min = 0.1, max = 1, doc = "normal restitution of Al2O3 on glass" },
  nu_glass = { 0.23, min = 0, max = 0.5, doc = "Poisson's ratio there" },
}

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
local function walton(x)
  return theory.walton { psi1 = mu * x, mu = mu, e = 1, beta0 = fit.beta0, beta_x = sphere }.psi2 / mu
end
for _, point in ipairs(figures.finite_elements) do
  print(("x = %5.3f: finite elements %6.3f, Maw %6.3f, Walton %6.3f"):format(point[1], point[2], maw(point[1]),
    walton(point[1])))
end
ricochet.plot {
  x = "x", y = { "y" }, name = "finite_elements", xrange = { 0, 10 }, xlabel = "v_ct / (μ v_n)",
    ylabel = { y = "v_ct' / (μ v_n)" },
  theory = { y = { { name = "Maw, Barber & Fawcett", f = maw }, { name = "Walton", f = walton } } },
  published = { y = { { name = "finite elements, Chung & Ooi 2011", points = figures.finite_elements } } },
  title = "Oblique impact of a sphere on a plane", caption =
    ("μ = 0.3, ν = 0.3, e = 1; Walton's β0 = %.2f fitted. No simulation."):format(fit.beta0),
}

-- The centre's tangential restitution v_t'/v_t = 1 - (1 + beta)/beta_x.
local function centre(beta) return 1 - (1 + beta) / sphere end
local function tangent(angle) return math.tan(math.rad(angle)) end
local function maw_centre(angle)
  return centre(theory.maw { psi1 = tangent(angle), mu = p.mu_glass, e = p.e_glass, nu = p.nu_glass,
    beta_x = sphere }.beta)
end
local function walton_centre(angle)
  return centre(theory.walton { psi1 = tangent(angle), mu = p.mu_glass, e = p.e_glass, beta0 = fit.beta0,
    beta_x = sphere }.beta)
end
for _, point in ipairs(figures.kharaz) do
  print(("%5.2f degrees: measured %.4f, Maw %.4f, Walton %.4f"):format(point[1], point[2], maw_centre(point[1]),
    walton_centre(point[1])))
end
ricochet.plot {
  x = "angle", y = { "e_t" }, name = "kharaz", xrange = { 1, 89 }, xlabel = "incident angle [degrees]",
    ylabel = { e_t = "v_t' / v_t of the centre" },
  theory = { e_t = { { name = "Maw, Barber & Fawcett", f = maw_centre }, { name = "Walton", f = walton_centre } } },
  published = { e_t = { { name = "Kharaz et al. 2001", points = figures.kharaz } } },
  title = "5 mm Al2O3 sphere on glass, 3.9 m/s",
  caption = ("μ = %g, e = %g, ν = %g; Walton's β0 = %.2f is that of the finite elements. No simulation."):format(
    p.mu_glass, p.e_glass, p.nu_glass, fit.beta0),
}
