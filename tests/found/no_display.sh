#!/bin/sh
# jurgisp/memory-maze#3, google-deepmind/mujoco#716: on a machine without a display drawing needs variables that one must know.
# openai/mujoco-py#34: it needs an X server.
# Here at 0a2d1a7 and now: none are needed; a library that is missing is told with its package (gbionics/jaxsim#420: OSMesa goes).
cat >pic.lua <<'LUA'
local ricochet = require "ricochet"
ricochet.still { scene = ricochet.scene { projectile = ricochet.disk { nodes = 60 },
  target = ricochet.wall { nodes = 150, width = 4 } }, out = "a", size = { 64, 48 } }
LUA
program=$(command -v ricochet)
env -i "$program" run pic.lua --quiet || exit 1
mkdir lib && echo no library >lib/libOSMesa.so.8
LD_LIBRARY_PATH=lib "$program" run pic.lua --quiet --force 2>err.txt
[ $? = 4 ] && grep -q "apt-get install libosmesa6" err.txt
