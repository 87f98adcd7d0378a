#!/bin/sh
# aras-p/ClangBuildAnalyzer#2: on a disk that is full the output is cut short, nothing is told, and the exit status is 0.
# PyTables/PyTables#695, h5py/h5py#370: a disk that is full, or a file that is not closed, leaves a file that cannot be opened.
# Here at 0a2d1a7: right for results; text lost on a full standard output was not told. Now: exit 4 and a sentence, results whole.
ricochet run sweep.lua >/dev/full 2>err.txt
[ $? = 4 ] && grep -q "standard output cannot be written" err.txt && ricochet info out/sweep/results.h5 >/dev/null
