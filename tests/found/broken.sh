#!/bin/sh
# kaipartmann/Peridynamics.jl#142: a bond that is judged by abs(strain) breaks in compression too, which is wrong.
# lammps/lammps#4572: bonds of bpm/spring do.
# Here at 0a2d1a7 and now: springs break when they are stretched alone: a hard press, breaks none at 0.2.
cat >s.lua <<'LUA'
local ricochet = require "ricochet"
local row = ricochet.scene { projectile = ricochet.disk { nodes = 60 }, target = ricochet.wall { nodes = 150, width = 4, stiffness = 1000 },
  launch = { speed = 0.25 }, effects = { ricochet.breaking { strain = 0.2 } } }:run()
assert(row.status == "finished" and row.breaking_springs == 0 and row.indentation > 0.04, row.breaking_springs)
LUA
ricochet run s.lua --quiet
