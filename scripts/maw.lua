-- beta against cot(gamma), and Psi2 against Psi1, beside the theory of Maw, Barber & Fawcett: Hayakawa & Kuninaka 2003,
-- section III B, figure "maw". The theory takes e and mu from the run (by the fit of walton.lua) and nu from its
-- lattice; Walton's lines are drawn too. Disk and wall are alike and the normal speed is the same at every angle.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  psi1  = { { 0.2, 0.25, 0.33, 0.5, 0.67, 1, 1.5, 2, 3, 4 }, min = 0.01,
    doc = "tangents of the incident angle, rising" },
  speed = { 0.1, unit = "c", min = 1e-6, doc = "normal speed" },
  ratio = { 1, min = 1e-6, doc = "wall stiffness over disk stiffness" },
})

local rows = figures.sweep(p, "maw", p.ratio, p.speed):run()
for _, row in ipairs(rows) do row.cot_gamma = 1 / row.psi1 end
rows:summary { by = "psi1", of = { "beta", "psi2", "e", "mu" } }:print()
if rows[1].status == "not_run" then return end  -- --check
local fit, beta_x, nu = figures.fit(rows), figures.beta_x(rows), figures.material(p).nu
local function maw(psi1)
  return ricochet.theory.maw { psi1 = psi1, mu = fit.mu, e = fit.e, nu = nu, beta_x = beta_x }
end
local function walton(psi1)
  return ricochet.theory.walton { psi1 = psi1, mu = fit.mu, e = fit.e, beta_x = beta_x,
    beta0 = math.max(-1, math.min(1, fit.beta0)) }
end
figures.compare(rows, "psi1", "beta", "Maw, Barber & Fawcett", function(psi1) return maw(psi1).beta end)
figures.compare(rows, "psi1", "beta", "Walton", function(psi1) return walton(psi1).beta end)
local caption = ("e = %.3f, μ = %.3f, β0 = %.2f of the run, ν = %.3f of its lattice. %s"):format(fit.e, fit.mu,
  fit.beta0, nu, figures.caption(p, p.ratio))
ricochet.plot {
  rows = rows, x = "cot_gamma", y = { "beta" }, name = "maw_beta", caption = caption,
  theory = { beta = { { name = "Maw, Barber & Fawcett", f = function(cot)
    return maw(1 / cot).beta
  end }, { name = "Walton, fitted", f = function(cot) return walton(1 / cot).beta end } } },
  title = ("Tangential restitution against the incident angle, normal speed %g c"):format(p.speed),
}
ricochet.plot {
  rows = rows, x = "psi1", y = { "psi2" }, name = "maw_psi", caption = caption,
  theory = { psi2 = { { name = "Maw, Barber & Fawcett", f = function(psi1)
    return maw(psi1).psi2
  end }, { name = "Walton, fitted", f = function(psi1) return walton(psi1).psi2 end } } },
  title = ("Tangential velocities before and after, normal speed %g c"):format(p.speed),
}
