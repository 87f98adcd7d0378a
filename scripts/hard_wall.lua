-- e against Psi1 for a soft disk on a wall ten times harder: Hayakawa & Kuninaka 2003, section V D, figure "hard".
-- There e is almost constant, and exceeds unity suddenly near Psi1 = 4.5; here it rises all along, and exceeds unity
-- from Psi1 = 2 on. The reading is that of scripts/soft_wall.lua, whose rims of 0.03 R have slopes of 0.67: so steep
-- are they that the contact meets facets that face it at any angle. Rims of twice the spacing and 0.01 R, slopes of
-- 0.11, stay even up to 3 and exceed unity from 4 on: scripts/four_claims.lua; the law of it: scripts/slopes.lua.
local ricochet = require "ricochet"
local figures = require "ricochet.figures"

local p = ricochet.parameters(figures.parameters {
  psi1  = { { 0, 1, 2, 3, 3.5, 4, 4.5, 5, 5.5, 6, 7, 8 }, min = 0, doc = "tangents of the incident angle, rising" },
  ratio = { 10, min = 1e-6, doc = "wall stiffness over disk stiffness" },
})

local rows = figures.sweep(p, "hard_wall", p.ratio):run()
for _, row in ipairs(rows) do row.above_1 = row.e == row.e and (row.e > 1 and 1 or 0) or 0 / 0 end
rows:summary { by = "psi1", of = { "e", "above_1", "mu", "beta" } }:print()
ricochet.plot {
  rows = rows, x = "psi1", y = { "e", "above_1", "mu" }, name = "hard_wall",
  theory = { e = { { name = "e = 1", f = function() return 1 end } } },
  ylabel = { above_1 = "share of impacts with e > 1" },
  title = ("Soft disk on a hard wall, speed %g c"):format(p.speed), caption = figures.caption(p, p.ratio),
}
