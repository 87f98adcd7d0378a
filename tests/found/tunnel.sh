#!/bin/sh
# liabru/matter-js#189, liabru/matter-js#5, schteppe/cannon.js#202: what is fast passes through what is thin.
# dimforge/rapier#984: two that are fast pass through one another.
# Here at 0a2d1a7 and now: a step that would let it is refused, or the row says "tunnelled"; never "finished" beyond the wall.
cat >t.lua <<'LUA'
local ricochet = require "ricochet"
for _, speed in ipairs { 0.3, 0.9 } do
  local ok, row = pcall(function()
    return ricochet.scene { projectile = ricochet.disk { nodes = 60, stiffness = 1e6 },
      target = ricochet.wall { nodes = 60, width = 4, depth = 0.2 }, launch = { speed = speed }, time_limit = 20 }:run()
  end)
  assert(not ok or row.status ~= "finished" or row.e > 0, ok and row.status)
end
LUA
ricochet run t.lua --quiet; [ $? = 0 -o $? = 3 ]
