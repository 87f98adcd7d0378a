#!/bin/sh
# paulofmandown/rotLove#46, samboy/ObHack#4, Aleph-One-Marathon/alephone#214: pairs() makes a seeded script differ between runs.
# Here at 0a2d1a7: another order in every run. Now: one order.
echo 'local t = {} for k in pairs { a = 1, b = 2, c = 3, dd = 4, eee = 5, f = 6 } do t[#t + 1] = k end print(table.concat(t))' >p.lua
for i in 1 2 3 4 5; do ricochet run p.lua; done | sort -u | wc -l | grep -qx "1 *"
