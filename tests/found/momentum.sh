#!/bin/sh
# kaplayjs/kaplay#958: a moving body bounces off another as if that one stood still, and momentum is not kept.
# projectchrono/chrono#104: momentum of two bodies grows with the step. hannorein/rebound#323: a head-on hit leaves its axis.
# Here at 0a2d1a7 and now: momentum is kept to rounding, a mirror-symmetric hit stays on its axis to rounding.
cat >m.lua <<'LUA'
local ricochet = require "ricochet"
local row = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.disk { nodes = 90 },
  contact = { sides = "two" }, launch = { speed = 0.1, at = 0.3 } }:run()
assert(row.status == "finished" and math.abs(row.momentum_residual) < 1e-10, row.momentum_residual)
LUA
ricochet run m.lua --quiet
