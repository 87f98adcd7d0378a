-- The control of Hayakawa & Kuninaka 2003, section V D: with the normal speed fixed instead of the speed, the mean e never exceeds 1.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  psi1  = { { 0, 0.5, 1, 2, 3, 4, 5 }, min = 0, doc = "tangents of the incident angle, rising; at 6 the energy passes V0 and tunnelling can no longer be excluded" },
  ratio = { 1 / 100, min = 1e-6, doc = "wall stiffness over disk stiffness" },
  speed = { 0.1, unit = "c", min = 1e-6, doc = "normal speed" },
  -- Above Psi1 = 1 some of these fast impacts are too irregular for 1e-3 to be reached.
  accuracy = { 0, min = 0, max = 0.1, doc = "wanted error of e from the time step; 0: none, the default step" },
})

local rows = figures.sweep(p, "fixed_normal_speed", p.ratio, p.speed):run()
local summary = rows:summary { by = "psi1", of = { "e", "mu", "beta" } }
summary:print()
local most, error, where = -math.huge, 0, 0
for _, line in ipairs(summary) do
  if line.e.count > 0 and line.e.mean > most then most, error, where = line.e.mean, line.e.se, line.psi1 end
end
print(("greatest mean e: %.4f%s at Psi1 = %g"):format(most, error == error and (" +- %.4f"):format(error) or "", where))
ricochet.plot {
  rows = rows, x = "psi1", y = { "e", "mu" }, name = "fixed_normal_speed",
  theory = { e = { { name = "e = 1", f = function() return 1 end } } },
  title = ("Hard disk on a soft wall at a normal speed of %g c, whatever the angle"):format(p.speed), caption = figures.caption(p, p.ratio),
}
