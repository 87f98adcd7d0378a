-- The control of Hayakawa & Kuninaka 2003, section V D: with the normal speed fixed instead of the speed, the mean e
-- never exceeds 1.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

-- A disk that keeps 0.1 c along the normal ploughs through the soft wall to its end at Psi1 = 4, 6 R within one
-- contact; a quarter of that speed leaves it on the wall at every angle.
local p = ricochet.parameters(figures.parameters {
  psi1  = { { 0, 0.5, 1, 2, 3, 4, 6, 8 }, min = 0, doc = "tangents of the incident angle, rising" },
  ratio = { 1 / 100, min = 1e-6, doc = "wall stiffness over disk stiffness" },
  speed = { 0.025, unit = "c", min = 1e-6, doc = "normal speed" },
})

local rows = figures.sweep(p, "fixed_normal_speed", p.ratio, p.speed):run()
local summary = rows:summary { by = "psi1", of = { "e", "mu", "beta" } }
summary:print()
local most, error, where, least = -math.huge, 0, 0, 1
for _, line in ipairs(summary) do
  if line.e.count > 0 and line.e.mean > most then most, error, where = line.e.mean, line.e.se, line.psi1 end
  if line.e.count > 0 then least = math.min(least, line.e.mean) end
end
print(("greatest mean e: %.4f%s at Psi1 = %g"):format(most, error == error and (" +- %.4f"):format(error) or "", where))
ricochet.plot {
  rows = rows, x = "psi1", y = { "e", "mu" }, name = "fixed_normal_speed",
  theory = { e = { { name = "e = 1", f = function()
    return 1
  end } } }, yrange = { e = { least - 0.05, math.max(1, most) + 0.05 } },
  title = ("Hard disk on a soft wall at a normal speed of %g c, whatever the angle"):format(p.speed),
    caption = figures.caption(p, p.ratio),
}
