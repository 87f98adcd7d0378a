#!/bin/sh
# kripken/ammo.js#221, bulletphysics/bullet3#1530: a ball of e = 1 loses height.
# jrouwe/JoltPhysics#1286, piqnt/planck.js#223: it gains height at every bounce.
# Here at 0a2d1a7: energy closed, but e was 1.008: what gravity added before the touch counted. Now: e is 0.96.
cat >b.lua <<'LUA'
local ricochet = require "ricochet"
local row = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4 },
  launch = { speed = 0.05, height = 0.5 }, effects = { ricochet.gravity { g = 1e-3 } } }:run()
assert(row.status == "finished" and row.e < 1 and row.e > 0.5 and math.abs(row.energy_closure) < 1e-6, row.energy_closure)
LUA
ricochet run b.lua --quiet
