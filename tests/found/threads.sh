#!/bin/sh
# dimforge/bevy_rapier#305 (there the step followed the clock), dimforge/rapier#868: the same simulation ends differently in another run.
# simulationcraft/simc#1974: with more than one thread it does.
# Here at 0a2d1a7 and now: the same bits with any number of threads and lanes.
for how in "--threads 1 --batch 1" "--threads 2 --batch 2" "--threads 2"; do
  ricochet run sweep.lua --quiet --force $how >/dev/null || exit 1
  sed 's/,[^,]*$//' out/sweep/results.csv | cut -d, -f1-20 | md5sum
done | sort -u | wc -l | grep -qx "1 *"
