#!/bin/sh
# sharkdp/fd#24, medialab/xan#759: output piped into head ends the program with a panic.
# Here at 0a2d1a7: standard error piped into head aborted the run (SIGABRT) and its sweep. Now: it goes on.
ricochet run sweep.lua --out pipe 2>&1 >/dev/null | true
[ -e pipe/sweep/results.h5 ] && [ ! -e pipe/sweep/parts ] || exit 1
ricochet reference | head -1 | grep -q Reference
