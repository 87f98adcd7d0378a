-- Psi2 against Psi1 beside Walton's argument: Hayakawa & Kuninaka 2003, section III A, figure "walton", with e, mu and
-- beta0 fitted to the run. The paper takes its parameters from an earlier work (Kuninaka & Hayakawa 2003) and gives
-- none; here disk and wall are alike and the normal speed is the same at every angle, so that e and mu vary little.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  psi1  = { { 0.2, 0.4, 0.6, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4 }, min = 0,
    doc = "tangents of the incident angle, rising" },
  speed = { 0.1, unit = "c", min = 1e-6, doc = "normal speed" },
  ratio = { 1, min = 1e-6, doc = "wall stiffness over disk stiffness" },
})

local rows = figures.sweep(p, "walton", p.ratio, p.speed):run()
rows:summary { by = "psi1", of = { "psi2", "beta", "e", "mu" } }:print()
if rows[1].status == "not_run" then return end  -- --check
local fit, beta_x = figures.fit(rows), figures.beta_x(rows)
local function walton(psi1)
  return ricochet.theory.walton { psi1 = psi1, mu = fit.mu, e = fit.e, beta_x = beta_x,
    beta0 = math.max(-1, math.min(1, fit.beta0)) }.psi2
end
figures.compare(rows, "psi1", "psi2", "Walton", walton)
ricochet.plot {
  rows = rows, x = "psi1", y = { "psi2" }, name = "walton", theory = { psi2 = walton }, theory_name = "Walton, fitted",
  title = ("Walton's argument: disk on a wall, normal speed %g c"):format(p.speed),
  caption = ("Fit: e = %.3f ± %.3f, μ = %.3f ± %.3f, β0 = %.2f ± %.2f. %s"):format(fit.e, fit.e_se, fit.mu, fit.mu_se,
    fit.beta0, fit.beta0_se, figures.caption(p, p.ratio)),
}
