#!/bin/sh
# mumax/3#281: the output folder is made anew, and files in it that are not the program's are lost.
# edoddridge/aronnax#108: a second run erases the first one's results.
# Here at 0a2d1a7: --force removed a user's picture from the folder. Now: only what is on the run's own list goes.
ricochet run sweep.lua --quiet && echo mine >out/sweep/photo.png || exit 1
! ricochet run sweep.lua --quiet 2>/dev/null || exit 1
ricochet run sweep.lua --quiet --force && [ "$(cat out/sweep/photo.png)" = mine ] || exit 1
ricochet run sweep.lua --quiet --new && [ -e out/sweep-2/results.h5 ]
