#!/bin/sh
# openexchangerates/accounting.js#56, status-im/status-app#14163: a decimal comma is taken for something else: 64,00 is 6400, 0,001 is 1.
# dfinity/snsdemo#282: awk writes one in the language of the user, and the next program refuses it.
# Here at 0a2d1a7: v=0,05 was the list {0, 5}. Now: refused, with the point named; the language of the user changes no number.
printf '%s\n' 'local p = require("ricochet").parameters { v = { { 0.1, 0.2 }, doc = "speeds" } }' 'print(p.v[1])' >p.lua
! ricochet run p.lua v=0,05 2>err.txt && grep -q "write decimals with a point" err.txt || exit 1
[ "$(LC_ALL=de_DE.UTF-8 ricochet run p.lua v=0.05)" = 0.05 ]
