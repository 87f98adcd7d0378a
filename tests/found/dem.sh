#!/bin/sh
# google-deepmind/mujoco#2080, lammps/lammps#4068: which damping gives the e that was asked for?
# Here at 0a2d1a7: no answer. Now: ricochet.dem writes lines of LAMMPS's, with the number that makes it 0.9.
ricochet reference | grep -q "ricochet.dem" || exit 1
echo 'require("ricochet").dem { rows = {} }' >d.lua
! ricochet run d.lua 2>err.txt && grep -q "d.lua:1" err.txt
