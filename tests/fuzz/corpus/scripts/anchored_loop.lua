local ricochet = require "ricochet"
ricochet.body { outline = {{0,0},{1,0},{0,1}}, nodes = 50, anchored = function() while true do end end }
