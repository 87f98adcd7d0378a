#!/bin/sh
# avianphysics/avian#118: a restitution below 0 is taken, and bodies explode (later: clamped). jrouwe/JoltPhysics#548: a body may have one.
# Here at 0a2d1a7 and now: theories refuse it, and name the range.
echo 'require("ricochet").theory.maw { psi1 = 1, mu = 0.3, e = -0.2, nu = 0.3 }' >e.lua
! ricochet run e.lua 2>err.txt && grep -q "'e'" err.txt
