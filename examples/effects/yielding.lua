-- A metal sphere on a rigid plane. It is elastic until the middle of its contact yields; from then on most of the
-- energy goes into the dent, and e falls with the speed as about v^(-1/4) (Johnson, Contact Mechanics, 1985, 11.5; Wu,
-- Li & Thornton 2003: e = 2.08 (v/v_y)^(-1/4) where the whole contact flows). The speeds are in units of v_y, at which
-- yielding begins.
local ricochet = require "ricochet"

local p = ricochet.parameters {
  speed = { { 100, 300, 1000, 3000 }, unit = "v_y", min = 1e-2, doc = "impact speeds" },
  yield = { 1.1e-3, min = 1e-5, doc = "yield stress over Young's modulus" },
  h_min = { 0.15, min = 0.02, doc = "side of the smallest triangles over the expected radius of the contact" },
}

local E, nu, density = 1e4, 0.3, 800 / math.pi
local E_star = E / (1 - nu ^ 2)
-- Where 1.60 Y is the greatest pressure of Hertz.  [Johnson 1985, section 11.5]
local v_y = 1.56 * math.sqrt((1.6 * p.yield * E) ^ 5 / (E_star ^ 4 * density))

local rows = ricochet.sweep {
  name = "yielding",
  over = { speed = p.speed },
  scene = function(at)
    local v = at.speed * v_y
    -- The contact's radius, of Hertz or of a constant pressure of 3 Y, whichever is wider.
    local energy = 2 * math.pi / 3 * density * v ^ 2
    local hertz = (2.5 * energy * 0.75 / E_star) ^ 0.2
    local flat = (4 * energy / (math.pi * 3 * p.yield * E)) ^ 0.25
    local h = p.h_min * math.max(hertz, flat)
    return ricochet.scene {
      projectile = ricochet.sphere { E = E, nu = nu, h_min = h, h_max = math.max(0.15, h) },
      target = ricochet.plane {}, launch = { speed = v },
      effects = { ricochet.yielding { yield = p.yield * E } },
    }
  end,
}:run()

rows:summary { by = "speed", of = { "e", "yielding_energy", "plastic_strain_most", "dent" } }:print()
ricochet.plot {
  rows = rows, x = "speed", y = { "e" }, log = "xy", name = "yielding", xlabel = "impact speed [v_y]",
  title = ("A sphere that yields at %g E, on a rigid plane"):format(p.yield),
  theory = { e = function(v) return v > 30 and 2.08 * v ^ -0.25 or nil end }, theory_name = "2.08 (v/v_y)^(-1/4)",
}
