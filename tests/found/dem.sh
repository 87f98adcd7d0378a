#!/bin/sh
# lammps/lammps#4068, google-deepmind/mujoco#2080: which damping gives the e that was asked for?
# Here at 0a2d1a7: no such export. Now: ricochet.dem writes the number that makes LAMMPS's `damping tsuji` return the measured e.
echo "help 'dem'" | ricochet repl | grep -q LAMMPS || exit 1
echo 'require("ricochet").dem { rows = {} }' >d.lua
! ricochet run d.lua 2>err.txt && grep -q "d.lua:1" err.txt
