#!/bin/sh
# hannorein/rebound#482, bwvdnbro/CMacIonize#42: an interrupted run must go on where it was. hannorein/rebound#514: and to the same bits.
# Here at 0a2d1a7: SIGHUP (a terminal that is gone) lost what was under way. Now: as ^C; --resume gives the undisturbed rows.
ricochet run sweep.lua samples=60 --quiet --batch 1 & p=$!
while [ ! -d out/sweep/parts ]; do sleep 0.01; done
kill -HUP $p; wait $p
[ $? = 130 ] || exit 1
ricochet run sweep.lua samples=60 --quiet --resume && ricochet run sweep.lua samples=60 --quiet --out calm || exit 1
for out in out calm; do cut -d, -f1-20 $out/sweep/results.csv | md5sum; done | sort -u | wc -l | grep -qx "1 *"
