#!/bin/sh
# nanoporetech/bonito#157, h5py/h5py#879: a truncated file ends what reads it, and says so by its internals (eof, sblock->base_addr).
# h5py/h5py#1807: a crash leaves one.
# Here at 0a2d1a7 and now: one sentence with the remedy, and --resume does not take damaged rows.
ricochet run sweep.lua --quiet || exit 1
head -c 3000 out/sweep/results.h5 >cut && mv cut out/sweep/results.h5
ricochet info out/sweep/results.h5 2>err.txt
[ $? = 4 ] && grep -q "restore it from a copy, or remove it" err.txt && ! grep -q "sblock" err.txt || exit 1
! ricochet run sweep.lua --quiet --resume 2>/dev/null
