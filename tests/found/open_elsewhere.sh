#!/bin/sh
# TeamCOMPAS/COMPAS#683, h5py/h5py#1066, PyTables/PyTables#888: of a file that is open elsewhere: unable to lock file, errno 11 (or 35).
# h5py/h5py#1864: a file that another process reads is emptied by a process that opens it for writing, which then fails.
# Here at 0a2d1a7 and now: a reader keeps the whole old file, and the writer replaces it; two writers are told apart.
ricochet run sweep.lua --quiet || exit 1
exec 3<out/sweep/results.h5
ricochet run sweep.lua --quiet --force || exit 1
cat <&3 >old.h5
ricochet info old.h5 >/dev/null || exit 1
flock out/sweep sh -c 'ricochet run sweep.lua --force --quiet 2>err.txt'
grep -q "another run is writing into out/sweep" err.txt
