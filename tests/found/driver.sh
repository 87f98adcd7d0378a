#!/bin/sh
# commaai/openpilot#28696, microsoft/wslg#1045: drawing ends with a segmentation fault under WSL. isl-org/Open3D#7066: offscreen too.
# Here at 0a2d1a7: GALLIUM_DRIVER=d3d12, which WSL exports, crashed OSMesa. Now: the same pixels as without it.
cat >pic.lua <<'LUA'
local ricochet = require "ricochet"
ricochet.still { scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 },
  target = ricochet.wall { nodes = 150, width = 4 } }, out = "a", size = { 64, 48 } }
LUA
GALLIUM_DRIVER=d3d12 ricochet run pic.lua --quiet --out wsl && ricochet run pic.lua --quiet && cmp wsl/pic/a.png out/pic/a.png
