#!/bin/sh
# leggedrobotics/SimBenchmark#4 (there a model read from a file did better), schteppe/p2.js#203, bulletphysics/bullet3#4341:
# what bounces depends on the time step.
# Here at 0a2d1a7 and now: e converges; half the step changes it by less than 1e-6.
cat >e.lua <<'LUA'
local ricochet = require "ricochet"
local function e(theta)
  return ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 },
    method = "pefrl", theta = theta, contact = { V0 = 150, xi = 300 }, launch = { speed = 0.05 } }:run().e
end
local difference = math.abs(e(0.2) - e(0.1))
assert(difference < 1e-6, difference)
LUA
ricochet run e.lua --quiet
