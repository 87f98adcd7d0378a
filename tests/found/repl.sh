#!/bin/sh
# MightyPirates/OpenComputers#3065, ThePhD/sol2#1163: a Lua prompt that forgets locals.
# monome/norns#12, MightyPirates/OpenComputers#1662: one that cannot go on in a next line.
# Here at 0a2d1a7: both. Now: neither.
printf 'local a = 1\nfunction f(x)\n  return x + a\nend\nf(41)\n' | ricochet repl | grep -q "42"
