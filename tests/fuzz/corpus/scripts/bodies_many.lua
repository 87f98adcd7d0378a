local ricochet = require "ricochet"
for i = 1, 1e6 do ricochet.disk { nodes = 100000, seed = i } end
