#!/bin/sh
# ploteria/ploteria#22, bheisler/criterion.rs#422: a quote in a title ends gnuplot's string. NetsBlox/NetsBlox#2727: no plot with one.
# SiegeLord/RustGnuplot#92: a backquote in one runs a program.
# Here at 0a2d1a7: a label that begins with an apostrophe could not be plotted (doubled quotes). Now: it can.
cat >plot.lua <<'LUA'
local ricochet = require "ricochet"
for i, title in ipairs { "'Tis", "it's", "''", "a'", "`touch run`", '"$(touch run)"', "\\'" } do
  ricochet.plot { x = "a", y = { "b" }, name = "p" .. i, title = title, xlabel = title, theory = { b = { { 1, 1 }, { 2, 2 } } } }
end
LUA
ricochet run plot.lua --quiet && [ -e out/plot/p7.png ] && [ ! -e run ] && [ ! -e out/plot/run ]
