local ricochet = require "ricochet"
local o = {} for i = 1, 3e6 do o[i] = { math.cos(i / 3e6 * 6.28), math.sin(i / 3e6 * 6.28) } end ricochet.body { outline = o, nodes = 100 }
